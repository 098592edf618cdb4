#include "geometry/surface_distance.h"

#include <cmath>

#include "geometry/line_crossing.h"
#include "geometry/triangle_tree.h"

namespace fracbench {
namespace {

/// Ray against triangle without gaps along shared edges: both faces see the same edge value (Woop,
/// Benthin, Wald, "Watertight ray/triangle intersection", 2013).
class Ray {
 public:
  Ray(const Vec3& origin, const Vec3& direction) : origin_(origin) {
    direction.cwiseAbs().maxCoeff(&z_);
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    shear_x_ = direction[x_] / direction[z_];
    shear_y_ = direction[y_] / direction[z_];
    scale_z_ = 1 / direction[z_];
  }

  /// The parameter of the hit; negative: none.
  double hit(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Vec3 p = shear(a), q = shear(b), r = shear(c);
    const double u = r.x() * q.y() - r.y() * q.x();
    const double v = p.x() * r.y() - p.y() * r.x();
    const double w = q.x() * p.y() - q.y() * p.x();
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return -1;
    const double sum = u + v + w;
    if (sum == 0) return -1;
    return (u * p.z() + v * q.z() + w * r.z()) / sum;
  }

 private:
  /// In a frame in which the ray is the z axis and z is its parameter.
  Vec3 shear(const Vec3& point) const {
    const Vec3 p = point - origin_;
    return {p[x_] - shear_x_ * p[z_], p[y_] - shear_y_ * p[z_], scale_z_ * p[z_]};
  }

  Vec3 origin_;
  int x_ = 0, y_ = 1, z_ = 2;
  double shear_x_ = 0, shear_y_ = 0, scale_z_ = 1;
};

}  // namespace

struct SurfaceDistance::Tree {
  TriangleMesh mesh;
  TriangleTree triangles;

  explicit Tree(const TriangleMesh& source) : mesh(source), triangles(source) {}
};

SurfaceDistance::SurfaceDistance(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
SurfaceDistance::~SurfaceDistance() = default;
SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;
SurfaceDistance& SurfaceDistance::operator=(SurfaceDistance&&) noexcept = default;

SurfaceDistance::Nearest SurfaceDistance::nearest(const Vec3& query) const {
  const TriangleTree::Nearest found = tree_->triangles.nearest(query);
  if (found.triangle < 0) return {};
  const TreeTriangle& triangle = tree_->triangles.triangles()[found.triangle];
  return {closest_point(triangle, query), triangle.face, std::sqrt(found.squared_distance)};
}

bool SurfaceDistance::inside(const Vec3& query) const {
  const Eigen::Vector3f q = tree_->triangles.to_box_frame(query);
  int winding = 0;
  tree_->triangles.visit(
      [&](const TriangleTree::Node& node) {
        unsigned mask = 0;
        for (int k = 0; k < 4; ++k) {
          const bool passes = node.high[0][k] >= q[0] && node.low[1][k] <= q[1] &&
                              node.high[1][k] >= q[1] && node.low[2][k] <= q[2] &&
                              node.high[2][k] >= q[2];
          mask |= static_cast<unsigned>(passes) << k;
        }
        return mask;
      },
      [&](std::int32_t index) {
        const std::int32_t face = tree_->triangles.triangles()[index].face;
        const Vec3 &a = tree_->mesh.corner(face, 0), &b = tree_->mesh.corner(face, 1),
                   &c = tree_->mesh.corner(face, 2);
        const int crossing = line_crossing(a, b, c, query.y(), query.z());
        if (crossing != 0 && !is_beyond(a, b, c, crossing, query)) winding += crossing;
      });
  return winding != 0;
}

double SurfaceDistance::signed_distance(const Vec3& query) const {
  const double distance = std::sqrt(tree_->triangles.nearest(query).squared_distance);
  return inside(query) ? distance : -distance;
}

SurfaceDistance::Hit SurfaceDistance::first_hit(const Vec3& origin, const Vec3& direction) const {
  Hit best;
  if (direction.isZero(0)) return best;
  best.t = std::numeric_limits<double>::infinity();
  const Ray ray(origin, direction);

  // The slabs of the boxes, in their frame, in double precision.
  const TriangleTree& tree = tree_->triangles;
  const Vec3 from = (origin - tree.box_center()) * tree.box_scale();
  const Vec3 along = direction * tree.box_scale();
  tree.visit(
      [&](const TriangleTree::Node& node) {
        unsigned mask = 0;
        for (int k = 0; k < 4; ++k) {
          double enter = 0, leave = best.t * (1 + 1e-12);
          for (int axis = 0; axis < 3; ++axis) {
            const double low = node.low[axis][k], high = node.high[axis][k];
            if (along[axis] == 0) {
              if (from[axis] < low || from[axis] > high) leave = -1;
              continue;
            }
            const double t0 = (low - from[axis]) / along[axis];
            const double t1 = (high - from[axis]) / along[axis];
            enter = std::max(enter, std::min(t0, t1) * (1 - 1e-12));
            leave = std::min(leave, std::max(t0, t1) * (1 + 1e-12));
          }
          mask |= static_cast<unsigned>(enter <= leave) << k;
        }
        return mask;
      },
      [&](std::int32_t index) {
        const std::int32_t face = tree.triangles()[index].face;
        const double t = ray.hit(tree_->mesh.corner(face, 0), tree_->mesh.corner(face, 1),
                                 tree_->mesh.corner(face, 2));
        if (t >= 0 && (t < best.t || (t == best.t && face < best.face))) best = {t, face};
      });
  if (best.face < 0) best.t = 0;
  return best;
}

}  // namespace fracbench
