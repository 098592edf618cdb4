#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "core/context.h"
#include "core/material.h"
#include "methods/bem/boundary_elements.h"

namespace fracbench::bem {

/// The hypersingular operator of a surface that changes a little from step to step. An entry
/// depends on the triangles around its two vertices only: those whose triangles are the same (bit
/// for bit) as in the step before keep their entries, the other rows and columns are assembled
/// anew.
class OperatorCache {
 public:
  explicit OperatorCache(const Material& material) : material_(material) {}

  /// The symmetric operator of `elements`, N/m, unknowns x unknowns, both triangles filled. Valid
  /// until the next call.
  const Eigen::MatrixXd& update(const BoundaryElements& elements, const Context& context);

  /// How many vertices the last update assembled anew.
  std::size_t assembled_vertices() const { return assembled_; }

 private:
  /// The triangles around a vertex, each from that vertex on, in a fixed order.
  using Star = std::vector<std::array<double, 9>>;

  Material material_;
  std::map<Star, std::int32_t> vertices_;
  Eigen::MatrixXd matrix_;
  std::size_t assembled_ = 0;
};

}  // namespace fracbench::bem
