#include "methods/bem/propagate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "geometry/measures.h"
#include "methods/bem/front_frames.h"
#include "methods/bem/growth_law.h"
#include "tests/methods/bem/growth_setup.h"
#include "tests/methods/cvd/bodies.h"

namespace fracbench::bem {
namespace {

using test::Start;

const Vec3 kBar(1.9, 0.5, 0.4);

TEST(Propagation, CutsABarUnderTensionInTwoWhereTheCrackStarts) {
  const double x = 0.1;
  CutLinks links(test::box(kBar), 0.02, 1);
  const auto model =
      test::model(test::uniaxial(Vec3(1, 0, 0), 1e7), {Start{{x, 0.25, 0.03}, {0, 1, 0}}});
  const Propagation result = test::run(links, model, test::long_run(0.1));
  EXPECT_EQ(result.report.end, PropagationEnd::complete);
  EXPECT_EQ(result.report.new_cracks, 1u);
  EXPECT_TRUE(result.report.failures.empty());
  ASSERT_EQ(result.cracks.size(), 1u);
  for (const Vec3& v : result.cracks[0].surface.vertices) EXPECT_NEAR(v.x(), x, 1e-9);
  EXPECT_NEAR(result.report.area, 0.5 * 0.4, 0.05 * 0.5 * 0.4);
  const std::vector<double> parts = test::parts(links);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0], (0.95 + x) / 1.9, 0.02 / 1.9);
}

TEST(Propagation, KeepsAreaAndVolumesWhenTheVoxelsAreHalved) {
  // Tension that turns slowly along the bar, so that the crack is curved.
  const auto stress = [](const Vec3& p) {
    return test::uniaxial(Vec3(1, 0.8 * p.y(), 0.3 - 0.5 * p.z()), 1e7)(p);
  };
  const auto model = test::model(stress, {Start{{-0.1, 0.25, 0.03}, {0, 1, 0}}});
  std::vector<double> areas, volumes;
  for (const double voxel : {0.04, 0.02, 0.01, 0.005}) {
    CutLinks links(test::box(kBar), voxel, 1);
    const Propagation result = test::run(links, model, test::long_run(0.1));
    EXPECT_EQ(result.report.end, PropagationEnd::complete);
    areas.push_back(result.report.area);
    volumes.push_back(test::parts(links).at(0));
  }
  for (std::size_t i = 0; i + 1 < areas.size(); ++i) {
    EXPECT_NEAR(areas[i] / areas.back(), 1, 0.06) << i;
    EXPECT_NEAR(volumes[i], volumes.back(), 0.01) << i;
  }
  EXPECT_NEAR(areas[2] / areas[3], 1, 0.01);
}

TEST(Propagation, TurnsWithBodyAndStressButForTheGrid) {
  const auto stress = [](const Vec3& p) {
    return test::uniaxial(Vec3(1, 0.8 * p.y(), 0.3 - 0.5 * p.z()), 1e7)(p);
  };
  const Start start{{-0.1, 0.25, 0.03}, {0, 1, 0}};
  const TriangleMesh bar = test::box(kBar);
  CutLinks straight_links(bar, 0.01, 1);
  const Propagation straight =
      test::run(straight_links, test::model(stress, {start}), test::long_run(0.1));
  for (const double angle : {0.3, 1.1}) {
    const Mat3 turn = Eigen::AngleAxisd(angle, Vec3(1, 2, -1).normalized()).toRotationMatrix();
    const auto turned_stress = [&](const Vec3& p) -> Mat3 {
      return turn * stress(turn.transpose() * p) * turn.transpose();
    };
    CutLinks links(test::rotated(bar, turn), 0.01, 1);
    const Propagation turned = test::run(
        links, test::model(turned_stress, {Start{turn * start.position, turn * start.normal}}),
        test::long_run(0.1));
    EXPECT_NEAR(turned.report.area / straight.report.area, 1, 0.02);
    const std::vector<double> expected = test::parts(straight_links), parts = test::parts(links);
    ASSERT_EQ(expected.size(), 2u);
    ASSERT_GE(parts.size(), 2u);
    EXPECT_NEAR(parts[0], expected[0], 0.005);
    EXPECT_NEAR(parts[0] + parts[1], 1, 1e-3);
    // Every point of the one crack lies by the other.
    ASSERT_EQ(turned.cracks.size(), 1u);
    double farthest = 0;
    const auto& points = straight.cracks[0].surface.vertices;
    for (std::size_t i = 0; i < points.size(); i += 41) {
      if (!straight_links.inside(points[i])) continue;
      double nearest = 1;
      for (const Vec3& v : turned.cracks[0].surface.vertices) {
        nearest = std::min(nearest, (turn * points[i] - v).norm());
      }
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, 0.025);
  }
}

TEST(Propagation, TurnsTowardsTheLargestTensionAndStaysNormalToIt) {
  // The crack starts across the bar; the tension is turned by 25 degrees about z.
  const double angle = 25 * std::numbers::pi / 180;
  const Vec3 tension(std::cos(angle), std::sin(angle), 0);
  const auto model = test::model_with_planes(test::uniaxial(tension, 1e7),
                                             {Start{{0, 0.5, 0.01}, {0, 1, 0}}}, {Vec3(1, 0, 0)});
  CutLinks links(test::box({1.9, 1.0, 0.3}), 0.01, 1);
  const Propagation result = test::run(links, model, test::long_run(0.1));
  ASSERT_EQ(result.cracks.size(), 1u);
  const TriangleMesh& surface = result.cracks[0].surface;
  double straight = 0, turned = 0, area = 0;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const Vec3 normal = area_vector2(surface, f);
    const double depth = 0.5 - surface.corner(f, 0).y();
    if ((surface.corner(f, 0) - Vec3(0, 0.5, 0.01)).norm() < 0.035)
      straight = std::max(straight, std::abs(normal.normalized().y()));
    if (depth < 0.4 || !links.inside(surface.corner(f, 0))) continue;
    turned += normal.cross(tension).norm();
    area += normal.norm();
  }
  EXPECT_LT(straight, 0.02);  // the seed itself is not turned
  EXPECT_LT(turned / area, std::sin(2 * std::numbers::pi / 180));
  // Down along -y the crack runs towards larger x: normal to (cos, sin, 0).
  double lowest_x = 0;
  for (const Vec3& v : surface.vertices) lowest_x = v.y() < -0.49 ? v.x() : lowest_x;
  EXPECT_NEAR(lowest_x, std::tan(angle), 0.1);
  EXPECT_EQ(test::parts(links).size(), 2u);
}

TEST(Propagation, EndsTheSecondCrackOnTheFirstWithoutAGap) {
  const auto model = test::model_with_planes(
      test::hydrostatic(1e7),
      {Start{{0.1, 0.25, 0.03}, {0, 1, 0}}, Start{{-0.95, 0.02, 0}, {-1, 0, 0}}},
      {Vec3(1, 0, 0), Vec3(0, 1, 0)});
  for (const double voxel : {0.01, 0.02}) {
    CutLinks links(test::box(kBar), voxel, 1);
    const Propagation result = test::run(links, model, test::long_run(0.1));
    ASSERT_EQ(result.cracks.size(), 2u);
    EXPECT_EQ(result.report.end, PropagationEnd::complete);
    EXPECT_GT(result.report.at_crack, 10u);
    for (const Vec3& v : result.cracks[1].surface.vertices) EXPECT_LT(v.x(), 0.1 + 2.5 * voxel);
    const std::vector<double> parts = test::parts(links);
    ASSERT_EQ(parts.size(), 3u);
    EXPECT_NEAR(parts[0], 0.85 / 1.9, voxel / 1.9);
    EXPECT_NEAR(parts[1], 1.05 / 1.9 * 0.27 / 0.5, 2 * voxel / 0.5);
    EXPECT_NEAR(result.report.area, 0.5 * 0.4 + 1.05 * 0.4, 0.03);
  }
}

TEST(Propagation, LeavesNoLinkUncutAtMouthsAndJointsAtAnyAngle) {
  const TriangleMesh bar = test::box(kBar);
  for (const double tilt : {0.0, 0.4, -0.6, 0.9, 1.2}) {  // of the first crack towards the surface
    for (int n = 0; n < 6; ++n) {
      SCOPED_TRACE(testing::Message() << "tilt " << tilt << ", rotation " << n);
      const Mat3 turn =
          Eigen::AngleAxisd(0.1 + 0.37 * n, Vec3(1, 2 - 0.3 * n, -1).normalized()).matrix();
      const auto model = test::model_with_planes(
          test::hydrostatic(1e7),
          {Start{turn * Vec3(0.1, 0.25, 0.03), turn * Vec3(0, 1, 0)},
           Start{turn * Vec3(-0.95, 0.02, 0), turn * Vec3(-1, 0, 0)}},
          {turn * Vec3(std::cos(tilt), std::sin(tilt), 0), turn * Vec3(0, 1, 0)});
      CutLinks links(test::rotated(bar, turn), 0.015, 1);
      const Propagation result = test::run(links, model, test::long_run(0.1));
      EXPECT_EQ(result.report.end, PropagationEnd::complete);
      const std::vector<double> parts = test::parts(links);
      ASSERT_GE(parts.size(), 3u);
      EXPECT_GT(parts[2], 0.05);
      EXPECT_NEAR(parts[0] + parts[1] + parts[2],
                  parts.size() > 3 && parts[3] > 0.05 ? 1 - parts[3] : 1, 1e-3);
    }
  }
}

TEST(Propagation, JoinsTwoCracksThatMeetInOnePlane) {
  const Vec3 plane(1, 0, 0);
  for (const double offset : {0.0, 0.006}) {
    CutLinks links(test::box({0.6, 1.9, 0.4}), 0.01, 1);
    const auto model = test::model_with_planes(
        test::hydrostatic(1e7),
        {Start{{0.02, 0.95, 0.03}, {0, 1, 0}}, Start{{0.02 + offset, -0.95, 0}, {0, -1, 0}}},
        {plane, plane});
    const Propagation result = test::run(links, model, test::long_run(0.1));
    ASSERT_EQ(result.cracks.size(), 2u);
    EXPECT_EQ(result.report.end, PropagationEnd::complete);
    EXPECT_GT(result.report.at_crack, 5u);
    EXPECT_NEAR(result.report.area, 1.9 * 0.4, 0.03);  // nothing is swept twice
    const std::vector<double> parts = test::parts(links);
    ASSERT_GE(parts.size(), 2u);
    EXPECT_NEAR(parts[0] + parts[1], 1, 1e-4);
  }
}

TEST(Propagation, LetsAFrontMeetItselfBehindAHole) {
  // A frame of 3 x 3 boxes without the middle one, cut along its plane.
  const TriangleMesh frame =
      test::boxes(3, 3, 1, [](int i, int j, int) { return i != 1 || j != 1; });
  const double side = 1.9 / 3;
  CutLinks links(frame, 0.02, 1);
  const auto model = test::model_with_planes(
      test::hydrostatic(1e7), {Start{{0.03, -0.95, 0.01}, {0, -1, 0}}}, {Vec3(0, 0, 1)});
  const Propagation result = test::run(links, model, test::long_run(0.1));
  ASSERT_EQ(result.cracks.size(), 1u);
  EXPECT_EQ(result.report.end, PropagationEnd::complete);
  EXPECT_NEAR(result.report.area, 8 * side * side, 0.3 * side * side);
  const std::vector<double> parts = test::parts(links);
  ASSERT_GE(parts.size(), 2u);
  EXPECT_NEAR(parts[0], 0.5 + 0.01 / side, 0.02);
  EXPECT_NEAR(parts[0] + parts[1], 1, 1e-3);
  EXPECT_EQ(test::sheet_faults(result.cracks[0], 0.1), "");
}

TEST(Propagation, StopsWhereTheStressIntensityIsBelowTheToughness) {
  // Tension that falls with depth; the front must end where K = K_c.
  const auto stress = [](const Vec3& p) {
    return test::uniaxial(Vec3(1, 0, 0), 1e7 * std::exp((p.y() - 0.25) / 0.05))(p);
  };
  PropagationOptions options = test::long_run(0.1);
  options.material.toughness = 1.5e6;
  CutLinks links(test::box(kBar), 0.01, 1);
  const auto model = test::model(stress, {Start{{0.1, 0.25, 0.03}, {0, 1, 0}}});
  const Propagation result = test::run(links, model, options);
  EXPECT_EQ(result.report.end, PropagationEnd::arrested);
  EXPECT_GT(result.report.arrested, 10u);
  EXPECT_EQ(test::parts(links).size(), 1u);  // reported as whole, never forced
  ASSERT_EQ(result.cracks.size(), 1u);
  const double scale =
      1.1215 * std::pow(std::numbers::pi * sheet_area(result.cracks[0].sheet), 0.25);
  double deepest = 1;
  for (const FrontMarker& m : result.cracks[0].front) {
    if (m.coarse < 0 || m.state != FrontState::advancing) continue;
    EXPECT_LE(scale * stress(m.position)(0, 0), 1.5e6 * (1 + 1e-9));
    deepest = std::min(deepest, m.position.y());
  }
  EXPECT_NEAR(deepest, 0.25 + 0.05 * std::log(1.5e6 / (scale * 1e7)), 0.1);

  options.material.toughness = 1e9;
  CutLinks others(test::box(kBar), 0.01, 1);
  const Propagation seed_only = test::run(others, model, options);
  EXPECT_EQ(seed_only.report.end, PropagationEnd::arrested);
  EXPECT_EQ(seed_only.report.new_cracks, 1u);
}

TEST(Propagation, StartsNoMoreCracksThanAllowedAndNoneBelowTheStrength) {
  std::vector<Start> starts;
  for (int i = 0; i < 12; ++i) starts.push_back(Start{{-0.9 + 0.15 * i, 0.25, 0}, {0, 1, 0}});
  CutLinks links(test::box(kBar), 0.02, 1);
  const Propagation result = test::run(
      links, test::model(test::uniaxial(Vec3(1, 0, 0), 1e7), starts), test::long_run(0.1, 3));
  EXPECT_EQ(result.report.new_cracks, 3u);
  EXPECT_EQ(test::parts(links).size(), 4u);

  CutLinks whole(test::box(kBar), 0.02, 1);
  const Propagation none = test::run(whole, test::model(test::uniaxial(Vec3(1, 0, 0), 7e5), starts),
                                     test::long_run(0.1, 3));
  EXPECT_EQ(none.report.end, PropagationEnd::no_crack);
  EXPECT_EQ(test::parts(whole).size(), 1u);
}

TEST(Propagation, StopsInTimeAndGoesOnLaterAsIfItHadNot) {
  const auto stress = [](const Vec3& p) {
    return test::uniaxial(Vec3(1, 0.8 * p.y(), 0.3 - 0.5 * p.z()), 1e7)(p);
  };
  const auto model = test::model(stress, {Start{{-0.1, 0.25, 0.03}, {0, 1, 0}}});
  CutLinks at_once(test::box(kBar), 0.01, 1);
  const Propagation whole = test::run(at_once, model, test::long_run(0.1));

  PropagationOptions options = test::long_run(0.1);
  options.duration = 2 * options.mesh_size / rayleigh_speed(options.material);
  CutLinks first_links(test::box(kBar), 0.01, 1);
  const Propagation first = test::run(first_links, model, options);
  EXPECT_EQ(first.report.end, PropagationEnd::time_over);
  EXPECT_EQ(first.report.steps, 2);
  EXPECT_NEAR(first.report.time, options.duration, 1e-12);
  EXPECT_EQ(test::parts(first_links).size(), 1u);

  options = test::long_run(0.1, 0);
  CutLinks second_links(test::box(kBar), 0.01, 1);
  const Propagation second = test::run(second_links, model, options, first.cracks);
  EXPECT_EQ(second.report.end, PropagationEnd::complete);
  EXPECT_EQ(second.report.new_cracks, 0u);
  EXPECT_NEAR(first.report.area + second.report.area, whole.report.area, 1e-9);
  EXPECT_EQ(test::parts(second_links), test::parts(at_once));
}

TEST(Propagation, CarriesTheCracksOfABodyOnInAPieceOfIt) {
  // A crack across the bar that has not come through, and a piece that holds half of it.
  const auto model =
      test::model(test::uniaxial(Vec3(1, 0, 0), 1e7), {Start{{0.1, 0.25, 0.03}, {0, 1, 0}}});
  PropagationOptions options = test::long_run(0.1);
  options.duration = 2 * options.mesh_size / rayleigh_speed(options.material);
  CutLinks links(test::box(kBar), 0.01, 1);
  const Propagation first = test::run(links, model, options);

  TriangleMesh half = test::box({1.9, 0.5, 0.2});
  for (Vec3& v : half.vertices) v.z() += 0.1;
  CutLinks half_links(half, 0.02, 1);  // other voxels as well
  const Propagation second = test::run(half_links, model, test::long_run(0.1, 0), first.cracks);
  ASSERT_EQ(second.cracks.size(), 1u);
  EXPECT_EQ(second.report.end, PropagationEnd::complete);
  EXPECT_EQ(test::parts(half_links).size(), 2u);

  TriangleMesh far = test::box({0.5, 0.5, 0.4});
  for (Vec3& v : far.vertices) v.x() -= 0.6;
  CutLinks far_links(far, 0.02, 1);
  EXPECT_TRUE(test::run(far_links, model, test::long_run(0.1, 0), first.cracks).cracks.empty());
}

TEST(Propagation, GivesTheSameBytesAgainAndForAnyNumberOfThreads) {
  const auto stress = [](const Vec3& p) {
    return test::uniaxial(Vec3(1, 0.8 * p.y(), 0.3 - 0.5 * p.z()), 1e7)(p);
  };
  std::vector<Start> starts;
  for (int i = 0; i < 6; ++i) starts.push_back(Start{{-0.8 + 0.3 * i, 0.25, 0}, {0, 1, 0}});
  std::string first;
  for (const int threads : {1, 2, 4}) {
    CutLinks links(test::box(kBar), 0.02, threads);
    const Propagation result =
        test::run(links, test::model(stress, starts), test::long_run(0.1), {}, threads);
    if (first.empty()) first = test::bytes(result);
    EXPECT_EQ(test::bytes(result), first);
  }
}

TEST(Propagation, KeepsEverySheetADiscWithoutFoldsAndItsMarkersInTheLoop) {
  for (const auto& [name, mesh] : test::generated_bodies()) {
    SCOPED_TRACE(name);
    std::optional<CutLinks> links;
    try {
      links.emplace(mesh, 0.03, 1);
    } catch (const InputError&) {
      continue;  // thinner than the voxels
    }
    const auto stress = [](const Vec3& p) -> Mat3 {
      Mat3 s;
      s << 2 + p.x(), 0.4 * p.y(), 0.3, 0.4 * p.y(), 1.5 - p.z(), 0.2 * p.x(), 0.3, 0.2 * p.x(),
          1 + 0.5 * p.y();
      return 1e7 * s;
    };
    std::vector<Start> starts;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      starts.push_back({(mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3,
                        area_vector2(mesh, f).normalized()});
    }
    PropagationOptions options = test::long_run(0.15, 6);
    options.min_distance = 0.4;
    const Propagation result = test::run(*links, test::model(stress, starts), options);
    EXPECT_TRUE(result.report.failures.empty());
    for (const Crack& crack : result.cracks) {
      EXPECT_EQ(test::sheet_faults(crack, 0.15), "");
      std::size_t next = 0;
      for (const FrontMarker& m : crack.front) {
        if (m.coarse < 0) continue;
        ASSERT_LT(next, crack.sheet.boundary.size());
        EXPECT_EQ(m.coarse, crack.sheet.boundary[next]);
        EXPECT_EQ(m.state, crack.sheet.states[next]);
        ++next;
      }
      EXPECT_EQ(next, crack.sheet.boundary.size());
    }
  }
}

TEST(Propagation, NoticesThatItIsToStop) {
  CutLinks links(test::box(kBar), 0.02, 1);
  std::stop_source source;
  source.request_stop();
  Random random(1);
  StageTimer timer;
  Progress progress;
  Context context{random, timer, progress, source.get_token()};
  const auto model =
      test::model(test::uniaxial(Vec3(1, 0, 0), 1e7), {Start{{0.1, 0.25, 0.03}, {0, 1, 0}}});
  EXPECT_THROW(
      propagate({}, links, StrengthField(StrengthOptions{}), model, test::long_run(0.1), context),
      Cancelled);
}

}  // namespace
}  // namespace fracbench::bem
