#include "methods/cvd/voronoi_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/random.h"
#include "methods/cvd/predicates.h"

namespace fracbench::cvd {
namespace {

const BoundingBox kBox{Vec3::Constant(-1), Vec3::Constant(1)};

std::vector<Vec3> random_sites(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> sites;
  for (std::size_t s = 0; s < count; ++s) {
    sites.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  }
  return sites;
}

Vec3 place(const VoronoiCells& cells, std::int32_t vertex) {
  const auto& [i, j, k, l] = cells.vertices[vertex].sites;
  return voronoi_vertex(cells.sites[i], cells.sites[j], cells.sites[k], cells.sites[l]);
}

TEST(VoronoiCells, HaveVerticesAsFarFromFourSitesAndFartherFromAllOthers) {
  const VoronoiCells cells = voronoi_cells(random_sites(60, 1), kBox);
  ASSERT_GT(cells.vertices.size(), 100u);
  for (std::size_t v = 0; v < cells.vertices.size(); ++v) {
    const Vec3 x = place(cells, static_cast<std::int32_t>(v));
    const double distance = (x - cells.sites[cells.vertices[v].sites[0]]).norm();
    for (std::size_t s = 0; s < cells.sites.size(); ++s) {
      const bool own =
          std::ranges::count(cells.vertices[v].sites, static_cast<std::int32_t>(s)) > 0;
      if (own) {
        EXPECT_NEAR((x - cells.sites[s]).norm(), distance, 1e-12);
      } else {
        EXPECT_GT((x - cells.sites[s]).norm(), distance);
      }
    }
  }
}

TEST(VoronoiCells, HaveEdgesThatRunAlongTheirDirectionFromStartToEnd) {
  const VoronoiCells cells = voronoi_cells(random_sites(60, 2), kBox);
  std::size_t inner = 0;
  std::vector<int> edges_at(cells.vertices.size());
  for (const auto& edge : cells.edges) {
    if (edge.start >= 0) ++edges_at[edge.start];
    if (edge.end >= 0) ++edges_at[edge.end];
    if (edge.start < 0 || edge.end < 0) continue;
    ++inner;
    const auto& [i, j, k] = edge.sites;
    const Vec3 direction = (cells.sites[j] - cells.sites[i]).cross(cells.sites[k] - cells.sites[i]);
    EXPECT_GT((place(cells, edge.end) - place(cells, edge.start)).dot(direction), 0);
  }
  EXPECT_GT(inner, 100u);
  for (const int count : edges_at) EXPECT_EQ(count, 4);
}

TEST(VoronoiCells, AreNeighboursOfEachOther) {
  const VoronoiCells cells = voronoi_cells(random_sites(200, 3), kBox);
  for (std::size_t i = 0; i < cells.neighbours.size(); ++i) {
    for (const std::int32_t j : cells.neighbours[i]) {
      EXPECT_TRUE(std::ranges::binary_search(cells.neighbours[j], static_cast<std::int32_t>(i)));
    }
  }
}

TEST(VoronoiCells, OfOneSiteFillTheBoxAndOfTwoAreNeighbours) {
  EXPECT_TRUE(voronoi_cells(random_sites(1, 4), kBox).neighbours[0].empty());
  const VoronoiCells two = voronoi_cells(random_sites(2, 4), kBox);
  EXPECT_EQ(two.neighbours[0], std::vector<std::int32_t>{1});
  EXPECT_TRUE(two.edges.empty());
}

TEST(VoronoiCells, RefuseSitesOnOneSphere) {
  std::vector<Vec3> corners;
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1}) {
      for (const double z : {-1, 1}) corners.emplace_back(x, y, z);
    }
  }
  EXPECT_THROW(voronoi_cells(corners, kBox), Degenerate);
}

}  // namespace
}  // namespace fracbench::cvd
