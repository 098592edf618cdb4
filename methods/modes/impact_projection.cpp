#include "methods/modes/impact_projection.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "geometry/measures.h"
#include "methods/modes/join.h"
#include "methods/modes/sparse_cholesky.h"

namespace fracbench::modes {
namespace {

constexpr double kStep = 1.0 / 30;
constexpr Eigen::Index kColumnsAtOnce = 16;  // of the linear system, between two checks for a stop
constexpr int kSamples = 255;                // of the surface; odd: their median is one of them

/// M - h L of the tets.
Eigen::SparseMatrix<double> step_matrix(const TetMesh& tets) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(16 * tets.tets.size());
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const Tet& tet = tets.tets[t];
    const Vec3& a = tets.vertices[tet[0]];
    Mat3 edges;
    edges << tets.vertices[tet[1]] - a, tets.vertices[tet[2]] - a, tets.vertices[tet[3]] - a;
    // Gradients of the linear shape functions.
    Eigen::Matrix<double, 3, 4> gradient;
    gradient.rightCols<3>() = edges.inverse().transpose();
    gradient.col(0) = -gradient.rightCols<3>().rowwise().sum();
    const double volume = tets.volumes[t];
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const double stiffness = volume * gradient.col(i).dot(gradient.col(j));
        entries.emplace_back(tet[i], tet[j], (i == j ? volume / 4 : 0) + kStep * stiffness);
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(tets.vertices.size());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Column r: the share of region r's mass that each vertex carries.
Eigen::MatrixXd mass_shares(const TetMesh& tets, std::span<const std::int32_t> region_of_tet) {
  const std::int32_t regions = 1 + *std::ranges::max_element(region_of_tet);
  Eigen::MatrixXd shares =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(tets.vertices.size()), regions);
  std::vector<double> mass(regions, 0);
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const std::int32_t r = region_of_tet[t];
    mass[r] += tets.volumes[t];
    for (const std::int32_t v : tets.tets[t]) shares(v, r) += tets.volumes[t] / 4;
  }
  for (std::int32_t r = 0; r < regions; ++r) {
    if (mass[r] > 0) shares.col(r) /= mass[r];
  }
  return shares;
}

std::vector<ImpactProjection::Bond> find_bonds(const CutBody& cut) {
  std::map<std::array<std::int32_t, 2>, double> area;
  for (const auto& part : cut.interfaces) {
    const auto [low, high] = std::minmax(part.cells[0], part.cells[1]);
    const Vec3& o = cut.vertices[part.corners[0]];
    area[{low, high}] +=
        (cut.vertices[part.corners[1]] - o).cross(cut.vertices[part.corners[2]] - o).norm() / 2;
  }
  std::vector<ImpactProjection::Bond> bonds;
  for (const auto& [pieces, sum] : area) bonds.push_back({pieces, sum});
  return bonds;
}

std::vector<std::uint8_t> flags(std::int32_t count, std::span<const std::int32_t> set) {
  std::vector<std::uint8_t> result(count, 0);
  for (const std::int32_t n : set) result[n] = 1;
  return result;
}

/// For each of `count` pieces its place among `pieces`; -1: it is not there.
std::vector<std::int32_t> places(std::int32_t count, std::span<const std::int32_t> pieces) {
  std::vector<std::int32_t> place(count, -1);
  for (std::size_t n = 0; n < pieces.size(); ++n) place[pieces[n]] = static_cast<std::int32_t>(n);
  return place;
}

/// The vertices that an impulse at a point of the unit box reaches.
std::vector<std::int32_t> contact_vertices(const ImpactProjection& projection,
                                           const std::vector<std::uint8_t>& among,
                                           const Vec3& point) {
  std::vector<std::int32_t> near;
  std::int32_t nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < projection.vertices.size(); ++v) {
    const double distance2 = (projection.vertices[v] - point).squaredNorm();
    const bool reached = distance2 <= kContactRadius * kContactRadius;
    if (!reached && distance2 >= least) continue;
    const auto first = projection.piece_at.begin();
    if (!std::any_of(first + projection.piece_begin[v], first + projection.piece_begin[v + 1],
                     [&](std::int32_t piece) { return among[piece] != 0; })) {
      continue;
    }
    if (reached) near.push_back(static_cast<std::int32_t>(v));
    if (distance2 < least) {
      least = distance2;
      nearest = static_cast<std::int32_t>(v);
    }
  }
  if (near.empty() && nearest >= 0) near.push_back(nearest);
  return near;
}

}  // namespace

ImpactProjection project_impacts(const TetMesh& tets, const AtomicPieces& pieces,
                                 Context& context) {
  ImpactProjection projection;
  projection.frame = tets.frame;
  projection.vertices = tets.vertices;

  SparseCholesky solver;
  solver.factor(step_matrix(tets));
  Eigen::MatrixXd by_region = mass_shares(tets, pieces.region_of_tet);
  for (Eigen::Index first = 0; first < by_region.cols(); first += kColumnsAtOnce) {
    context.stop_if_asked();
    solver.solve(by_region.middleCols(first, std::min(kColumnsAtOnce, by_region.cols() - first)));
  }
  const auto count = static_cast<Eigen::Index>(pieces.regions.size());
  projection.response = Eigen::MatrixXd::Zero(by_region.rows(), count);
  std::vector<std::vector<std::int32_t>> pieces_of_region(by_region.cols());
  for (Eigen::Index p = 0; p < count; ++p) {
    double volume = 0;
    for (const RegionShare& share : pieces.regions[p]) {
      volume += share.volume;
      projection.response.col(p) += share.volume * by_region.col(share.region);
      pieces_of_region[share.region].push_back(static_cast<std::int32_t>(p));
    }
    projection.response.col(p) /= volume;
  }

  std::vector<std::set<std::int32_t>> at(tets.vertices.size());
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const auto& own = pieces_of_region[pieces.region_of_tet[t]];
    for (const std::int32_t v : tets.tets[t]) at[v].insert(own.begin(), own.end());
  }
  projection.piece_begin.push_back(0);
  for (const auto& own : at) {
    projection.piece_at.insert(projection.piece_at.end(), own.begin(), own.end());
    projection.piece_begin.push_back(static_cast<std::int32_t>(projection.piece_at.size()));
  }
  projection.bonds = find_bonds(pieces.cut);
  return projection;
}

Eigen::MatrixX3d piece_velocities(const ImpactProjection& projection,
                                  std::span<const std::int32_t> pieces,
                                  std::span<const Impulse> impulses, double density) {
  Eigen::MatrixX3d velocities = Eigen::MatrixX3d::Zero(projection.piece_count(), 3);
  const std::vector<std::uint8_t> among = flags(projection.piece_count(), pieces);
  const double size = projection.frame.size;
  for (const Impulse& impulse : impulses) {
    const std::vector<std::int32_t> reached =
        contact_vertices(projection, among, projection.frame.to_unit(impulse.point));
    if (reached.empty()) continue;
    const Vec3 momentum = impulse.magnitude / (density * size * size * size) * impulse.direction;
    for (const std::int32_t p : pieces) {
      double mean = 0;
      for (const std::int32_t v : reached) mean += projection.response(v, p);
      mean /= static_cast<double>(reached.size());
      velocities.row(p) += mean * momentum.transpose();
    }
  }
  return velocities;
}

double parting_jump(const ImpactProjection& projection, std::span<const std::int32_t> pieces,
                    const Eigen::MatrixX3d& velocities) {
  const std::vector<std::int32_t> place = places(projection.piece_count(), pieces);
  std::vector<std::pair<double, std::array<std::int32_t, 2>>> jumps;
  for (const auto& [pair, area] : projection.bonds) {
    const std::array<std::int32_t, 2> ends = {place[pair[0]], place[pair[1]]};
    if (ends[0] < 0 || ends[1] < 0) continue;
    jumps.emplace_back((velocities.row(pair[0]) - velocities.row(pair[1])).norm(), ends);
  }
  std::ranges::sort(jumps);
  std::vector<std::int32_t> parent(pieces.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  };
  double last = 0;
  for (const auto& [jump, ends] : jumps) {
    const std::int32_t a = root(ends[0]), b = root(ends[1]);
    if (a == b) continue;
    parent[a] = b;
    last = jump;
  }
  return last;
}

std::vector<std::int32_t> held_together(const ImpactProjection& projection,
                                        std::span<const std::int32_t> pieces,
                                        const Eigen::MatrixX3d& velocities, double threshold) {
  const std::vector<std::int32_t> place = places(projection.piece_count(), pieces);
  Joined groups(std::ssize(pieces));
  for (const auto& [pair, area] : projection.bonds) {
    const auto [a, b] = pair;
    if (place[a] < 0 || place[b] < 0) continue;
    if ((velocities.row(a) - velocities.row(b)).norm() < threshold) groups.join(place[a], place[b]);
  }
  return groups.labels();
}

double typical_jump(const ImpactProjection& projection, const TriangleMesh& body, double density) {
  std::vector<std::int32_t> all(projection.piece_count());
  std::iota(all.begin(), all.end(), 0);
  const double total = area(body);
  std::vector<double> jumps;
  double passed = 0;
  for (std::size_t f = 0; f < body.faces.size() && jumps.size() < kSamples; ++f) {
    passed += area_vector2(body, f).norm() / 2;
    while (jumps.size() < kSamples &&
           passed >= (static_cast<double>(jumps.size()) + 0.5) / kSamples * total) {
      Impulse impulse;
      impulse.point = (body.corner(f, 0) + body.corner(f, 1) + body.corner(f, 2)) / 3;
      impulse.direction = impulse.normal = Vec3::UnitX();
      impulse.magnitude = 1;
      jumps.push_back(parting_jump(
          projection, all, piece_velocities(projection, all, std::span(&impulse, 1), density)));
    }
  }
  if (jumps.empty()) return 0;
  const auto middle = jumps.begin() + static_cast<std::ptrdiff_t>(jumps.size() / 2);
  std::ranges::nth_element(jumps, middle);
  return *middle;
}

}  // namespace fracbench::modes
