#include "methods/external/external.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "geometry/measures.h"
#include "scenarios/shapes.h"
#include "source_folder.h"
#include "tests/methods/cvd/break_body.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

namespace fs = std::filesystem;

class External : public testing::Test {
 protected:
  /// A shell script as the program.
  OptionMap script(const std::string& text) {
    const fs::path file = folder_.path() / "program.sh";
    std::ofstream(file) << text << "\n";
    return {{"program", file.string()}, {"interpreter", std::string("sh")}};
  }

  std::vector<Piece> run(const OptionMap& options, std::uint64_t seed = 1,
                         const std::stop_token& stop = {}) {
    Random random(seed);
    StageTimer timer;
    Progress progress;
    Context context{.random = random, .timer = timer, .progress = progress, .stop = stop};
    const Options all(method_.options(), options, "test");
    const auto body =
        method_.prepare({.name = "cube", .mesh = mesh_, .material = {}}, {}, all, context);
    return body->fracture(push_at(mesh_.corner(0, 0) * 0.9), context);
  }

  std::string failure(const OptionMap& options) {
    try {
      run(options);
    } catch (const MethodFailure& failure) {
      return failure.what();
    }
    return "none";
  }

  ExternalMethod method_;
  TriangleMesh mesh_ = load_shape({.name = "cube"}).mesh;
  TemporaryWorkFolder folder_{"test"};
};

TEST_F(External, TheExampleOfTheDocumentationFillsTheBody) {
  if (std::system("python3 -c pass > /dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
  const OptionMap cutter{
      {"program", std::string(FRACBENCH_SOURCE_DIR "/docs/examples/plane_cutter.py")},
      {"interpreter", std::string("python3")}};
  const std::vector<Piece> pieces = run(cutter);
  ASSERT_EQ(pieces.size(), 2u);
  double sum = 0;
  for (const Piece& piece : pieces) {
    EXPECT_EQ(count_topology_errors(piece.mesh), 0u);
    sum += volume(piece.mesh);
    double fracture = 0;
    for (std::size_t f = 0; f < piece.faces.size(); ++f) {
      if (!piece.faces[f].is_fracture()) continue;
      fracture += area_vector2(piece.mesh, f).norm() / 2;
      EXPECT_EQ(piece.faces[f].neighbour, &piece == &pieces[0] ? 1 : 0);
    }
    EXPECT_GT(fracture, 0.5);
  }
  EXPECT_NEAR(sum, volume(mesh_), 1e-9);
  EXPECT_EQ(digest(run(cutter)), digest(pieces)) << "same seed, same bytes";
  EXPECT_NE(digest(run(cutter, 2)), digest(pieces));
}

TEST_F(External, IsToldTheImpactAndItsSettings) {
  OptionMap options = script(
      "grep -q '\"direction\"' $1/request.json && grep -q '\"settings\": \"deep\"' "
      "$1/request.json && cp $1/body.obj $2/whole.obj");
  options["settings"] = std::string("deep");
  EXPECT_EQ(run(options).size(), 1u);
}

TEST_F(External, AProgramThatFailsIsQuoted) {
  const std::string said = failure(script("echo cannot do this >&2; exit 7"));
  EXPECT_NE(said.find("program.sh"), std::string::npos);
  EXPECT_NE(said.find("exit code 7: cannot do this"), std::string::npos) << said;
  EXPECT_NE(failure(script("kill -SEGV $$")).find("signal 11"), std::string::npos);
}

TEST_F(External, WhatIsNoMeshIsNamed) {
  EXPECT_NE(failure(script("echo 'v 0 0 nan' > $2/a.obj")).find("a.obj"), std::string::npos);
  EXPECT_NE(failure(script("true")).find("left no mesh"), std::string::npos);
}

TEST_F(External, AProgramThatHangsEndsWithARequestToStop) {
  std::stop_source source;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  EXPECT_THROW(run(script("sleep 1000"), 1, source.get_token()), Cancelled);
  stopper.join();
}

TEST_F(External, WithoutAProgramSaysWhatIsMissing) {
  EXPECT_THROW(run({}), InputError);
  EXPECT_THROW(run({{"program", std::string("/no/such/file")}}), InputError);
  EXPECT_THROW(run({{"program", folder_.path().string()}}), InputError);
}

TEST_F(External, ItsContentIsPartOfTheKeys) {
  const OptionMap options = script("true");
  const auto files = method_.files(Options(method_.options(), options, "test"));
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0], std::get<std::string>(options.at("program")));
}

}  // namespace
}  // namespace fracbench::test
