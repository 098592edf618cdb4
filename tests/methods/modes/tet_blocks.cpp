#include "tests/methods/modes/tet_blocks.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace fracbench::test {

using modes::Tet;
using modes::TetMesh;

TetMesh tet_block(const std::array<int, 3>& cubes, const Vec3& low, const Vec3& high) {
  const Vec3 side = high - low;
  modes::UnitBox frame;
  frame.center = (low + high) / 2;
  frame.size = side.maxCoeff();
  std::vector<Vec3> vertices;
  const auto vertex = [&](int i, int j, int k) {
    return i + (cubes[0] + 1) * (j + (cubes[1] + 1) * k);
  };
  for (int k = 0; k <= cubes[2]; ++k) {
    for (int j = 0; j <= cubes[1]; ++j) {
      for (int i = 0; i <= cubes[0]; ++i) {
        const Vec3 share(static_cast<double>(i) / cubes[0], static_cast<double>(j) / cubes[1],
                         static_cast<double>(k) / cubes[2]);
        vertices.push_back(frame.to_unit(low + side.cwiseProduct(share)));
      }
    }
  }
  std::vector<Tet> tets;
  for (int k = 0; k < cubes[2]; ++k) {
    for (int j = 0; j < cubes[1]; ++j) {
      for (int i = 0; i < cubes[0]; ++i) {
        std::array<int, 3> axes = {0, 1, 2};
        do {
          std::array<int, 3> at = {i, j, k};
          Tet tet;
          tet[0] = vertex(at[0], at[1], at[2]);
          for (int n = 0; n < 3; ++n) {
            ++at[axes[n]];
            tet[n + 1] = vertex(at[0], at[1], at[2]);
          }
          tets.push_back(tet);
        } while (std::ranges::next_permutation(axes).found);
      }
    }
  }
  return modes::make_tet_mesh(std::move(vertices), std::move(tets), frame);
}

TetMesh shaken(const TetMesh& tets, double share, Random& random) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Tet& tet : tets.tets) {
    for (int k = 1; k < 4; ++k) {
      shortest = std::min(shortest, (tets.vertices[tet[k]] - tets.vertices[tet[0]]).norm());
    }
  }
  std::vector<Vec3> vertices = tets.vertices;
  for (Vec3& v : vertices) v += share * shortest * random.uniform() * random.unit_vector();
  return modes::make_tet_mesh(std::move(vertices), tets.tets, tets.frame);
}

TriangleMesh surface_of(const TetMesh& tets) {
  TriangleMesh mesh;
  std::vector<std::int32_t> number(tets.vertices.size(), -1);
  for (const auto& face : tets.boundary_faces) {
    Face corners;
    for (int k = 0; k < 3; ++k) {
      std::int32_t& n = number[face.corners[k]];
      if (n < 0) {
        n = static_cast<std::int32_t>(mesh.vertices.size());
        mesh.vertices.push_back(tets.frame.to_body(tets.vertices[face.corners[k]]));
      }
      corners[k] = n;
    }
    mesh.faces.push_back(corners);
  }
  return mesh;
}

Vec3 centroid(const TetMesh& tets, std::size_t tet) {
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t v : tets.tets[tet]) sum += tets.vertices[v];
  return sum / 4;
}

std::vector<std::int32_t> voronoi_regions(const TetMesh& tets, int count, Random& random) {
  std::vector<Vec3> sites;
  for (int n = 0; n < count; ++n) sites.push_back(centroid(tets, random.below(tets.tets.size())));
  std::vector<std::int32_t> region;
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const Vec3 at = centroid(tets, t);
    const auto nearest = std::ranges::min_element(
        sites, {}, [&](const Vec3& site) { return (site - at).squaredNorm(); });
    region.push_back(static_cast<std::int32_t>(nearest - sites.begin()));
  }
  return region;
}

std::vector<std::int32_t> random_regions(const TetMesh& tets, int count, Random& random) {
  std::vector<std::int32_t> region(tets.tets.size());
  for (std::int32_t& r : region) {
    r = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(count)));
  }
  return region;
}

std::vector<std::int32_t> slabs(const TetMesh& tets, int count) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& v : tets.vertices) {
    low = std::min(low, v.x());
    high = std::max(high, v.x());
  }
  std::vector<std::int32_t> region;
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const double share = (centroid(tets, t).x() - low) / (high - low);
    region.push_back(std::clamp(static_cast<int>(share * count), 0, count - 1));
  }
  return region;
}

}  // namespace fracbench::test
