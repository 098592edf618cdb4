#include "methods/plugin/plugin.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "core/temporary_folder.h"
#include "geometry/measures.h"
#include "scenarios/shapes.h"
#include "tests/methods/cvd/break_body.h"
#include "tests/methods/cvd/check_pieces.h"

namespace fracbench::test {
namespace {

const std::string kCutter = FRACBENCH_PLANE_CUTTER;
const std::string kHostile = FRACBENCH_HOSTILE_PLUGIN;
const std::string kOtherVersion = FRACBENCH_OTHER_VERSION_PLUGIN;
const std::string kWithoutFracture = FRACBENCH_INCOMPLETE_PLUGIN;

class Plugin : public testing::Test {
 protected:
  std::vector<Piece> run(const std::string& library, const std::string& settings = "",
                         std::uint64_t seed = 1, const std::stop_token& stop = {}) {
    Random random(seed);
    StageTimer timer;
    Progress progress;
    Context context{.random = random, .timer = timer, .progress = progress, .stop = stop};
    const Options options(method_.options(), {{"library", library}, {"settings", settings}},
                          "test");
    const auto body =
        method_.prepare({.name = "cube", .mesh = mesh_, .material = {}}, {}, options, context);
    return body->fracture(push_at(mesh_.corner(0, 0) * 0.9), context);
  }

  template <typename Error>
  std::string message(const std::string& library, const std::string& settings = "") {
    try {
      run(library, settings);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }

  PluginMethod method_;
  TriangleMesh mesh_ = load_shape({.name = "cube"}).mesh;
};

TEST_F(Plugin, TheExampleOfTheDocumentationFillsTheBody) {
  const std::vector<Piece> pieces = run(kCutter);
  ASSERT_EQ(pieces.size(), 2u);
  double sum = 0;
  for (const Piece& piece : pieces) {
    EXPECT_EQ(count_topology_errors(piece.mesh), 0u);
    sum += volume(piece.mesh);
  }
  EXPECT_NEAR(sum, volume(mesh_), 1e-9);
  EXPECT_EQ(digest(run(kCutter)), digest(pieces)) << "same seed, same bytes";
  EXPECT_NE(digest(run(kCutter, "", 2)), digest(pieces));
}

TEST_F(Plugin, WhatIsNoFragmentIsNamed) {
  EXPECT_NE(message<MethodFailure>(kHostile, "nan").find("vertex 1 of fragment 0"),
            std::string::npos);
  EXPECT_NE(message<MethodFailure>(kHostile, "index").find("face 1 of fragment 0 names vertex 4"),
            std::string::npos);
  EXPECT_NE(message<MethodFailure>(kHostile, "negative index").find("vertex -1"),
            std::string::npos);
  EXPECT_NE(message<MethodFailure>(kHostile, "counts").find("no mesh"), std::string::npos);
  EXPECT_NE(message<MethodFailure>(kHostile, "null").find("no mesh"), std::string::npos);
  EXPECT_NE(message<MethodFailure>(kHostile, "nothing").find("added no fragment"),
            std::string::npos);
  EXPECT_EQ(message<MethodFailure>(kHostile, "no body"), "plugin: I break no such body");
}

TEST_F(Plugin, ALibraryThatAsksEndsWhenItIsAskedTo) {
  std::stop_source source;
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    source.request_stop();
  });
  EXPECT_THROW(run(kHostile, "hang", 1, source.get_token()), Cancelled);
  stopper.join();
}

TEST_F(Plugin, WhatIsNoPluginIsRefused) {
  EXPECT_NE(message<InputError>("").find("which library"), std::string::npos);
  EXPECT_NE(message<InputError>("/no/such/file").find("/no/such/file"), std::string::npos);
  EXPECT_NE(message<InputError>(kOtherVersion).find("version 2"), std::string::npos);
  EXPECT_NE(message<InputError>(kWithoutFracture).find("fracbench_plugin_fracture"),
            std::string::npos);
  const TemporaryWorkFolder folder("test");
  const std::string text = folder.path() / "text.so";
  std::ofstream(text) << "not a library\n";
  EXPECT_NE(message<InputError>(text).find("text.so"), std::string::npos);
}

}  // namespace
}  // namespace fracbench::test
