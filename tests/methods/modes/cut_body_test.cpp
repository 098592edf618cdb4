#include "methods/modes/cut_body.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/sum.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "methods/modes/fragment_meshes.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/check_pieces.h"
#include "tests/methods/modes/tet_blocks.h"

namespace fracbench {
namespace {

using modes::CutBody;
using modes::TetMesh;

CutBody cut(const TriangleMesh& body, const TetMesh& tets, std::span<const std::int32_t> regions,
            int threads = 1) {
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress, .threads = threads};
  return modes::cut_body(body, tets, regions, context);
}

void expect_solids(const TriangleMesh& body, const std::vector<Piece>& pieces) {
  test::expect_filled(body, pieces);
  for (const Piece& piece : pieces) {
    const MeshReport report = check_mesh(piece.mesh);
    EXPECT_TRUE(report.is_solid()) << report.describe();
  }
}

/// Every cell for itself.
std::vector<Piece> all_pieces(const CutBody& body, int threads = 1) {
  std::vector<std::int32_t> cells(body.cells.size());
  std::iota(cells.begin(), cells.end(), 0);
  const modes::CellFaces faces(body);
  return modes::make_pieces({body, faces}, cells, cells, true, threads);
}

/// A random number of neighbours joined, numbered by their first cells.
std::vector<std::int32_t> random_groups(const CutBody& body, double share, Random& random) {
  std::vector<std::int32_t> parent(body.cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c];
    return c;
  };
  for (const auto& part : body.interfaces) {
    if (random.uniform() > share) continue;
    const std::int32_t a = root(part.cells[0]), b = root(part.cells[1]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::int32_t> group(parent.size());
  std::int32_t count = 0;
  for (std::size_t c = 0; c < group.size(); ++c) {
    const std::int32_t first = root(static_cast<std::int32_t>(c));
    group[c] = first == static_cast<std::int32_t>(c) ? count++ : group[first];
  }
  return group;
}

TetMesh cage_of(const TriangleMesh& body, int n, Random& random) {
  const BoundingBox box = bounding_box(body);
  const Vec3 rim = Vec3::Constant(0.17 * box.longest_side());
  return test::shaken(test::tet_block({n, n, n}, box.low - rim, box.high + rim), 0.15, random);
}

TEST(CutBody, OfEveryBodyByEveryKindOfRegionsFillsItExactlyWithSolids) {
  auto bodies = test::generated_bodies();
  for (auto& body : test::filed_bodies()) bodies.push_back(std::move(body));
  for (const auto& body : bodies) {
    SCOPED_TRACE(body.name);
    Random random(11);
    const TetMesh tets = cage_of(body.mesh, 4, random);
    for (const auto& regions : {test::voronoi_regions(tets, 12, random), test::slabs(tets, 3)}) {
      const CutBody result = cut(body.mesh, tets, regions);
      EXPECT_GE(result.cells.size(), 2u);
      expect_solids(body.mesh, all_pieces(result));
    }
  }
}

// Regions of single tets touch themselves and each other in edges and vertices everywhere.
TEST(CutBody, ByRegionsThatTouchThemselvesStillGivesManifolds) {
  for (int seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const TriangleMesh body = test::sphere(3);
    const TetMesh tets = cage_of(body, 3 + seed % 2, random);
    const CutBody result = cut(body, tets, test::random_regions(tets, 2, random));
    expect_solids(body, all_pieces(result));
  }
}

// The tets' boundary lies on the body's surface, with the same vertices and edges.
TEST(CutBody, OfTheTetsOwnSurfaceFillsItExactlyWithSolids) {
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const TetMesh block = test::tet_block({5, 3, 2}, Vec3(-1, -0.6, -0.4), Vec3(1, 0.6, 0.4));
    const TetMesh tets = seed % 2 == 0 ? block : test::shaken(block, 0.2, random);
    const TriangleMesh body = test::surface_of(tets);
    const auto regions =
        seed < 4 ? test::voronoi_regions(tets, 6, random) : test::random_regions(tets, 3, random);
    expect_solids(body, all_pieces(cut(body, tets, regions)));
  }
}

TEST(CutBody, OfACoarserSurfaceOfTheSameBoxFillsItExactlyWithSolids) {
  const TetMesh tets = test::tet_block({8, 2, 2}, Vec3(-2, -0.5, -0.5), Vec3(2, 0.5, 0.5));
  const TriangleMesh bar =
      test::surface_of(test::tet_block({1, 1, 1}, Vec3(-2, -0.5, -0.5), Vec3(2, 0.5, 0.5)));
  const CutBody result = cut(bar, tets, test::slabs(tets, 4));
  ASSERT_EQ(result.cells.size(), 4u);
  for (const auto& cell : result.cells) EXPECT_NEAR(cell.volume, 1, 1e-4);
  expect_solids(bar, all_pieces(result));
}

TEST(CutBody, IsTheSameForAnyNumberOfThreads) {
  Random random(5);
  const TriangleMesh body = test::sphere(4);
  const TetMesh tets = cage_of(body, 4, random);
  const auto regions = test::voronoi_regions(tets, 9, random);
  const auto one = all_pieces(cut(body, tets, regions, 1), 1);
  const auto three = all_pieces(cut(body, tets, regions, 3), 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t p = 0; p < one.size(); ++p) {
    EXPECT_EQ(one[p].mesh.vertices, three[p].mesh.vertices);
    EXPECT_EQ(one[p].mesh.faces, three[p].mesh.faces);
    EXPECT_EQ(one[p].faces, three[p].faces);
  }
}

TEST(CutBody, PartsOfARegionThatDoNotTouchAreDifferentCells) {
  const TriangleMesh body =
      test::boxes(3, 2, 1, [](int i, int j, int) { return j == 0 || i != 1; });
  const BoundingBox box = bounding_box(body);
  const TetMesh tets =
      test::tet_block({6, 4, 2}, box.low - Vec3::Constant(0.1), box.high + Vec3::Constant(0.1));
  std::vector<std::int32_t> regions;
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    regions.push_back(test::centroid(tets, t).y() > 0.02 ? 1 : 0);
  }
  const CutBody result = cut(body, tets, regions);
  ASSERT_EQ(result.cells.size(), 3u);
  EXPECT_EQ(result.cells[1].region, 1);
  EXPECT_EQ(result.cells[2].region, 1);
}

TEST(FragmentMeshes, OfAnyGroupingFillTheBodyWithoutInternalFaces) {
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const TriangleMesh body = test::sphere(3);
    const TetMesh tets = cage_of(body, 3, random);
    const CutBody result = cut(body, tets, test::random_regions(tets, 6, random));
    const auto groups = random_groups(result, 0.03, random);
    std::vector<std::int32_t> cells(result.cells.size());
    std::iota(cells.begin(), cells.end(), 0);
    const modes::CellFaces faces(result);
    const auto pieces = modes::make_pieces({result, faces}, cells, groups, true, 2);
    ASSERT_GE(pieces.size(), 2u);
    ASSERT_LT(pieces.size(), cells.size());
    expect_solids(body, pieces);

    // Joined for good, the same pieces are the cells.
    const CutBody joined = modes::join_cells(result, groups);
    const auto again = all_pieces(joined);
    expect_solids(body, again);
    ASSERT_EQ(again.size(), pieces.size());
    for (std::size_t p = 0; p < again.size(); ++p) {
      EXPECT_EQ(again[p].faces.size(), pieces[p].faces.size());
      EXPECT_NEAR(joined.cells[p].volume, volume(pieces[p].mesh), 1e-13);
    }
  }
}

TEST(FragmentMeshes, OfABodyOfSomeCellsRefersToTheFacesOfThatBody) {
  Random random(3);
  const TriangleMesh body = test::sphere(3);
  const TetMesh tets = cage_of(body, 4, random);
  const CutBody result = cut(body, tets, test::voronoi_regions(tets, 10, random));
  const modes::CellFaces faces(result);
  // Cells that are joined to the first one, as one piece; then that piece broken into its cells.
  std::vector<std::int32_t> cells(result.cells.size()), groups(cells.size(), 1), some;
  std::iota(cells.begin(), cells.end(), 0);
  groups[0] = 0;
  for (const auto& part : result.interfaces) {
    if (part.cells[0] == 0) groups[part.cells[1]] = 0;
    if (part.cells[1] == 0) groups[part.cells[0]] = 0;
  }
  std::vector<std::int32_t> numbers;
  for (const std::int32_t c : cells) {
    if (groups[c] != 0) continue;
    some.push_back(c);
    numbers.push_back(static_cast<std::int32_t>(numbers.size()));
  }
  ASSERT_GE(some.size(), 3u);
  const auto first = modes::make_pieces({result, faces}, cells, groups, true, 1);
  expect_solids(first[0].mesh, modes::make_pieces({result, faces}, some, numbers, false, 1));
}

}  // namespace
}  // namespace fracbench
