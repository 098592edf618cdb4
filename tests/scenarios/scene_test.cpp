#include "scenarios/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "geometry/measures.h"
#include "tests/scenarios/test_bodies.h"

namespace fracbench {
namespace {

using test::PlaneSplitter;
using test::TestContext;

std::vector<PlaneSplitter::Cut> eighths() {
  return {{.normal = Vec3::UnitX(), .offset = 0.1},
          {.normal = Vec3::UnitY(), .offset = -0.05},
          {.normal = Vec3(0.2, 0.3, 1).normalized(), .offset = 0.02}};
}

Scenario shot(const Vec3& velocity = {-80, 0, 0}) {
  Scenario scenario;
  scenario.name = "shot";
  scenario.balls = {
      Ball{.position = -3 * velocity.normalized() + Vec3(0, 0.1, 0.2), .velocity = velocity}};
  return scenario;
}

struct BoxShot {
  Target target;
  SceneResult result;
  TestContext test;
};

BoxShot run_box(const Scenario& scenario, std::vector<PlaneSplitter::Cut> cuts,
                std::vector<PlaneSplitter::Cut> later = {}) {
  BoxShot run;
  run.target = {.name = "box", .mesh = test::box({1.9, 1.2, 1}), .material = {}};
  run.result =
      run_scene(scenario, run.target,
                std::make_shared<PlaneSplitter>(run.target.mesh, std::move(cuts), std::move(later)),
                run.test.context);
  return run;
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

std::string bytes_of(const SceneResult& result) {
  std::string bytes;
  for (const Track& track : result.trajectory.tracks) {
    for (const Pose& pose : track.poses) {
      append(bytes, pose.position.data(), 3 * sizeof(double));
      append(bytes, pose.orientation.coeffs().data(), 4 * sizeof(double));
    }
  }
  for (const Impact& impact : result.impacts) {
    for (const Impulse& impulse : impact.impulses) {
      append(bytes, impulse.point.data(), 3 * sizeof(double));
      append(bytes, &impulse.magnitude, sizeof(double));
    }
  }
  return bytes;
}

TEST(Scene, BreaksTheTargetAndTracksEverything) {
  const BoxShot run = run_box(shot(), eighths());
  const SceneResult& result = run.result;
  ASSERT_EQ(result.impacts.size(), 1u);
  EXPECT_FALSE(result.unbroken);
  EXPECT_EQ(result.fragments.size(), 8u);
  const Trajectory& trajectory = result.trajectory;
  ASSERT_EQ(trajectory.tracks.size(), 10u);
  EXPECT_EQ(trajectory.frame_seconds, 1.0 / 250);
  const auto break_frame = static_cast<int>(result.impacts[0].time * 250 + 1.5);
  for (const Track& track : trajectory.tracks) {
    const int first = track.kind == Track::Kind::piece ? break_frame : 0;
    const int last = track.kind == Track::Kind::target ? break_frame - 1 : 200;
    EXPECT_EQ(track.first_frame, first);
    EXPECT_EQ(first + static_cast<int>(track.poses.size()) - 1, last);
  }
}

TEST(Scene, FragmentsLieWhereTheTargetWas) {
  const BoxShot run = run_box(shot(), eighths());
  double sum = 0;
  for (const Fragment& fragment : run.result.fragments) {
    sum += volume(fragment.mesh);
    const BoundingBox box = bounding_box(fragment.mesh);
    EXPECT_LE((box.high - Vec3(0.95, 0.6, 0.5)).maxCoeff(), 1e-12);
    EXPECT_GE((box.low + Vec3(0.95, 0.6, 0.5)).minCoeff(), -1e-12);
  }
  EXPECT_NEAR(sum, volume(run.target.mesh), 1e-12);
}

TEST(Scene, ThatDoesNotBreakTheTargetReportsItsStrongestImpact) {
  const BoxShot run = run_box(shot({-5, 0, 0}), eighths());
  EXPECT_TRUE(run.result.impacts.empty());
  ASSERT_TRUE(run.result.unbroken);
  EXPECT_EQ(run.result.unbroken->fragment, -1);
  ASSERT_EQ(run.result.fragments.size(), 1u);
  EXPECT_EQ(run.result.fragments[0].generation, 0);
  EXPECT_EQ(run.result.fragments[0].mesh.faces, run.target.mesh.faces);
  EXPECT_EQ(run.result.fragments[0].faces[3].original_face, 3);
}

TEST(Scene, ASinglePieceMeansThatTheTargetStaysWhole) {
  const BoxShot run = run_box(shot(), {});
  EXPECT_TRUE(run.result.impacts.empty());
  EXPECT_TRUE(run.result.unbroken);
  EXPECT_EQ(run.result.fragments.size(), 1u);
}

TEST(Scene, GivesTheSameBytesTwice) {
  const BoxShot first = run_box(shot(), eighths(), {{.normal = Vec3::UnitX(), .offset = -0.3}});
  const BoxShot second = run_box(shot(), eighths(), {{.normal = Vec3::UnitX(), .offset = -0.3}});
  EXPECT_EQ(bytes_of(first.result), bytes_of(second.result));
}

TEST(Scene, GivesTheSameBytesBesideOtherScenes) {
  const std::string alone = bytes_of(run_box(shot(), eighths()).result);
  std::vector<std::string> together(8);
  std::vector<std::thread> threads;
  for (std::string& bytes : together) {
    threads.emplace_back([&bytes] { bytes = bytes_of(run_box(shot(), eighths()).result); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string& bytes : together) EXPECT_EQ(bytes, alone);
}

TEST(Scene, ConservesMomentumAtEachReplacementAndOverTheWholeScene) {
  BoxShot run = run_box(shot({-70, 10, 5}), eighths(), {{.normal = Vec3::UnitX(), .offset = -0.3}});
  ASSERT_GE(run.result.replacements.size(), 1u);
  EXPECT_EQ(run.result.replacements.size(), run.result.impacts.size());
  for (const Replacement& replacement : run.result.replacements) {
    EXPECT_LT(replacement.momentum_error, 1e-6);
    EXPECT_LT(replacement.angular_momentum_error, 1e-6);
    EXPECT_LE(replacement.energy_ratio, 1 + 1e-9);
  }
  // Momentum of all bodies between two frames, from the trajectory's centres of mass.
  const Trajectory& trajectory = run.result.trajectory;
  const auto momentum = [&](int frame) {
    Vec3 sum = Vec3::Zero();
    for (const Track& track : trajectory.tracks) {
      const int k = frame - track.first_frame;
      if (k < 0 || k + 1 >= static_cast<int>(track.poses.size())) continue;
      Vec3 center = Vec3::Zero();
      double mass = 8900 * 4.0 / 3 * M_PI * 0.4 * 0.4 * 0.4;
      if (track.kind != Track::Kind::ball) {
        const auto fragment =
            std::ranges::find(run.result.fragments, track.index, &Fragment::piece);
        const bool is_target = track.kind == Track::Kind::target;
        if (!is_target && fragment == run.result.fragments.end()) continue;
        const auto whole = mass_properties(is_target ? run.target.mesh : fragment->mesh);
        center = whole.center;
        mass = 1000 * whole.volume;
      }
      sum += mass * 250 * (track.poses[k + 1].to_world(center) - track.poses[k].to_world(center));
    }
    return sum;
  };
  const Vec3 before = momentum(0);
  EXPECT_LT((momentum(198) - before).norm() / before.norm(), 1e-4);
}

TEST(Scene, PiecesBreakAgainOnlyWhereRefractureIsOn) {
  const std::vector<PlaneSplitter::Cut> half = {{.normal = Vec3::UnitX(), .offset = 0}};
  const std::vector<PlaneSplitter::Cut> later = {{.normal = Vec3::UnitY(), .offset = 0}};
  Scenario scenario = shot({-95, 0, 0});
  const BoxShot twice = run_box(scenario, half, later);
  scenario.refracture = false;
  const BoxShot once = run_box(scenario, half, later);
  EXPECT_EQ(once.result.fragments.size(), 2u);
  EXPECT_GT(twice.result.fragments.size(), 2u);
  EXPECT_GE(twice.result.impacts.size(), 2u);
  std::set<std::int32_t> numbers;
  for (const Fragment& fragment : twice.result.fragments) {
    EXPECT_TRUE(numbers.insert(fragment.piece).second);
    EXPECT_EQ(fragment.parent >= 0, fragment.generation == 2);
  }
}

TEST(Scene, TagsOfPiecesOfPiecesSpeakOfTheTarget) {
  const BoxShot run = run_box(shot({-95, 0, 0}), {{.normal = Vec3::UnitX(), .offset = 0}},
                              {{.normal = Vec3::UnitY(), .offset = 0}});
  const TriangleMesh& target = run.target.mesh;
  std::map<std::int32_t, std::set<std::int32_t>> pieces_at;
  for (const Fragment& fragment : run.result.fragments) {
    ASSERT_EQ(fragment.faces.size(), fragment.mesh.faces.size());
    for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
      const FragmentFace& tag = fragment.faces[f];
      if (tag.is_fracture()) {
        pieces_at[tag.interface].insert(fragment.piece);
        continue;
      }
      const Vec3 normal = area_vector2(target, tag.original_face).normalized();
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(normal.dot(fragment.mesh.corner(f, k) - target.corner(tag.original_face, 0)), 0,
                    1e-12);
      }
    }
  }
  ASSERT_GE(pieces_at.size(), 2u);
  for (const auto& [interface, pieces] : pieces_at) EXPECT_GE(pieces.size(), 2u) << interface;
}

TEST(Scene, BallsThatStartInTheTargetAreBadInput) {
  for (const double x : {0.0, 1.2}) {
    Scenario scenario = shot();
    scenario.balls[0].position = {x, 0, 0};
    EXPECT_THROW(run_box(scenario, eighths()), InputError) << x;
  }
}

TEST(Scene, StopsWhenAskedTo) {
  Target target = {.name = "box", .mesh = test::box({1.9, 1.2, 1}), .material = {}};
  TestContext test;
  std::stop_source stop;
  stop.request_stop();
  Context context = {.random = test.random,
                     .timer = test.timer,
                     .progress = test.progress,
                     .stop = stop.get_token()};
  EXPECT_THROW(run_scene(shot(), target, nullptr, context), Cancelled);
}

TEST(Scene, APieceWithoutVolumeIsAFailureOfTheMethod) {
  class Flat final : public Breakable {
   public:
    std::vector<Piece> fracture(const Impact&, Context&) const override {
      return std::vector<Piece>(2);
    }
    void save(const std::filesystem::path&) const override {}
  };
  Target target = {.name = "box", .mesh = test::box({1.9, 1.2, 1}), .material = {}};
  TestContext test;
  EXPECT_THROW(run_scene(shot(), target, std::make_shared<Flat>(), test.context), MethodFailure);
}

}  // namespace
}  // namespace fracbench
