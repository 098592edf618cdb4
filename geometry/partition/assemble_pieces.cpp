#include "geometry/partition/assemble_pieces.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/parallel.h"
#include "core/sum.h"
#include "geometry/components.h"
#include "geometry/measures.h"

namespace fracbench::partition {
namespace {

/// A face of a cell: a part of the body's surface, or one side of a part of an interface.
struct CellFace {
  enum class Kind : std::uint8_t { body, below, above } kind;
  std::int32_t part;
};

/// Makes meshes of faces. Keeps room for one number per vertex of the arrangement, so that a mesh
/// takes time in proportion to its own size.
class MeshMaker {
 public:
  explicit MeshMaker(const Arrangement& arrangement)
      : arrangement_(arrangement), number_(arrangement.vertices.size(), -1) {}

  /// With the vertices in the order of the arrangement.
  TriangleMesh mesh_of(const std::vector<CellFace>& faces) {
    TriangleMesh mesh;
    mesh.faces.reserve(faces.size());
    std::vector<std::int32_t> used;
    used.reserve(faces.size() / 2 + 2);
    for (const CellFace& f : faces) {
      const bool body = f.kind == CellFace::Kind::body;
      Face corners =
          body ? arrangement_.body[f.part].corners : arrangement_.interfaces[f.part].corners;
      if (f.kind == CellFace::Kind::above) std::swap(corners[1], corners[2]);
      for (const std::int32_t v : corners) {
        if (number_[v] >= 0) continue;
        number_[v] = 0;
        used.push_back(v);
      }
      mesh.faces.push_back(corners);
    }
    std::sort(used.begin(), used.end());
    mesh.vertices.reserve(used.size());
    for (const std::int32_t v : used) {
      number_[v] = static_cast<std::int32_t>(mesh.vertices.size());
      mesh.vertices.push_back(arrangement_.vertices[v]);
    }
    for (Face& f : mesh.faces) {
      for (std::int32_t& v : f) v = number_[v];
    }
    for (const std::int32_t v : used) number_[v] = -1;
    return mesh;
  }

 private:
  const Arrangement& arrangement_;
  std::vector<std::int32_t> number_;
};

/// Calls work(i, maker) for every i below `count`, with a maker per thread.
template <typename Work>
void parallel_meshes(const Arrangement& arrangement, std::size_t count, int threads,
                     const Work& work) {
  const std::size_t workers = std::clamp<std::size_t>(count, 1, std::max(1, threads));
  parallel_for(workers, threads, [&](std::size_t worker) {
    MeshMaker maker(arrangement);
    for (std::size_t i = worker; i < count; i += workers) work(i, maker);
  });
}

/// The faces of each connected solid of a closed manifold.
std::vector<std::vector<std::int32_t>> solids_of(const TriangleMesh& mesh) {
  std::vector<std::int32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Face& f : mesh.faces) {
    for (int k = 1; k < 3; ++k) {
      const std::int32_t a = root(f[0]), b = root(f[k]);
      if (a != b) parent[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<std::vector<std::int32_t>> shells;
  std::vector<std::int32_t> shell_of(parent.size(), -1);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    std::int32_t& shell = shell_of[root(mesh.faces[f][0])];
    if (shell < 0) {
      shell = static_cast<std::int32_t>(shells.size());
      shells.emplace_back();
    }
    shells[shell].push_back(static_cast<std::int32_t>(f));
  }
  return solids_of_shells(mesh, std::move(shells));
}

/// The connected solids of all regions.
struct Cells {
  std::vector<std::int32_t> region;
  std::vector<double> volume;
  std::vector<std::int32_t> of_body;                      ///< per part
  std::vector<std::array<std::int32_t, 2>> of_interface;  ///< per part: below, above
  /// Per cell its mesh, where it is the only one of its region (else empty); the faces in the order
  /// of the arrangement's parts.
  std::vector<TriangleMesh> mesh;
};

Cells find_cells(const Arrangement& arrangement, std::size_t regions, int threads) {
  std::vector<std::vector<CellFace>> faces(regions + 1);
  for (std::size_t n = 0; n < arrangement.body.size(); ++n) {
    faces[arrangement.body[n].region].push_back(
        {CellFace::Kind::body, static_cast<std::int32_t>(n)});
  }
  for (std::size_t n = 0; n < arrangement.interfaces.size(); ++n) {
    const auto& sides = arrangement.interfaces[n].regions;
    faces[sides[0]].push_back({CellFace::Kind::below, static_cast<std::int32_t>(n)});
    faces[sides[1]].push_back({CellFace::Kind::above, static_cast<std::int32_t>(n)});
  }
  struct Found {
    std::vector<std::vector<std::int32_t>> faces;  // per solid, into those of the region
    std::vector<double> volume;
    TriangleMesh mesh;
  };
  std::vector<Found> found(regions + 1);
  parallel_meshes(arrangement, regions, threads, [&](std::size_t n, MeshMaker& maker) {
    const std::vector<CellFace>& own = faces[n + 1];
    if (own.empty()) return;
    Found& here = found[n + 1];
    here.mesh = maker.mesh_of(own);
    here.faces = solids_of(here.mesh);
    if (here.faces.size() == 1) {
      here.volume.push_back(volume(here.mesh));
      return;
    }
    std::vector<CellFace> part;
    for (const auto& solid : here.faces) {
      part.clear();
      for (const std::int32_t f : solid) part.push_back(own[f]);
      here.volume.push_back(volume(maker.mesh_of(part)));
    }
    here.mesh = {};
  });
  Cells cells;
  cells.of_body.assign(arrangement.body.size(), -1);
  cells.of_interface.assign(arrangement.interfaces.size(), {-1, -1});
  for (std::size_t r = 1; r <= regions; ++r) {
    for (std::size_t solid = 0; solid < found[r].faces.size(); ++solid) {
      const auto cell = static_cast<std::int32_t>(cells.region.size());
      cells.region.push_back(static_cast<std::int32_t>(r));
      cells.volume.push_back(found[r].volume[solid]);
      cells.mesh.push_back(std::move(found[r].mesh));
      for (const std::int32_t f : found[r].faces[solid]) {
        const CellFace& face = faces[r][f];
        if (face.kind == CellFace::Kind::body) {
          cells.of_body[face.part] = cell;
        } else {
          cells.of_interface[face.part][face.kind == CellFace::Kind::above] = cell;
        }
      }
    }
  }
  return cells;
}

/// For each cell the one that it went to: itself where it stays.
std::vector<std::int32_t> merge_small_cells(const Arrangement& arrangement, const Cells& cells,
                                            double minimum_volume, PartitionReport& report) {
  const std::size_t count = cells.region.size();
  std::vector<std::int32_t> target(count);
  std::iota(target.begin(), target.end(), 0);
  std::set<std::pair<double, std::int32_t>> small;
  for (std::size_t c = 0; c < count; ++c) {
    if (cells.volume[c] < minimum_volume) {
      small.emplace(cells.volume[c], static_cast<std::int32_t>(c));
    }
  }
  if (small.empty()) return target;
  std::vector<std::map<std::int32_t, double>> shared(count);  // area with each neighbour
  for (std::size_t n = 0; n < arrangement.interfaces.size(); ++n) {
    const auto [a, b] = cells.of_interface[n];
    if (a == b) continue;
    const Face& f = arrangement.interfaces[n].corners;
    const Vec3& o = arrangement.vertices[f[0]];
    const double area2 =
        (arrangement.vertices[f[1]] - o).cross(arrangement.vertices[f[2]] - o).norm();
    shared[a][b] += area2;
    shared[b][a] += area2;
  }
  std::vector<double> volume = cells.volume;
  while (!small.empty()) {
    const std::int32_t c = small.begin()->second;
    small.erase(small.begin());
    if (shared[c].empty()) {
      ++report.small_parts_kept;
      continue;
    }
    const std::int32_t to =
        std::max_element(shared[c].begin(), shared[c].end(), [](const auto& l, const auto& r) {
          return l.second < r.second;
        })->first;
    ++report.merged_parts;
    report.merged_volume += volume[c];
    const bool was_small = small.erase({volume[to], to}) > 0;
    volume[to] += volume[c];
    if (was_small && volume[to] < minimum_volume) small.emplace(volume[to], to);
    for (const auto& [other, area2] : shared[c]) {
      shared[other].erase(c);
      if (other == to) continue;
      shared[other][to] += area2;
      shared[to][other] += area2;
    }
    shared[c].clear();
    target[c] = to;
  }
  for (std::size_t c = 0; c < count; ++c) {
    std::int32_t last = target[c];
    while (target[last] != last) last = target[last];
    target[c] = last;
  }
  return target;
}

}  // namespace

void report_labels(const std::vector<std::int32_t>& labels, PartitionReport& report) {
  std::map<std::int32_t, int> pieces;
  for (const std::int32_t label : labels) pieces[label] = 0;
  for (const std::int32_t label : report.piece_label) ++pieces[label];
  for (const auto& [label, count] : pieces) {
    if (count == 0) report.labels_without_piece.push_back(label);
    if (count > 1) report.split_labels.push_back(label);
  }
}

Partition assemble_pieces(const Arrangement& arrangement, const std::vector<std::int32_t>& labels,
                          double minimum_volume, int threads) {
  Partition partition;
  Cells cells = find_cells(arrangement, labels.size(), threads);
  const auto target = merge_small_cells(arrangement, cells, minimum_volume, partition.report);
  // Cells are by ascending region, hence by ascending label.
  std::vector<std::int32_t> piece_of(cells.region.size(), -1);
  for (std::size_t c = 0; c < target.size(); ++c) {
    if (target[c] != static_cast<std::int32_t>(c)) continue;
    piece_of[c] = static_cast<std::int32_t>(partition.report.piece_label.size());
    partition.report.piece_label.push_back(labels[cells.region[c] - 1]);
  }
  for (std::size_t c = 0; c < target.size(); ++c) piece_of[c] = piece_of[target[c]];

  std::vector<std::vector<CellFace>> faces(partition.report.piece_label.size());
  partition.pieces.resize(faces.size());
  for (std::size_t n = 0; n < arrangement.body.size(); ++n) {
    const std::int32_t piece = piece_of[cells.of_body[n]];
    faces[piece].push_back({CellFace::Kind::body, static_cast<std::int32_t>(n)});
    partition.pieces[piece].faces.push_back({arrangement.body[n].source, -1});
  }
  for (std::size_t n = 0; n < arrangement.interfaces.size(); ++n) {
    const std::int32_t below = piece_of[cells.of_interface[n][0]];
    const std::int32_t above = piece_of[cells.of_interface[n][1]];
    if (below == above) continue;
    faces[below].push_back({CellFace::Kind::below, static_cast<std::int32_t>(n)});
    faces[above].push_back({CellFace::Kind::above, static_cast<std::int32_t>(n)});
    partition.pieces[below].faces.push_back({-1, above});
    partition.pieces[above].faces.push_back({-1, below});
  }
  std::vector<std::int32_t> only_cell(faces.size(), -1);  // -2: made of several
  for (std::size_t c = 0; c < piece_of.size(); ++c) {
    std::int32_t& only = only_cell[piece_of[c]];
    only = only == -1 ? static_cast<std::int32_t>(c) : -2;
  }
  parallel_meshes(arrangement, faces.size(), threads, [&](std::size_t piece, MeshMaker& maker) {
    const std::int32_t cell = only_cell[piece];
    const bool made = cell >= 0 && !cells.mesh[cell].empty();
    partition.pieces[piece].mesh = made ? std::move(cells.mesh[cell]) : maker.mesh_of(faces[piece]);
  });
  report_labels(labels, partition.report);
  return partition;
}

}  // namespace fracbench::partition
