#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/arguments.h"
#include "app/command.h"
#include "app/fragment_folder.h"
#include "app/fragments_of_pieces.h"
#include "app/result_json.h"
#include "app/shape_frame.h"
#include "core/error.h"
#include "core/peak_memory.h"
#include "geometry/write_mesh.h"
#include "methods/registry.h"
#include "scenarios/break_test.h"
#include "scenarios/given_impact.h"
#include "scenarios/scene.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr const char* kBallForm = "x,y,z,vx,vy,vz (m and m/s, normalised frame)";
constexpr const char* kImpactForm =
    "px,py,pz,dx,dy,dz,I (point, direction and N s, normalised frame)";

struct FractureArguments {
  std::string method;
  std::string mesh;
  std::vector<std::string> balls;
  std::string impact;
  std::filesystem::path out;
  std::vector<std::string> settings;
  std::string format = "obj";
  std::string frame = "mesh";
  std::string break_test = "authors";
  std::uint64_t seed = 1;
  int threads = 2;
  double longest_side = 1.9;
  bool as_json = false;
};

Scenario scenario_of_balls(const FractureArguments& arguments) {
  Scenario scenario;
  scenario.family = "given";
  scenario.name = "given";
  scenario.break_test = break_test_from(arguments.break_test, "--break-test");
  for (const std::string& text : arguments.balls) {
    const std::vector<double> v = parse_numbers(text, 6, "--ball", kBallForm);
    scenario.balls.push_back({.position = {v[0], v[1], v[2]}, .velocity = {v[3], v[4], v[5]}});
  }
  return scenario;
}

struct Broken {
  std::vector<Impact> impacts;
  Fragments fragments;
  std::string why_unbroken;
};

Broken break_by_scene(const FractureArguments& arguments, const Target& target,
                      std::shared_ptr<const Breakable> breakable, Context& context) {
  SceneResult scene =
      run_scene(scenario_of_balls(arguments), target, std::move(breakable), context);
  Broken broken{std::move(scene.impacts), std::move(scene.fragments), ""};
  if (broken.impacts.empty()) {
    broken.why_unbroken =
        scene.unbroken
            ? fmt::format(
                  "the break test did not fire: total impulse {:.4g} N s, balanced force "
                  "{:.4g} N; a faster ball or --break-test eq2-patch helps",
                  scene.unbroken->break_test.total_impulse,
                  scene.unbroken->break_test.balanced_force)
            : "no ball touched the body";
  }
  return broken;
}

Broken break_by_impact(const FractureArguments& arguments, const Target& target,
                       const Breakable& breakable, Context& context) {
  const std::vector<double> v = parse_numbers(arguments.impact, 7, "--impact", kImpactForm);
  const Impact impact = impact_at(target, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]);
  return {{impact}, fragments_of(breakable.fracture(impact, context)), ""};
}

Fragments in_frame(const Fragments& fragments, const ShapeFrame& frame, const std::string& which) {
  if (which == "normalized") return fragments;
  Fragments result = fragments;
  for (Fragment& fragment : result) fragment.mesh = frame.to_own(fragment.mesh);
  return result;
}

ExitCode fracture(const FractureArguments& arguments, std::stop_token stop) {
  if (arguments.balls.empty() == arguments.impact.empty()) {
    throw InputError(fmt::format("give either --ball {} or --impact {}", kBallForm, kImpactForm));
  }
  const Method& method = find_method(arguments.method);
  const Options options = parse_settings(method.options(), arguments.settings,
                                         fmt::format("method '{}'", arguments.method));
  require_usable_folder(arguments.out);

  reset_peak_memory();
  StageTimer timer;
  Progress progress;
  Random random(arguments.seed);
  Context context{random, timer, progress, stop, arguments.threads};

  Shape shape = load_shape({.name = arguments.mesh, .longest_side = 0});
  const ShapeFrame frame(std::move(shape.mesh), arguments.longest_side);
  for (const std::string& note : shape.notes) fmt::print(stderr, "{}: {}\n", arguments.mesh, note);
  const Target target{shape.name, frame.normalized(), {}};

  const auto begin = Clock::now();
  const std::shared_ptr<const Breakable> breakable = [&] {
    const auto stage = timer.stage("prepare");
    return method.prepare(target, {}, options, context);
  }();
  const Broken broken = arguments.impact.empty()
                            ? break_by_scene(arguments, target, breakable, context)
                            : break_by_impact(arguments, target, *breakable, context);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();

  Json result = result_json({.body = target.mesh,
                             .fragments = broken.fragments,
                             .impacts = broken.impacts,
                             .stages = timer.times(),
                             .total_seconds = seconds,
                             .peak_memory = static_cast<double>(peak_memory()),
                             .threads = arguments.threads});
  if (!broken.why_unbroken.empty()) result["reason"] = broken.why_unbroken;
  result["method"] = arguments.method;
  result["options"] = options.to_json();
  result["mesh"] = arguments.mesh;
  result["seed"] = arguments.seed;
  write_fragment_folder(arguments.out, in_frame(broken.fragments, frame, arguments.frame),
                        arguments.format, result);
  if (arguments.as_json) {
    print_json(result);
  } else {
    fmt::print("{}", describe_result(result));
    if (!broken.why_unbroken.empty()) fmt::print("not broken         {}\n", broken.why_unbroken);
    fmt::print("written to         {}\n", arguments.out.string());
  }
  return ExitCode::good;
}

}  // namespace

void add_fracture_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("fracture", "Break one mesh and write its fragments");
  auto a = std::make_shared<FractureArguments>();
  command->add_option("method", a->method, "Name of the method; see 'fracbench list methods'")
      ->required();
  command
      ->add_option("mesh", a->mesh,
                   "A mesh file (OBJ, PLY, STL, OFF), or a shape of 'fracbench list shapes'")
      ->required();
  command
      ->add_option(
          "--ball", a->balls,
          fmt::format("Shoot the standard ball: {}; once more for a second ball", kBallForm))
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--impact", a->impact,
                      fmt::format("Give the impulse instead: {}", kImpactForm));
  command
      ->add_option(
          "--break-test", a->break_test,
          "When a body that a ball hits breaks (docs/scenarios.md); light bodies need eq2-patch")
      ->check(CLI::IsMember(break_test_names()))
      ->capture_default_str();
  command->add_option("--out", a->out, "Folder for fragments, fragments.glb and result.json")
      ->required();
  command->add_option("--set", a->settings, "Option of the method: name=value")
      ->allow_extra_args(false)
      ->take_all();
  command->add_option("--format", a->format, "Format of the fragments' files")
      ->check(CLI::IsMember({"obj", "ply", "stl", "glb"}))
      ->capture_default_str();
  command
      ->add_option("--frame", a->frame,
                   "Write fragments in place and scale of the mesh's file, or normalised")
      ->check(CLI::IsMember({"mesh", "normalized"}))
      ->capture_default_str();
  command->add_option("--longest-side", a->longest_side, "Size in the normalised frame, m")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "Of the method's random choices")->capture_default_str();
  command->add_option("--threads", a->threads, "Threads that the method may use")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print the result as one JSON object");
  command->callback(
      [&chosen, a] { chosen = [a](std::stop_token stop) { return fracture(*a, stop); }; });
}

}  // namespace fracbench
