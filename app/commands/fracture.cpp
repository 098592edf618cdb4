#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "app/arguments.h"
#include "app/command.h"
#include "app/command_progress.h"
#include "app/fragment_folder.h"
#include "app/result_json.h"
#include "app/scene_json.h"
#include "app/shape_frame.h"
#include "core/error.h"
#include "core/peak_memory.h"
#include "geometry/write_mesh.h"
#include "harness/prepared_store.h"
#include "methods/registry.h"
#include "scenarios/break_test.h"
#include "scenarios/fragments_of_pieces.h"
#include "scenarios/given_impact.h"
#include "scenarios/scenario_toml.h"
#include "scenarios/scene.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr const char* kTrajectoryFile = "trajectory.json";
/// As in scenes written in TOML.
constexpr double kBallLimit = 1e4;
constexpr const char* kBallForm = "x,y,z,vx,vy,vz (m and m/s, normalised frame)";
constexpr const char* kImpactForm =
    "px,py,pz,dx,dy,dz,I (point, direction and N s, normalised frame)";

struct FractureArguments {
  std::string method;
  std::string mesh;
  std::vector<std::string> balls;
  std::string impact;
  std::string scenario;
  std::filesystem::path out;
  std::filesystem::path pictures;
  std::vector<std::string> settings;
  std::string format = "obj";
  std::string frame = "mesh";
  std::string break_test = "authors";
  std::int64_t seed = 1;
  int threads = 2;
  double longest_side = 1.9;
  bool as_json = false;
};

Scenario scenario_of(const FractureArguments& arguments) {
  if (!arguments.scenario.empty()) return read_scenario(arguments.scenario);
  Scenario scenario;
  scenario.family = "given";
  scenario.name = "given";
  scenario.break_test = break_test_from(arguments.break_test, "--break-test");
  for (const std::string& text : arguments.balls) {
    const std::vector<double> v = parse_numbers(text, 6, "--ball", kBallForm);
    const Vec3 position(v[0], v[1], v[2]);
    const Vec3 velocity(v[3], v[4], v[5]);
    if (std::max(position.cwiseAbs().maxCoeff(), velocity.cwiseAbs().maxCoeff()) > kBallLimit) {
      throw InputError(fmt::format("--ball {}: places and speeds must be within {} m and m/s", text,
                                   kBallLimit));
    }
    scenario.balls.push_back({.position = position, .velocity = velocity});
  }
  return scenario;
}

struct Broken {
  std::vector<Impact> impacts;
  Fragments fragments;
  Trajectory trajectory;
  std::string reason;  ///< why it did not break
  bool failed = false;
};

std::string why_whole(const Scenario& scenario, const std::optional<Impact>& strongest) {
  if (!strongest) return "no ball touched the body";
  const BreakTestValues& test = strongest->break_test;
  if (breaks(scenario.break_test, test, scenario.material)) return "the method left the body whole";
  return fmt::format(
      "the break test did not fire: total impulse {:.4g} N s, balanced force {:.4g} N; a faster "
      "ball "
      "or --break-test eq2-patch helps",
      test.total_impulse, test.balanced_force);
}

Broken break_by_scene(const Scenario& scenario, const Target& target,
                      std::shared_ptr<const Breakable> breakable, Context& context) {
  SceneResult scene = run_scene(scenario, target, std::move(breakable), context);
  Broken broken{std::move(scene.impacts), std::move(scene.fragments), std::move(scene.trajectory),
                ""};
  if (broken.impacts.empty()) broken.reason = why_whole(scenario, scene.unbroken);
  return broken;
}

Impact given_impact(const FractureArguments& arguments, const Target& target) {
  const std::vector<double> v = parse_numbers(arguments.impact, 7, "--impact", kImpactForm);
  return impact_at(target, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6],
                   break_test_from(arguments.break_test, "--break-test"));
}

Broken break_by_impact(const Impact& impact, const Target& target, const Breakable& breakable,
                       Context& context) {
  Broken broken{{impact}, fragments_of(target.mesh, breakable.fracture(impact, context)), {}, ""};
  if (broken.fragments.size() < 2) broken.reason = "the method left the body whole";
  return broken;
}

/// What a method cannot do is a result too.
Broken break_body(const FractureArguments& arguments, const Method& method, const Options& options,
                  const Target& target, Context& context) {
  // Pauses while a stage of its own name runs, so that the times add up.
  const auto rest = context.timer.stage("other");
  // Before the body is prepared, which may take long, to end in a refusal.
  std::optional<Impact> impact;
  if (!arguments.impact.empty()) impact = given_impact(arguments, target);
  try {
    const std::shared_ptr<const Breakable> breakable = [&] {
      const auto stage = context.timer.stage("prepare");
      return std::move(
          prepare_body({.method = method, .options = options, .target = target}, context).body);
    }();
    if (impact) return break_by_impact(*impact, target, *breakable, context);
    return break_by_scene(scenario_of(arguments), target, breakable, context);
  } catch (const MethodFailure& failure) {
    return {{}, {}, {}, failure.what(), true};
  }
}

Fragments in_frame(const Fragments& fragments, const ShapeFrame& frame, const std::string& which) {
  if (which == "normalized") return fragments;
  Fragments result = fragments;
  for (Fragment& fragment : result) fragment.mesh = frame.to_own(fragment.mesh);
  return result;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(
        fmt::format("--pictures {}: cannot be made: {}", folder.string(), error.message()));
  }
}

ExitCode fracture(const FractureArguments& arguments, std::stop_token stop) {
  if (!arguments.balls.empty() + !arguments.impact.empty() + !arguments.scenario.empty() != 1) {
    throw InputError(
        fmt::format("give one of --ball {}, --impact {} and --scenario FILE (a scene in TOML)",
                    kBallForm, kImpactForm));
  }
  const double side = arguments.longest_side;
  if (!std::isfinite(side) || (side > 0 && side < 1e-3)) {
    throw InputError("--longest-side: must be 0 or a length from 0.001 m to 1000 m");
  }
  const Method& method = find_method(arguments.method);
  const Options options = parse_settings(method.options(), arguments.settings,
                                         fmt::format("method '{}'", arguments.method));
  require_usable_folder(arguments.out);
  if (!arguments.pictures.empty()) make_folder(arguments.pictures);

  reset_peak_memory();
  StageTimer timer;
  CommandProgress progress;
  Random random(static_cast<std::uint64_t>(arguments.seed));
  std::vector<std::string> notes;
  Context context{.random = random,
                  .timer = timer,
                  .progress = progress,
                  .stop = stop,
                  .threads = arguments.threads,
                  .notes = &notes,
                  .pictures = arguments.pictures};

  Shape shape = load_shape({.name = arguments.mesh, .longest_side = 0});
  const ShapeFrame frame(std::move(shape.mesh), arguments.longest_side);
  for (const std::string& note : shape.notes) fmt::print(stderr, "{}: {}\n", arguments.mesh, note);
  Target target{shape.name, frame.normalized(), {}};
  if (!arguments.scenario.empty()) target.material = read_scenario(arguments.scenario).material;

  const auto begin = Clock::now();
  const Broken broken = break_body(arguments, method, options, target, context);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();

  Json result = result_json({.body = target.mesh,
                             .fragments = broken.fragments,
                             .impacts = broken.impacts,
                             .stages = timer.times(),
                             .total_seconds = seconds,
                             .peak_memory = static_cast<double>(peak_memory()),
                             .threads = arguments.threads});
  if (!broken.reason.empty()) result["reason"] = broken.reason;
  if (!notes.empty()) result["notes"] = notes;
  result["method"] = arguments.method;
  result["options"] = options.to_json();
  result["mesh"] = arguments.mesh;
  result["seed"] = arguments.seed;
  result["impacts"] = impacts_json(broken.impacts);
  std::map<std::string, Json> documents{{kResultFile, result}};
  if (!broken.trajectory.tracks.empty()) {
    documents[kTrajectoryFile] = trajectory_json(broken.trajectory);
  }
  write_fragment_folder(arguments.out, in_frame(broken.fragments, frame, arguments.frame),
                        arguments.format, documents);
  if (arguments.as_json) {
    print_json(result);
  } else {
    fmt::print("{}", describe_result(result));
    if (!broken.reason.empty()) fmt::print("not broken         {}\n", broken.reason);
    for (const std::string& note : notes) fmt::print("note               {}\n", note);
    fmt::print("written to         {}\n", arguments.out.string());
  }
  return broken.failed ? ExitCode::not_measured : ExitCode::good;
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
  command->add_option("--scenario", a->scenario,
                      "Run a scene written in TOML instead (docs/scenarios.md)");
  command
      ->add_option(
          "--break-test", a->break_test,
          "When a body that is hit breaks (docs/scenarios.md); light bodies need eq2-patch. With "
          "--impact the method decides; those that ask go by this test")
      ->check(CLI::IsMember(break_test_names()))
      ->excludes("--scenario")
      ->capture_default_str();
  command
      ->add_option("--out", a->out,
                   "Folder for fragments, fragments.glb, result.json and trajectory.json")
      ->required();
  command->add_option(
      "--pictures", a->pictures,
      "Folder for pictures of how it broke (VTK files), from methods that make any");
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
  command
      ->add_option("--longest-side", a->longest_side,
                   "Size in the normalised frame, m; 0: the mesh's own place and scale")
      ->check(CLI::Range(0., 1e3))
      ->capture_default_str();
  command->add_option("--seed", a->seed, "Of the method's random choices")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->capture_default_str();
  command->add_option("--threads", a->threads, "Threads that the method may use")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print the result as one JSON object");
  command->callback(
      [&chosen, a] { chosen = [a](std::stop_token stop) { return fracture(*a, stop); }; });
}

}  // namespace fracbench
