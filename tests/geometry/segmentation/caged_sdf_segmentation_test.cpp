#include "geometry/caged_sdf_segmentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "core/available_memory.h"
#include "core/error.h"
#include "heap_segmentation.h"
#include "test_fields.h"

namespace fracbench {
namespace {

using testing::HasSubstr;

/// Number of 6-connected parts by label.
std::map<std::int32_t, int> parts_by_label(const VoxelGrid<std::int32_t>& labels) {
  std::map<std::int32_t, int> parts;
  std::vector<char> done(labels.values.size(), 0);
  const auto [nx, ny, nz] = labels.size;
  for (std::size_t start = 0; start < done.size(); ++start) {
    if (done[start] || labels.values[start] < 1) continue;
    ++parts[labels.values[start]];
    std::vector<std::size_t> part{start};
    done[start] = 1;
    while (!part.empty()) {
      const std::size_t v = part.back();
      part.pop_back();
      const auto i = static_cast<int>(v % nx), j = static_cast<int>(v / nx % ny),
                 k = static_cast<int>(v / nx / ny);
      const auto visit = [&](int a, int b, int c) {
        if (a < 0 || b < 0 || c < 0 || a >= nx || b >= ny || c >= nz) return;
        const std::size_t to = labels.index(a, b, c);
        if (done[to] || labels.values[to] != labels.values[start]) return;
        done[to] = 1;
        part.push_back(to);
      };
      visit(i - 1, j, k), visit(i + 1, j, k), visit(i, j - 1, k);
      visit(i, j + 1, k), visit(i, j, k - 1), visit(i, j, k + 1);
    }
  }
  return parts;
}

std::map<std::int32_t, std::int64_t> voxels_by_label(const VoxelGrid<std::int32_t>& labels) {
  std::map<std::int32_t, std::int64_t> voxels;
  for (const std::int32_t label : labels.values) ++voxels[label];
  return voxels;
}

bool has_inside(const VoxelGrid<float>& field, double cage) {
  for (const float value : field.values) {
    if (value + static_cast<float>(cage) >= 0) return true;
  }
  return false;
}

TEST(CagedSdfSegmentation, EveryVoxelOfTheMaskAndNoOtherHasALabelByDefault) {
  for (const auto& [name, field] : test::all_fields()) {
    SCOPED_TRACE(name);
    if (!has_inside(field, std::max(0.03, field.spacing / 2))) continue;
    for (const std::int64_t minimum : {0, 5, 50, 1 << 30}) {
      const Segmentation found = caged_sdf_segmentation(field, {.minimum_voxels = minimum});
      std::int64_t inside = 0;
      for (std::size_t v = 0; v < field.values.size(); ++v) {
        const bool in_mask = field.values[v] + static_cast<float>(found.cage) >= 0;
        inside += in_mask;
        if (in_mask) {
          ASSERT_GE(found.labels.values[v], 1);
          ASSERT_LE(found.labels.values[v], found.count);
        } else {
          ASSERT_EQ(found.labels.values[v], -1);
        }
      }
      EXPECT_EQ(found.mask_voxels, inside);
    }
  }
}

TEST(CagedSdfSegmentation, LabelsAreInOnePieceEachAndNumberedWithoutGaps) {
  for (const auto& [name, field] : test::all_fields()) {
    SCOPED_TRACE(name);
    if (!has_inside(field, std::max(0.03, field.spacing / 2))) continue;
    for (const std::int64_t minimum : {0, 5, 50}) {
      const Segmentation found = caged_sdf_segmentation(field, {.minimum_voxels = minimum});
      const auto parts = parts_by_label(found.labels);
      ASSERT_EQ(parts.size(), static_cast<std::size_t>(found.count));
      for (const auto& [label, count] : parts) EXPECT_EQ(count, 1) << "label " << label;
      EXPECT_EQ(found.count + found.dropped_labels, found.flooded_labels);
    }
  }
}

TEST(CagedSdfSegmentation, VoxelsThatFloodingLabelledKeepTheirLabelByDefault) {
  for (const auto& [name, field] : test::all_fields()) {
    SCOPED_TRACE(name);
    const double cage = std::max(0.03, field.spacing / 2);
    if (!has_inside(field, cage)) continue;
    const Segmentation found = caged_sdf_segmentation(field, {.minimum_voxels = 0});
    const auto expected =
        reference::heap_segmentation(field, static_cast<float>(cage), 3, true).labels.values;
    std::int64_t dams = 0;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      if (expected[v] > 0) {
        ASSERT_EQ(found.labels.values[v], expected[v]);
      }
      dams += expected[v] == 0 && found.labels.values[v] > 0;
    }
    EXPECT_EQ(found.dam_voxels, dams);
  }
}

TEST(CagedSdfSegmentation, ParityFloodsTheWholeGridAndAppliesTheMaskAfterwards) {
  for (const auto& [name, field] : test::all_fields()) {
    SCOPED_TRACE(name);
    if (!has_inside(field, 0.03)) continue;
    const Segmentation found = caged_sdf_segmentation(field, {.parity = true});
    const auto expected = reference::heap_segmentation(field, 0.03f, 3, false).labels.values;
    std::map<std::int32_t, std::int64_t> inside;
    for (std::size_t v = 0; v < expected.size(); ++v) {
      if (field.values[v] + 0.03f >= 0) ++inside[expected[v]];
    }
    std::map<std::int32_t, std::int32_t> number;
    for (const auto& [label, voxels] : inside) {
      if (label > 0 && voxels >= 50) number.emplace(label, static_cast<int>(number.size()) + 1);
    }
    EXPECT_EQ(found.count, static_cast<std::int32_t>(number.size()));
    EXPECT_EQ(found.dam_voxels, inside.contains(0) ? inside[0] : 0);
    for (std::size_t v = 0; v < expected.size(); ++v) {
      const auto kept = number.find(expected[v]);
      const std::int32_t label = field.values[v] + 0.03f < 0 ? -1
                                 : kept == number.end()      ? 0
                                                             : kept->second;
      ASSERT_EQ(found.labels.values[v], label) << "voxel " << v;
    }
  }
}

TEST(CagedSdfSegmentation, DoesNotDependOnTheNumberOfThreads) {
  const VoxelGrid<float> field = test::voronoi_ball(48, 25, 7);
  for (const bool parity : {false, true}) {
    const Segmentation one = caged_sdf_segmentation(field, {.parity = parity, .threads = 1});
    const Segmentation four = caged_sdf_segmentation(field, {.parity = parity, .threads = 4});
    EXPECT_EQ(one.labels.values, four.labels.values);
  }
}

TEST(CagedSdfSegmentation, RecoversTheCellsOfAVoronoiDiagram) {
  // Two sites: the cut is the plane x = 0, and the wall between the labels stays within a voxel.
  const int r = 64;
  VoxelGrid<float> field = unit_grid<float>(r);
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        const Vec3 x = field.position(i, j, k);
        const double shell = 0.8 - x.norm();
        field.at(i, j, k) =
            static_cast<float>(shell < 0 ? shell : std::min(shell, std::abs(x.x())));
      }
    }
  }
  const Segmentation found = caged_sdf_segmentation(field);
  ASSERT_EQ(found.count, 2);
  for (int k = 0; k < r; ++k) {
    for (int j = 0; j < r; ++j) {
      for (int i = 0; i < r; ++i) {
        const double x = field.position(i, j, k).x();
        const std::int32_t label = found.labels.at(i, j, k);
        if (label < 0 || std::abs(x) < field.spacing) continue;
        // Near the ball's surface the field no longer tells the halves apart.
        if (field.position(i, j, k).norm() > 0.7) continue;
        ASSERT_EQ(label, found.labels.at(x < 0 ? r / 4 : 3 * r / 4, r / 2, r / 2));
      }
    }
  }
}

TEST(CagedSdfSegmentation, DroppedLabelsGoToTheNeighbourWithTheLongestBorder) {
  const VoxelGrid<float> field = test::voronoi_ball(40, 40, 11);
  const Segmentation all = caged_sdf_segmentation(field, {.minimum_voxels = 0});
  const Segmentation kept = caged_sdf_segmentation(field, {.minimum_voxels = 200});
  ASSERT_GT(kept.dropped_labels, 2);
  EXPECT_EQ(all.dropped_labels, 0);
  EXPECT_EQ(all.count, kept.count + kept.dropped_labels);
  // Labels are only ever united.
  std::map<std::int32_t, std::int32_t> target;
  for (std::size_t v = 0; v < field.values.size(); ++v) {
    const auto [entry, is_new] = target.emplace(all.labels.values[v], kept.labels.values[v]);
    ASSERT_EQ(entry->second, kept.labels.values[v]);
  }
}

TEST(CagedSdfSegmentation, AnIslandIsKeptHoweverSmall) {
  const VoxelGrid<float> field = test::two_balls(32, 0.4f, 0.1f);
  const Segmentation found = caged_sdf_segmentation(field, {.minimum_voxels = 500});
  EXPECT_EQ(found.count, 2);
  EXPECT_EQ(found.islands, 1);
  EXPECT_EQ(found.dropped_labels, 0);
  EXPECT_LT(voxels_by_label(found.labels)[2], 500);

  const Segmentation parity =
      caged_sdf_segmentation(field, {.minimum_voxels = 500, .parity = true});
  EXPECT_EQ(parity.count, 1);
  EXPECT_EQ(parity.dropped_labels, 1);
}

TEST(CagedSdfSegmentation, DefaultsFollowTheResolution) {
  const auto cage = [](int r, bool parity) {
    return caged_sdf_segmentation(test::two_balls(r, 0.4f, 0.4f), {.parity = parity}).cage;
  };
  EXPECT_EQ(cage(32, false), 1.0 / 32);
  EXPECT_EQ(cage(32, true), 0.03);
  EXPECT_EQ(cage(64, false), 0.03);
  const auto minimum = [](int r) {
    return caged_sdf_segmentation(test::two_balls(r, 0.4f, 0.4f)).minimum_voxels;
  };
  EXPECT_EQ(minimum(128), 50);
  EXPECT_EQ(minimum(129), 500);
}

std::string message_of(const VoxelGrid<float>& field, const SegmentationOptions& options = {}) {
  try {
    caged_sdf_segmentation(field, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(CagedSdfSegmentation, NamesTheVoxelThatIsNotFinite) {
  VoxelGrid<float> field = test::two_balls(16, 0.4f, 0.4f);
  field.at(3, 5, 7) = std::numeric_limits<float>::quiet_NaN();
  field.at(4, 5, 8) = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message_of(field), HasSubstr("NaN at voxel (3, 5, 7)"));
  field.at(3, 5, 7) = 0;
  EXPECT_THAT(message_of(field), HasSubstr("infinite value at voxel (4, 5, 8)"));
  EXPECT_THAT(message_of(field, {.parity = true}), HasSubstr("(4, 5, 8)"));
}

TEST(CagedSdfSegmentation, RefusesFieldsThatAreNone) {
  EXPECT_THAT(message_of({}), HasSubstr("size is 0 x 0 x 0"));
  VoxelGrid<float> field = test::two_balls(8, 0.4f, 0.4f);
  field.values.pop_back();
  EXPECT_THAT(message_of(field), HasSubstr("8 x 8 x 8 = 512 voxels, but it holds 511"));
  field = test::two_balls(8, 0.4f, 0.4f);
  field.spacing = 0;
  EXPECT_THAT(message_of(field), HasSubstr("spacing is 0"));
  field.spacing = std::nan("");
  EXPECT_THAT(message_of(field), HasSubstr("spacing is nan"));
  field.size = {1 << 30, 1 << 30, 1 << 30};
  EXPECT_THAT(message_of(field), HasSubstr("coarser grid"));
  field.size = {1280, 1280, 1280};
  field.spacing = 1;
  EXPECT_THAT(message_of(field),
              HasSubstr(available_memory() < 29'000'000'000u ? "29.4 GB of memory beside it"
                                                             : "but it holds"));
  field.size = {-1, 8, 8};
  EXPECT_THAT(message_of(field), HasSubstr("at least one voxel"));
  EXPECT_THAT(message_of(VoxelGrid<float>({4, 4, 4}, Vec3::Zero(), 0.1, -0.5f)),
              HasSubstr("sign reversed"));
}

TEST(CagedSdfSegmentation, RefusesOptionsOutOfRange) {
  const VoxelGrid<float> field = test::two_balls(8, 0.4f, 0.4f);
  EXPECT_THAT(message_of(field, {.cage = -0.1}), HasSubstr("cage is -0.1"));
  EXPECT_THAT(message_of(field, {.cage = std::nan("")}), HasSubstr("cage is nan"));
  EXPECT_THAT(message_of(field, {.h = -1}), HasSubstr("h is -1"));
  EXPECT_THAT(message_of(field, {.minimum_voxels = -1}), HasSubstr("minimum_voxels is -1"));
}

}  // namespace
}  // namespace fracbench
