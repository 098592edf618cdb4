#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/context.h"
#include "core/impact.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// Where a face of a piece comes from.
struct PieceFace {
  /// The face of the broken body's mesh that this face lies on; -1: it is fracture surface.
  std::int32_t parent_face = -1;
  /// For fracture surface: the index of the piece on the other side; -1: not known.
  std::int32_t neighbour = -1;

  bool is_fracture() const { return parent_face < 0; }
  bool operator==(const PieceFace&) const = default;
};

class Breakable;

/// One piece of a broken body, in the body's own frame.
struct Piece {
  TriangleMesh mesh;             ///< closed and outward oriented
  std::vector<PieceFace> faces;  ///< parallel to mesh.faces
  /// How this piece may break again (partial cracks, remaining modes); null: it cannot.
  std::shared_ptr<const Breakable> next;
};

/// A body that can break, prepared by a method. Stateless towards its caller: one object serves
/// many impacts, from many threads.
class Breakable {
 public:
  virtual ~Breakable() = default;

  /// The pieces that `impact` breaks the body into; a single piece means that it stays whole.
  /// Throws MethodFailure where the method cannot answer, Cancelled when asked to stop.
  virtual std::vector<Piece> fracture(const Impact& impact, Context& context) const = 0;

  /// Writes the prepared state below `folder`, which exists and is empty.
  virtual void save(const std::filesystem::path& folder) const = 0;
};

}  // namespace fracbench
