#include "methods/bem/rigid_parts.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <vector>

namespace fracbench::bem {
namespace {

class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  std::int32_t find(std::int32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// The two sides of a sheet that is tied to the surface all around, by one of their vertices each.
struct Sides {
  std::int32_t upper = -1;
  std::int32_t lower = -1;
};

}  // namespace

Eigen::MatrixXd rigid_motions(const CrackedSurface& body) {
  const std::vector<Vec3>& points = body.surface.vertices;
  Groups groups(points.size());
  for (const Face& face : body.surface.faces) {
    groups.join(face[0], face[1]);
    groups.join(face[0], face[2]);
  }
  std::vector<std::size_t> tied(body.sheets.size(), 0);
  std::vector<Sides> sides(body.sheets.size());
  for (const MouthVertex& mouth : body.mouths) {
    if (mouth.upper == mouth.lower) continue;
    ++tied[mouth.sheet];
    sides[mouth.sheet] = {mouth.upper, mouth.lower};
  }
  // A sheet whose opening is 0 somewhere holds its two sides together.
  for (const MouthVertex& mouth : body.mouths) {
    if (tied[mouth.sheet] == body.sheets[mouth.sheet].boundary.size()) continue;
    groups.join(mouth.upper, mouth.lower);
  }

  std::size_t rows = points.size();
  for (const CrackSheet& sheet : body.sheets) {
    rows += sheet.mesh.vertices.size() - sheet.boundary.size();
  }
  std::vector<std::int32_t> parts;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const std::int32_t group = groups.find(static_cast<std::int32_t>(v));
    if (group == static_cast<std::int32_t>(v)) parts.push_back(group);
  }
  Eigen::MatrixXd motions(3 * rows, 6 * parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Vec3 center = Vec3::Zero();
    double count = 0;
    const auto belongs = [&](std::int32_t v) { return groups.find(v) == parts[p]; };
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (!belongs(static_cast<std::int32_t>(v))) continue;
      center += points[v];
      ++count;
    }
    center /= count;
    Eigen::MatrixXd part = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * rows), 6);
    Eigen::Index row = 0;
    const auto set = [&](const Vec3& point, double factor) {
      const Vec3 r = point - center;
      part.block<3, 3>(row, 0) = factor * Mat3::Identity();
      part.col(3).segment<3>(row) = factor * Vec3::UnitX().cross(r);
      part.col(4).segment<3>(row) = factor * Vec3::UnitY().cross(r);
      part.col(5).segment<3>(row) = factor * Vec3::UnitZ().cross(r);
      row += 3;
    };
    for (std::size_t v = 0; v < points.size(); ++v) {
      set(points[v], belongs(static_cast<std::int32_t>(v)) ? 1 : 0);
    }
    for (std::size_t s = 0; s < body.sheets.size(); ++s) {
      const CrackSheet& sheet = body.sheets[s];
      double factor = 0;
      if (tied[s] == sheet.boundary.size() && tied[s] > 0) {
        factor = (belongs(sides[s].lower) ? 1 : 0) - (belongs(sides[s].upper) ? 1 : 0);
      }
      std::vector<char> boundary(sheet.mesh.vertices.size(), 0);
      for (const std::int32_t v : sheet.boundary) boundary[v] = 1;
      for (std::size_t v = 0; v < boundary.size(); ++v) {
        if (boundary[v] == 0) set(sheet.mesh.vertices[v], factor);
      }
    }
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(part);
    motions.middleCols<6>(static_cast<Eigen::Index>(6 * p)) =
        qr.householderQ() * Eigen::MatrixXd::Identity(part.rows(), 6);
  }
  // Two parts share the rows of the sheet between them: orthonormal all together.
  if (parts.size() > 1) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(motions);
    return qr.householderQ() * Eigen::MatrixXd::Identity(motions.rows(), motions.cols());
  }
  return motions;
}

}  // namespace fracbench::bem
