#include "app/shape_frame.h"

#include <algorithm>
#include <numeric>

#include "geometry/measures.h"

namespace fracbench {

namespace {

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

ShapeFrame::ShapeFrame(TriangleMesh own, double longest_side)
    : own_(std::move(own)),
      normalized_(longest_side == 0 ? own_ : fracbench::normalized(own_, longest_side)) {
  const BoundingBox from = bounding_box(own_);
  const bool unchanged = own_.vertices == normalized_.vertices;
  center_ = unchanged ? Vec3::Zero() : from.center();
  scale_ = unchanged ? 1 : from.longest_side() / longest_side;
  by_position_.resize(own_.vertices.size());
  std::iota(by_position_.begin(), by_position_.end(), 0);
  std::ranges::stable_sort(by_position_, [&](std::int32_t a, std::int32_t b) {
    return before(normalized_.vertices[a], normalized_.vertices[b]);
  });
}

TriangleMesh ShapeFrame::to_own(const TriangleMesh& mesh) const {
  TriangleMesh result = mesh;
  for (Vec3& vertex : result.vertices) {
    const auto found = std::lower_bound(
        by_position_.begin(), by_position_.end(), vertex,
        [&](std::int32_t i, const Vec3& v) { return before(normalized_.vertices[i], v); });
    const bool original = found != by_position_.end() && normalized_.vertices[*found] == vertex;
    vertex = original ? own_.vertices[*found] : Vec3(vertex * scale_ + center_);
  }
  return result;
}

TriangleMesh ShapeFrame::to_normalized(const TriangleMesh& mesh) const {
  TriangleMesh result = mesh;
  for (Vec3& vertex : result.vertices) vertex = (vertex - center_) / scale_;
  return result;
}

}  // namespace fracbench
