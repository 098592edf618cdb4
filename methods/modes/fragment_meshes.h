#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/breakable.h"
#include "core/triangle_mesh.h"
#include "methods/modes/cut_body.h"

namespace fracbench::modes {

/// A face of a cell: a part of the body's surface, or one side of a part of an interface.
class FaceRef {
 public:
  static FaceRef surface(std::size_t part) { return FaceRef(static_cast<std::int32_t>(part)); }
  /// Side 0 has its solid behind the part's normal, side 1 in front of it.
  static FaceRef interface(std::size_t part, int side) {
    return FaceRef(-1 - (2 * static_cast<std::int32_t>(part) + side));
  }
  bool is_surface() const { return code_ >= 0; }
  std::int32_t part() const { return code_ >= 0 ? code_ : (-1 - code_) / 2; }
  int side() const { return (-1 - code_) & 1; }

 private:
  explicit FaceRef(std::int32_t code) : code_(code) {}
  std::int32_t code_;
};

/// Makes meshes of faces that bound solids. Keeps room for one number per vertex, so that a mesh
/// takes time in proportion to its own size.
class MeshMaker {
 public:
  /// Refers to both; `may_pinch`: the vertices at which the faces may have several fans.
  MeshMaker(std::span<const Vec3> vertices, std::span<const std::uint8_t> may_pinch)
      : vertices_(vertices), may_pinch_(may_pinch), number_(vertices.size(), -1) {}

  /// The faces in their order, with the vertices that they use in the order of their use, one for
  /// each fan around them (see fans_at).
  TriangleMesh mesh_of(std::span<const Face> faces);

 private:
  std::span<const Vec3> vertices_;
  std::span<const std::uint8_t> may_pinch_;
  std::vector<std::int32_t> number_;

  // Kept between meshes for their memory only.
  struct Deferred {  ///< a corner of a face at a vertex that may need several copies
    std::int32_t vertex;
    std::int32_t face;
    std::int8_t corner;
  };
  std::vector<std::int32_t> used_;
  std::vector<Deferred> deferred_;
  std::vector<Face> around_;
};

/// The faces of each cell of a cut body.
class CellFaces {
 public:
  explicit CellFaces(const CutBody& cut);
  std::span<const FaceRef> of(std::int32_t cell) const {
    return std::span(faces_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<FaceRef> faces_;
};

/// A cut body for making fragments of it.
struct FragmentSource {
  const CutBody& cut;
  const CellFaces& faces;
};

/// Pieces of a body that consists of the cells `body_cells` (ascending), which fall into the groups
/// 0, 1, ... : group_of_cell[k] is that of body_cells[k]; each group is connected. The faces of a
/// piece are those of its cells in their order, without the interfaces within it; so a piece's
/// faces are numbered as those of a body of the same cells. `whole`: the body is the uncut mesh
/// itself, whose faces are numbered as in CutBody::SurfacePart::source. The pieces have no `next`.
/// The same bytes for any number of threads.
std::vector<Piece> make_pieces(const FragmentSource& source,
                               std::span<const std::int32_t> body_cells,
                               std::span<const std::int32_t> group_of_cell, bool whole,
                               int threads);

}  // namespace fracbench::modes
