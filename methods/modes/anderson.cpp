#include "methods/modes/anderson.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

namespace fracbench::modes {
namespace {

// Plain steps never lengthen the residual of an averaged map; an extrapolated one may, up to this
// multiple of the shortest one so far.
constexpr double kSafeguard = 2;
// Of the normal equations, relative to their trace.
constexpr double kRegularisation = 1e-10;

}  // namespace

void Anderson::reset() {
  count_ = 0;
  slot_ = 0;
  last_image_.resize(0, 0);
  shortest_ = std::numeric_limits<double>::infinity();
  extrapolated_ = false;
}

void Anderson::advance(Eigen::MatrixXd& x, Eigen::MatrixXd image) {
  if (memory_ == 0) {
    x = std::move(image);
    return;
  }
  Eigen::VectorXd residual = (image - x).reshaped();
  const double norm = residual.norm();
  if (extrapolated_ && !(norm <= kSafeguard * shortest_)) {
    x = std::move(last_image_);
    const double shortest = shortest_;
    reset();
    shortest_ = shortest;
    return;
  }
  if (last_image_.size() > 0) {
    if (residual_steps_.rows() != residual.size() || residual_steps_.cols() != memory_) {
      residual_steps_.setZero(residual.size(), memory_);
      image_steps_.setZero(residual.size(), memory_);
      products_.setZero(memory_, memory_);
    }
    residual_steps_.col(slot_) = residual - last_residual_;
    image_steps_.col(slot_) = (image - last_image_).reshaped();
    count_ = std::min(count_ + 1, memory_);
    const Eigen::VectorXd with_new =
        residual_steps_.leftCols(count_).transpose() * residual_steps_.col(slot_);
    products_.col(slot_).head(count_) = with_new;
    products_.row(slot_).head(count_) = with_new.transpose();
    slot_ = (slot_ + 1) % memory_;
  }
  last_residual_ = std::move(residual);
  shortest_ = std::min(shortest_, norm);
  last_image_ = std::move(image);
  x = last_image_;
  extrapolated_ = false;
  if (count_ > 0) {
    Eigen::MatrixXd normal = products_.topLeftCorner(count_, count_);
    normal.diagonal().array() += kRegularisation * normal.trace();
    const Eigen::VectorXd gamma =
        normal.ldlt().solve(residual_steps_.leftCols(count_).transpose() * last_residual_);
    if (gamma.allFinite()) {
      x.reshaped() -= image_steps_.leftCols(count_) * gamma;
      extrapolated_ = true;
    }
  }
}

}  // namespace fracbench::modes
