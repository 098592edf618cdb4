// Suites in TOML. Methods are stand-ins with options of every kind, so that the target needs none
// of their sources.

#include "core/error.h"
#include "harness/suite_reader.h"
#include "scratch_file.h"

namespace {

using namespace fracbench;

class StandIn : public Method {
 public:
  explicit StandIn(std::string name) : name_(std::move(name)) {}

  MethodInfo info() const override {
    return {.name = name_,
            .summary = "stands in",
            .publications = {},
            .shape_type = "",
            .random = true,
            .learns = name_ == "deepfracture",
            .source_digest = "1"};
  }
  OptionsSchema options() const override {
    OptionsSchema schema;
    for (const char* name :
         {"sites", "triangles", "max_cracks", "modes", "cage_faces", "epochs", "later_from"}) {
      schema.push_back({name, std::int64_t{20}, "", "a count", 1, 1e6});
    }
    for (const char* name : {"voxel", "refracture_volume", "width", "truncation"}) {
      schema.push_back({name, 0.5, "m", "a number", 0, 1});
    }
    schema.push_back({"resolutions", std::vector<double>{32}, "", "a list", 32, 256});
    schema.push_back({"sites_at", std::vector<double>{}, "m", "another list"});
    schema.push_back({"law", std::string("even"), "", "a choice", {}, {}, {"even", "odd"}});
    schema.push_back({"exact", false, "", "a flag"});
    return schema;
  }
  std::unique_ptr<Breakable> prepare(const Target&, const LearningData&, const Options&,
                                     Context&) const override {
    throw MethodFailure("it only stands in");
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path&, const Target&,
                                  const Options&) const override {
    throw MethodFailure("it only stands in");
  }

 private:
  std::string name_;
};

std::vector<std::unique_ptr<Method>> stand_ins() {
  std::vector<std::unique_ptr<Method>> methods;
  for (const char* name : {"cvd", "bem", "modes", "deepfracture", "nearest-pattern"}) {
    methods.push_back(std::make_unique<StandIn>(name));
  }
  return methods;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<std::unique_ptr<Method>> methods = stand_ins();
  static const Catalog catalog{.methods = methods,
                               .families = scenario_families(),
                               .metrics = {},
                               .load_shape = {},
                               .run_scene = {}};
  try {
    parse_suite(fuzz::text_of(data, size), "suite.toml", catalog);
  } catch (const InputError&) {
  }
  return 0;
}
