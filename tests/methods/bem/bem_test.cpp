#include "methods/bem/bem.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "methods/registry.h"
#include "scenarios/given_impact.h"
#include "scenarios/shapes.h"
#include "tests/methods/cvd/bodies.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

const Method& bem() { return find_method("bem"); }

/// The quick scale.
OptionMap quick(OptionMap more = {}) {
  more.try_emplace("triangles", std::int64_t{400});
  more.try_emplace("voxel", 0.04);
  return more;
}

struct Bench {
  explicit Bench(Target target_, OptionMap given = quick(), std::uint64_t seed = 1, int threads = 1)
      : target(std::move(target_)), options(bem().options(), given, "test"), random(seed) {
    context.threads = threads;
    context.notes = &notes;
  }
  std::unique_ptr<Breakable> prepare() { return bem().prepare(target, {}, options, context); }

  Target target;
  Options options;
  Random random;
  StageTimer timer;
  Progress progress;
  std::vector<std::string> notes;
  Context context{.random = random, .timer = timer, .progress = progress};
};

Target target_of(const std::string& name) { return {name, load_shape({.name = name}).mesh, {}}; }

/// A blow of the standard ball at 60 m/s from +x.
Impact blow(const Target& target, double impulse = 5e5) {
  double best = -1;
  Vec3 point = Vec3::Zero();
  for (const Vec3& v : target.mesh.vertices) {
    if (v.x() - 0.2 * v.tail<2>().norm() > best) {
      best = v.x() - 0.2 * v.tail<2>().norm();
      point = v;
    }
  }
  return impact_at(target, point, Vec3(-1, 0.1, 0.05), impulse);
}

/// The bench breaks easily: most of the tests ask for a broken body.
std::vector<Piece> break_target(Bench& bench) {
  return bench.prepare()->fracture(blow(bench.target), bench.context);
}

/// Pieces as expect_partition wants them: that cannot break again.
std::vector<Piece> resting(std::vector<Piece> pieces) {
  for (Piece& piece : pieces) piece.next = nullptr;
  return pieces;
}

TEST(Bem, DividesShapesIntoClosedPiecesThatKeepTheirSurface) {
  std::size_t broken = 0;
  for (const char* name : {"A", "plinth", "mug"}) {
    SCOPED_TRACE(name);
    Bench bench(target_of(name));
    const std::vector<Piece> pieces = break_target(bench);
    ASSERT_FALSE(pieces.empty());
    broken += pieces.size() > 1;
    expect_partition(bench.target.mesh, resting(pieces));
    ASSERT_EQ(bench.notes.size(), 1u);
    EXPECT_EQ(bench.notes[0].rfind("bem, the target: ", 0), 0u) << bench.notes[0];
  }
  EXPECT_GE(broken, 2u);
}

TEST(Bem, FillsTheTargetToRounding) {
  Bench bench(target_of("A"));
  const std::vector<Piece> pieces = break_target(bench);
  ASSERT_GT(pieces.size(), 1u);
  double sum = 0;
  for (const Piece& piece : pieces) sum += volume(piece.mesh);
  EXPECT_NEAR(sum / volume(bench.target.mesh), 1, 1e-12);
}

TEST(Bem, BreaksNothingBelowTheStrength) {
  Bench weak(target_of("A"));
  Bench strong(target_of("A"));
  strong.target.material.strength = 1e12;
  EXPECT_GT(break_target(weak).size(), 1u);
  const std::vector<Piece> pieces = break_target(strong);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].mesh.vertices, strong.target.mesh.vertices);
  EXPECT_NE(strong.notes.at(0).find("the strength is nowhere exceeded"), std::string::npos);
}

TEST(Bem, SeparatesNothingWhereTheToughnessHoldsTheCracks) {
  Bench bench(target_of("A"));
  bench.target.material.toughness = 1e12;
  EXPECT_EQ(break_target(bench).size(), 1u);
  EXPECT_NE(bench.notes.at(0).find("not separated"), std::string::npos) << bench.notes.at(0);
}

TEST(Bem, StartsAtMostTheCracksThatAreAllowed) {
  Bench none(target_of("A"), quick({{"max_cracks", std::int64_t{0}}}));
  EXPECT_EQ(break_target(none).size(), 1u);
  Bench few(target_of("A"), quick({{"max_cracks", std::int64_t{2}}}));
  Bench many(target_of("A"), quick({{"max_cracks", std::int64_t{12}}}));
  EXPECT_LT(break_target(few).size(), break_target(many).size());
}

TEST(Bem, GivesTheSamePiecesForTheSameSeedAndAnyNumberOfThreads) {
  Bench one(target_of("A")), two(target_of("A"), quick(), 1, 2);
  const std::string first = digest(break_target(one));
  EXPECT_EQ(first, digest(break_target(two)));
  EXPECT_EQ(one.notes, two.notes);
}

TEST(Bem, GivesTheSamePiecesEachTimeThatItIsAsked) {
  Bench bench(target_of("A"));
  const auto body = bench.prepare();
  const Impact impact = blow(bench.target);
  EXPECT_EQ(digest(body->fracture(impact, bench.context)),
            digest(body->fracture(impact, bench.context)));
}

TEST(Bem, ARandomStrengthFollowsTheSeed) {
  const OptionMap options =
      quick({{"strength_field", std::string("random")}, {"weibull_modulus", 3.0}});
  Bench one(target_of("A"), options, 1), again(target_of("A"), options, 1),
      other(target_of("A"), options, 2);
  const std::string first = digest(break_target(one));
  EXPECT_EQ(first, digest(break_target(again)));
  EXPECT_NE(first, digest(break_target(other)));
}

/// The largest piece that may break again, and where it is.
const Piece* largest_breakable(const std::vector<Piece>& pieces) {
  const Piece* best = nullptr;
  for (const Piece& piece : pieces) {
    if (piece.next && (!best || volume(piece.mesh) > volume(best->mesh))) best = &piece;
  }
  return best;
}

TEST(Bem, OnlyLargePiecesMayBreakAgain) {
  Bench bench(target_of("A"));
  const double whole = volume(bench.target.mesh);
  for (const Piece& piece : break_target(bench)) {
    EXPECT_EQ(piece.next != nullptr, volume(piece.mesh) > 0.02 * whole);
  }
  Bench none(target_of("A"), quick({{"refracture_volume", 1.0}}));
  for (const Piece& piece : break_target(none)) EXPECT_EQ(piece.next, nullptr);
}

TEST(Bem, PiecesBreakAgainIntoPiecesThatFillThem) {
  Bench bench(target_of("plinth"));
  const std::vector<Piece> pieces = break_target(bench);
  const Piece* piece = largest_breakable(pieces);
  ASSERT_NE(piece, nullptr);
  const Impact impact = blow({"piece", piece->mesh, bench.target.material});
  const std::vector<Piece> parts = piece->next->fracture(impact, bench.context);
  ASSERT_FALSE(parts.empty());
  expect_partition(piece->mesh, resting(parts));
  // The order of calls and the threads do not matter.
  Bench again(target_of("plinth"), quick(), 1, 2);
  const std::vector<Piece> fresh = break_target(again);
  std::vector<std::string> digests(2);
  std::vector<std::thread> threads;
  for (std::string& result : digests) {
    threads.emplace_back([&] {
      Bench own(again.target);
      result = digest(largest_breakable(fresh)->next->fracture(impact, own.context));
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(digests[0], digest(parts));
  EXPECT_EQ(digests[1], digest(parts));
}

class BemFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) / ("fracbench_bem_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(BemFiles, LoadedBodiesBreakAsTheSavedOnes) {
  Bench bench(target_of("A"));
  const auto body = bench.prepare();
  const Impact impact = blow(bench.target);
  const std::vector<Piece> pieces = body->fracture(impact, bench.context);
  body->save(folder_);
  const auto loaded = bem().load(folder_, bench.target, bench.options);
  EXPECT_EQ(digest(pieces), digest(loaded->fracture(impact, bench.context)));
}

TEST_F(BemFiles, LoadedPiecesBreakAsTheSavedOnes) {
  Bench bench(target_of("plinth"));
  const std::vector<Piece> pieces = break_target(bench);
  const Piece* piece = largest_breakable(pieces);
  ASSERT_NE(piece, nullptr);
  const Target target{bench.target.name, piece->mesh, bench.target.material};
  const Impact impact = blow(target);
  piece->next->save(folder_);
  const auto loaded = bem().load(folder_, target, bench.options);
  EXPECT_EQ(digest(piece->next->fracture(impact, bench.context)),
            digest(loaded->fracture(impact, bench.context)));
}

TEST_F(BemFiles, AreRefusedWhereTheyAreOfSomethingElseOrDamaged) {
  Bench bench(target_of("cube"));
  EXPECT_THROW(bem().load(folder_, bench.target, bench.options), InputError);
  bench.prepare()->save(folder_);
  EXPECT_NO_THROW(bem().load(folder_, bench.target, bench.options));
  Bench finer(target_of("cube"), quick({{"voxel", 0.05}}));
  EXPECT_THROW(bem().load(folder_, finer.target, finer.options), InputError);
  Target tougher = bench.target;
  tougher.material.toughness *= 2;
  EXPECT_THROW(bem().load(folder_, tougher, bench.options), InputError);
  std::filesystem::resize_file(folder_ / "bem.json", 100);
  EXPECT_THROW(bem().load(folder_, bench.target, bench.options), InputError);
  std::ofstream(folder_ / "bem.json") << "{}";
  EXPECT_THROW(bem().load(folder_, bench.target, bench.options), InputError);
}

TEST_F(BemFiles, PicturesAreWrittenOnDemandAndChangeNothing) {
  Bench plain(target_of("A")), drawn(target_of("A"));
  drawn.context.pictures = folder_;
  EXPECT_EQ(digest(break_target(plain)), digest(break_target(drawn)));
  for (const char* name : {"surface.vtp", "cracks.vtp", "sheets.vtp", "labels.vti"}) {
    EXPECT_GT(std::filesystem::file_size(folder_ / ("bem_target_" + std::string(name))), 1000u);
  }
}

TEST(Bem, UnderParityReMeshesTheSurface) {
  std::size_t broken = 0;
  for (const char* name : {"A", "plinth", "mug"}) {
    SCOPED_TRACE(name);
    Bench bench(target_of(name), quick({{"parity", true}}));
    const std::vector<Piece> pieces = break_target(bench);
    if (pieces.size() == 1) continue;
    ++broken;
    double sum = 0;
    for (const Piece& piece : pieces) {
      EXPECT_TRUE(check_mesh(piece.mesh).is_solid());
      sum += volume(piece.mesh);
    }
    EXPECT_NEAR(sum / volume(bench.target.mesh), 1, 0.25);
  }
  EXPECT_GE(broken, 1u);
}

/// The message of the InputError that the call throws.
template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Bem, RefusesMaterialsOutOfThePhysicalRange) {
  const auto refused = [](const auto& change) {
    Bench bench(target_of("cube"));
    change(bench.target.material);
    return refusal([&] { bench.prepare(); });
  };
  EXPECT_NE(refused([](Material& m) { m.young_modulus = 0; }).find("Young's modulus is 0 Pa"),
            std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.poisson_ratio = 0.5; }).find("Poisson's ratio is 0.5"),
            std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.poisson_ratio = -1; }).find("Poisson's ratio is -1"),
            std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.density = -1; }).find("density"), std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.strength = 0; }).find("strength"), std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.toughness = std::nan(""); }).find("toughness"),
            std::string::npos);
  EXPECT_NE(refused([](Material& m) { m.compressive_factor = 0.5; }).find("compressive"),
            std::string::npos);
}

TEST(Bem, RefusesShapesThinnerThanTheVoxelAndNamesOneThatDoes) {
  Bench bench(target_of("cube"));
  for (Vec3& v : bench.target.mesh.vertices) v.z() *= 0.01;
  const std::string text = refusal([&] { bench.prepare(); });
  EXPECT_NE(text.find("thinner than voxels of 0.04 m"), std::string::npos) << text;
}

TEST(Bem, RefusesBodiesInSeveralParts) {
  Bench bench(target_of("cube"));
  TriangleMesh& mesh = bench.target.mesh;
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  const std::size_t faces = mesh.faces.size();
  for (std::int32_t v = 0; v < count; ++v) {
    mesh.vertices.push_back(mesh.vertices[v] + Vec3(3, 0, 0));
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const Face face = mesh.faces[f];
    mesh.faces.push_back({face[0] + count, face[1] + count, face[2] + count});
  }
  EXPECT_NE(refusal([&] { bench.prepare(); }).find("2 separate bodies"), std::string::npos);
}

TEST(Bem, RefusesImpactsOffTheSurface) {
  Bench bench(target_of("cube"));
  const auto body = bench.prepare();
  Impact impact = blow(bench.target);
  impact.impulses[0].point += Vec3(0.5, 0, 0);
  EXPECT_NE(refusal([&] { body->fracture(impact, bench.context); }).find("off the surface"),
            std::string::npos);
  impact.impulses[0].point.x() = std::nan("");
  EXPECT_NE(refusal([&] { body->fracture(impact, bench.context); }).find("off the surface"),
            std::string::npos);
  EXPECT_THROW(body->fracture({}, bench.context), InputError);
}

TEST(Bem, RefusesOptionsThatContradictEachOther) {
  Bench coarse(target_of("cube"), quick({{"crack_mesh", 0.02}}));
  EXPECT_NE(refusal([&] { coarse.prepare(); }).find("crack_mesh"), std::string::npos);
  Bench relief(target_of("cube"),
               quick({{"mode", std::string("full")}, {"balance", std::string("inertia-relief")}}));
  EXPECT_NE(refusal([&] { relief.prepare(); }).find("inertia-relief"), std::string::npos);
  Bench normal(target_of("cube"), quick({{"layer_normal", std::vector<double>{0, 0}}}));
  EXPECT_NE(refusal([&] { normal.prepare(); }).find("layer_normal"), std::string::npos);
}

}  // namespace
}  // namespace fracbench::test
