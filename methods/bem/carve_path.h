#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace fracbench::bem {

/// A curve to be drawn on a surface: points near it, and at each the direction in which the wall
/// stands that cuts the surface along the curve (for a crack: the way out, in the crack's plane).
struct SurfaceCurve {
  std::vector<Vec3> points;
  std::vector<Vec3> walls;
  bool closed = false;
};

/// A closed surface into which curves are carved, so that they run along its edges. Between two
/// points a curve is the cut with the plane through both that contains the mean wall direction.
/// Where it crosses an edge, the edge is split; near an end (a quarter of its length), that vertex
/// is moved onto the curve instead, or, on a sharp edge of the surface or on another curve, left
/// where it is, so that the curve bends. No triangle is turned over or becomes a sliver by it, and
/// the surface stays closed.
class CarvedSurface {
 public:
  explicit CarvedSurface(TriangleMesh closed_surface);

  /// Carves one more curve. Its number, from 0; nothing where the curve cannot be followed over the
  /// surface or would be shorter than two edges (the surface may have some edges more then).
  std::optional<std::size_t> carve(const SurfaceCurve& curve);

  const TriangleMesh& mesh() const { return mesh_; }
  /// For each face of mesh() the face of the given surface that it is (a part of).
  const std::vector<std::int32_t>& source() const { return source_; }
  /// The vertices along a curve, in its order; a closed one without the first at the end. Later
  /// curves that cross it add vertices.
  const std::vector<std::int32_t>& path(std::size_t curve) const { return paths_[curve].vertices; }

 private:
  using Edge = std::pair<std::int32_t, std::int32_t>;
  /// A place on the surface: on an edge, at a vertex (both the same), or within a face (a < 0).
  struct Stop {
    std::int32_t a = -1;
    std::int32_t b = -1;
    double weight = 0;  ///< of b
    std::int32_t face = -1;
    Vec3 position = Vec3::Zero();
  };
  struct Path {
    std::vector<std::int32_t> vertices;
    bool closed = false;
  };

  std::optional<std::vector<Stop>> follow(const SurfaceCurve& curve) const;
  std::optional<Stop> exit(std::int32_t face, const Vec3& origin, const Vec3& normal,
                           const Vec3& along, const Edge& entry) const;
  std::int32_t place(const Stop& stop);
  std::int32_t split_edge(std::int32_t a, std::int32_t b, const Vec3& position);
  std::int32_t split_face(std::int32_t face, const Vec3& position);
  bool may_move(std::int32_t vertex, const Vec3& to) const;
  /// Throws MethodFailure where there is none: the surface came apart.
  std::int32_t face_left_of(std::int32_t from, std::int32_t to) const;
  std::vector<std::int32_t> faces_around(std::int32_t vertex) const;
  std::vector<std::int32_t> faces_at(const Stop& stop) const;
  bool share_face(const Stop& one, const Stop& other) const;
  void set_face(std::int32_t face, const Face& corners);

  TriangleMesh mesh_;
  std::vector<std::int32_t> source_;
  std::map<Edge, std::int32_t> face_of_;  ///< the face to the left of each directed edge
  std::vector<std::int32_t> some_face_;   ///< one face at each vertex
  std::vector<bool> on_path_;             ///< for each vertex
  std::vector<Path> paths_;
};

}  // namespace fracbench::bem
