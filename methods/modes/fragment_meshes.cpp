#include "methods/modes/fragment_meshes.h"

#include <algorithm>

#include "core/parallel.h"
#include "methods/modes/fans.h"

namespace fracbench::modes {
namespace {

Face corners_of(const CutBody& cut, FaceRef ref) {
  if (ref.is_surface()) return cut.surface[ref.part()].corners;
  Face corners = cut.interfaces[ref.part()].corners;
  if (ref.side() == 1) std::swap(corners[1], corners[2]);
  return corners;
}

}  // namespace

TriangleMesh MeshMaker::mesh_of(std::span<const Face> faces) {
  TriangleMesh mesh;
  mesh.faces.resize(faces.size());
  mesh.vertices.reserve(faces.size() / 2 + 2);
  used_.clear();
  deferred_.clear();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = faces[f][k];
      if (may_pinch_[v]) {
        deferred_.push_back({v, static_cast<std::int32_t>(f), static_cast<std::int8_t>(k)});
        continue;
      }
      std::int32_t& number = number_[v];
      if (number < 0) {
        number = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vertices_[v]);
        used_.push_back(v);
      }
      mesh.faces[f][k] = number;
    }
  }
  for (const std::int32_t v : used_) number_[v] = -1;
  std::ranges::stable_sort(deferred_, {}, &Deferred::vertex);
  for (std::size_t begin = 0; begin < deferred_.size();) {
    std::size_t end = begin + 1;
    while (end < deferred_.size() && deferred_[end].vertex == deferred_[begin].vertex) ++end;
    around_.clear();
    for (std::size_t n = begin; n < end; ++n) around_.push_back(faces[deferred_[n].face]);
    const std::int32_t v = deferred_[begin].vertex;
    const std::vector<std::int32_t> fan =
        is_plain_fan(v, around_) ? std::vector<std::int32_t>() : fans_at(v, around_, vertices_);
    const auto first = static_cast<std::int32_t>(mesh.vertices.size());
    for (std::size_t n = begin; n < end; ++n) {
      const std::int32_t number = first + (fan.empty() ? 0 : fan[n - begin]);
      if (number == std::ssize(mesh.vertices)) mesh.vertices.push_back(vertices_[v]);
      mesh.faces[deferred_[n].face][deferred_[n].corner] = number;
    }
    begin = end;
  }
  return mesh;
}

CellFaces::CellFaces(const CutBody& cut) : begin_(cut.cells.size() + 1, 0) {
  const auto for_each = [&](const auto& visit) {
    for (std::size_t n = 0; n < cut.surface.size(); ++n) {
      visit(cut.surface[n].cell, FaceRef::surface(n));
    }
    for (std::size_t n = 0; n < cut.interfaces.size(); ++n) {
      for (int side = 0; side < 2; ++side) {
        visit(cut.interfaces[n].cells[side], FaceRef::interface(n, side));
      }
    }
  };
  for_each([&](std::int32_t cell, FaceRef) { ++begin_[cell + 1]; });
  for (std::size_t c = 0; c < cut.cells.size(); ++c) begin_[c + 1] += begin_[c];
  faces_.resize(begin_.back(), FaceRef::surface(0));
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each([&](std::int32_t cell, FaceRef ref) { faces_[next[cell]++] = ref; });
}

std::vector<Piece> make_pieces(const FragmentSource& source,
                               std::span<const std::int32_t> body_cells,
                               std::span<const std::int32_t> group_of_cell, bool whole,
                               int threads) {
  const CutBody& cut = source.cut;
  std::vector<std::int32_t> group(cut.cells.size(), -1);  // -1: not of the body
  std::int32_t groups = 0;
  for (std::size_t n = 0; n < body_cells.size(); ++n) {
    group[body_cells[n]] = group_of_cell[n];
    groups = std::max(groups, group_of_cell[n] + 1);
  }
  // The body's own faces are those whose other side is not of the body, in this order.
  const auto other_group = [&](FaceRef ref) {
    if (ref.is_surface()) return -1;
    const std::int32_t other = cut.interfaces[ref.part()].cells[1 - ref.side()];
    return group[other];
  };
  struct Own {
    std::vector<FaceRef> refs;
    std::vector<PieceFace> faces;
  };
  std::vector<Own> own(groups);
  std::vector<std::size_t> sizes(groups, 0);
  for (const std::int32_t cell : body_cells) sizes[group[cell]] += source.faces.of(cell).size();
  for (std::int32_t g = 0; g < groups; ++g) {
    own[g].refs.reserve(sizes[g]);
    own[g].faces.reserve(sizes[g]);
  }
  std::int32_t body_face = 0;
  for (const std::int32_t cell : body_cells) {
    Own& piece = own[group[cell]];
    for (const FaceRef ref : source.faces.of(cell)) {
      const std::int32_t other = other_group(ref);
      if (other == group[cell]) continue;
      PieceFace face{-1, other};
      if (other < 0) {
        face.parent_face = whole ? cut.surface[ref.part()].source : body_face;
        ++body_face;
      }
      piece.refs.push_back(ref);
      piece.faces.push_back(face);
    }
  }
  std::vector<Piece> pieces(groups);
  const auto workers = static_cast<std::size_t>(std::clamp(threads, 1, std::max(1, groups)));
  parallel_for(workers, threads, [&](std::size_t worker) {
    MeshMaker maker(cut.vertices, cut.may_pinch);
    std::vector<Face> faces;
    for (std::size_t g = worker; g < pieces.size(); g += workers) {
      faces.clear();
      for (const FaceRef ref : own[g].refs) faces.push_back(corners_of(cut, ref));
      pieces[g].mesh = maker.mesh_of(faces);
      pieces[g].faces = std::move(own[g].faces);
    }
  });
  return pieces;
}

}  // namespace fracbench::modes
