#pragma once

#include <Eigen/Core>
#include <limits>

namespace fracbench::modes {

/// Anderson acceleration of a fixed-point iteration x <- g(x), type II with a safeguard: an
/// extrapolated point whose residual |g(x) - x| is too large is dropped for the plain step from the
/// point before it (Walker and Ni 2011; Zhang, O'Donoghue and Boyd 2020).
class Anderson {
 public:
  /// Looks back at up to `memory` steps; 0: plain iteration.
  explicit Anderson(int memory) : memory_(memory) {}

  /// Replaces the point x, whose image is g(x), by the next point.
  void advance(Eigen::MatrixXd& x, Eigen::MatrixXd image);

  /// Forgets the steps, for when the map changes.
  void reset();

 private:
  int memory_;
  int count_ = 0;                   ///< steps that are kept
  int slot_ = 0;                    ///< where the next goes
  Eigen::MatrixXd residual_steps_;  ///< differences of residuals, as columns
  Eigen::MatrixXd image_steps_;     ///< differences of images
  Eigen::MatrixXd products_;        ///< of the residual steps with each other
  Eigen::VectorXd last_residual_;
  Eigen::MatrixXd last_image_;
  double shortest_ = std::numeric_limits<double>::infinity();  ///< residual since the last reset
  bool extrapolated_ = false;  ///< the point that the next call comes with
};

}  // namespace fracbench::modes
