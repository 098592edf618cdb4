#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/app/program.h"

namespace fracbench {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A results folder of two collisions with two methods.
class ReportCommand : public testing::Test {
 protected:
  ReportCommand() {
    folder_.write("two.toml",
                  "shapes = [\"cube\"]\n[[scenario]]\nfamily = \"single\"\ncount = 2\nframes = 20\n"
                  "[[method]]\nname = \"cvd\"\nsites = 4\n"
                  "[[method]]\nname = \"cvd\"\nlabel = \"cvd-8\"\nsites = 8\n");
    EXPECT_EQ(run("run two.toml --out results").exit_code, 0);
  }
  Answer run(const std::string& arguments) { return call(arguments, folder_.path()); }
  std::vector<fs::path> files(const char* folder) {
    std::vector<fs::path> list;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder)) {
      list.push_back(entry.path());
    }
    std::ranges::sort(list);
    return list;
  }

  TemporaryFolder folder_;
};

TEST_F(ReportCommand, WritesAPageThatHasAFileForEachCell) {
  const Answer answer = run("report results --out report");
  EXPECT_EQ(answer.exit_code, 0) << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("report.md"), HasSubstr("index.html")));
  const std::string page = folder_.read("report/index.html");
  for (const fs::path& record : files("results/records")) {
    const std::string key = record.stem();
    EXPECT_THAT(folder_.read("report/cells/" + key + ".js"),
                HasSubstr("fracbenchCell({\"version\":1,\"key\":\"" + key));
    EXPECT_THAT(page, HasSubstr(key));
  }
  EXPECT_EQ(files("report/pictures").size(), 2u);
  EXPECT_EQ(folder_.read("report/suite.json"), folder_.read("results/suite.json"));
  const auto before = fs::last_write_time(files("report/cells").front());
  EXPECT_EQ(run("report results --out report").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(files("report/cells").front()), before) << "it is kept";
  EXPECT_EQ(folder_.read("report/index.html"), page) << "the same records, the same page";
}

TEST_F(ReportCommand, ShowsFracturesSideBySideInEveryKindOfReport) {
  EXPECT_EQ(run("report results --out report").exit_code, 0);
  EXPECT_EQ(folder_.read("report/fractures_cube.png").substr(1, 3), "PNG");
  for (const char* text : {"report/index.html", "report/report.md", "report/latex/report.tex"}) {
    EXPECT_THAT(folder_.read(text), HasSubstr("fractures_cube.png")) << text;
  }
  const std::string table = folder_.read("report/fracture_gallery.csv");
  EXPECT_EQ(std::ranges::count(table, '\n'), 3) << "its head and two methods: " << table;
}

TEST_F(ReportCommand, LinksWholeMeshesWhereTheyAreWanted) {
  EXPECT_EQ(run("report results --out report --meshes").exit_code, 0);
  const std::string page = folder_.read("report/index.html");
  for (const fs::path& record : files("results/records")) {
    const std::string name = "cells/" + record.stem().string() + ".glb";
    EXPECT_THAT(page, HasSubstr(name));
    EXPECT_EQ(folder_.read("report/" + name).substr(0, 4), "glTF");
  }
}

TEST_F(ReportCommand, ShowsTheRestWhereSomethingIsDamagedOrMissing) {
  fs::resize_file(files("results/records").front(), 1000);
  const Answer partial = run("report results --out report");
  EXPECT_EQ(partial.exit_code, 4);
  EXPECT_THAT(partial.errors, HasSubstr("left out"));
  EXPECT_THAT(folder_.read("report/index.html"), HasSubstr("3 of the suite"));

  fs::remove_all(folder_.path() / "results/shapes");
  fs::create_directory(folder_.path() / "results/shapes");
  const Answer without = run("report results --out other");
  EXPECT_EQ(without.exit_code, 4);
  EXPECT_THAT(without.errors, AllOf(HasSubstr("shapes/"), HasSubstr("is missing")));
  EXPECT_THAT(folder_.read("other/index.html"), HasSubstr("Number of fragments"));
  const Answer picture = run("render results --out pictures");
  EXPECT_EQ(picture.exit_code, 4);
  EXPECT_THAT(picture.errors, HasSubstr("is missing"));
}

TEST_F(ReportCommand, OfNoRecordsSaysSo) {
  for (const fs::path& record : files("results/records")) fs::remove(record);
  EXPECT_EQ(run("report results").exit_code, 4);
  EXPECT_EQ(run("render results").exit_code, 4);
  EXPECT_EQ(run("render nowhere").exit_code, 2);
}

TEST_F(ReportCommand, RenderDrawsRowsAndColumnsAndGoesOnWithMotion) {
  const Answer answer = run("render results --out pictures --size 32 --methods cvd --motion");
  EXPECT_EQ(answer.exit_code, 0) << answer.errors;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("columns: cvd\n"), Not(HasSubstr("cvd-8"))));
  std::size_t folders = 0;
  for (const fs::path& entry : files("pictures")) {
    if (!fs::is_directory(entry)) continue;
    ++folders;
    std::size_t frames = 0;
    for (const auto& frame : fs::directory_iterator(entry)) frames += frame.is_regular_file();
    EXPECT_GE(frames, 20u);
    const auto first = entry / "0000.png";
    const auto time = fs::last_write_time(first);
    fs::remove(entry / "0003.png");
    EXPECT_EQ(run("render results --out pictures --size 32 --methods cvd --motion").exit_code, 0);
    EXPECT_TRUE(fs::exists(entry / "0003.png"));
    EXPECT_EQ(fs::last_write_time(first), time);
  }
  EXPECT_EQ(folders, 1u);
}

TEST_F(ReportCommand, ExportWritesWhatTheEndingSays) {
  const std::string record = files("results/records").front();
  for (const char* name : {"a.glb", "a.obj", "a.ply", "a.stl"}) {
    EXPECT_EQ(run("export " + record + " --out " + name).exit_code, 0) << name;
    EXPECT_GT(fs::file_size(folder_.path() / name), 100u);
  }
  EXPECT_EQ(run("export " + record + " --out a.png").exit_code, 2);
  EXPECT_EQ(run("export nowhere.h5").exit_code, 2);
  EXPECT_EQ(run("export results/suite.json").exit_code, 2);
}

}  // namespace
}  // namespace fracbench
