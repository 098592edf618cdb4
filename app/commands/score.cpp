#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/arguments.h"
#include "app/command.h"
#include "app/fragment_folder.h"
#include "app/result_json.h"
#include "app/shape_frame.h"
#include "core/error.h"
#include "core/peak_memory.h"
#include "core/stage_timer.h"
#include "geometry/measures.h"
#include "geometry/read_fragments.h"
#include "geometry/tag_surfaces.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

struct ScoreArguments {
  std::filesystem::path fragments;
  std::string parent;
  std::string direction;
  int threads = 2;
  bool as_json = false;
};

/// An impact of which only the direction is known, for the metrics that look along it.
std::vector<Impact> impacts_along(const std::string& direction) {
  if (direction.empty()) return {};
  const std::vector<double> v = parse_numbers(direction, 3, "--direction", "dx,dy,dz");
  const Vec3 along(v[0], v[1], v[2]);
  if (along.norm() == 0) {
    throw InputError(fmt::format("--direction {}: has no length", direction));
  }
  Impulse impulse{.point = Vec3::Zero(), .direction = along.normalized(), .normal = Vec3::Zero()};
  Impact impact;
  impact.impulses.push_back(impulse);
  return {impact};
}

/// Fragments that lie elsewhere than the parent are in another frame: better said than measured.
void require_same_place(const std::vector<TriangleMesh>& meshes, const TriangleMesh& parent,
                        const ScoreArguments& arguments) {
  const BoundingBox box = bounding_box(parent);
  const double slack = 0.05 * box.longest_side();
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    if (meshes[k].empty()) continue;
    const BoundingBox own = bounding_box(meshes[k]);
    const bool apart = ((own.low.array() > box.high.array() + slack) ||
                        (own.high.array() < box.low.array() - slack))
                           .any();
    if (apart) {
      throw InputError(fmt::format(
          "{}: fragment {} lies at ({:.4g}, {:.4g}, {:.4g}), outside the box of {}; fragments and "
          "parent must be in the same frame, as if the fragments had not moved",
          arguments.fragments.string(), k, own.center().x(), own.center().y(), own.center().z(),
          arguments.parent));
    }
  }
}

ExitCode score(const ScoreArguments& arguments) {
  reset_peak_memory();
  StageTimer timer;
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<Impact> impacts = impacts_along(arguments.direction);
  Shape shape;
  std::vector<TriangleMesh> meshes;
  {
    const auto stage = timer.stage("read");
    meshes = read_fragment_meshes(arguments.fragments);
    shape = load_shape({.name = arguments.parent, .longest_side = 0});
    for (const std::string& note : shape.notes) {
      fmt::print(stderr, "{}: {}\n", arguments.parent, note);
    }
    require_same_place(meshes, shape.mesh, arguments);
  }
  const ShapeFrame frame(std::move(shape.mesh));
  Fragments fragments;
  {
    const auto stage = timer.stage("tag");
    for (TriangleMesh& mesh : meshes) mesh = frame.to_normalized(mesh);
    fragments =
        tag_fragments(frame.normalized(), std::move(meshes), {.threads = arguments.threads});
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const nlohmann::ordered_json result =
      result_json({.body = frame.normalized(),
                   .fragments = fragments,
                   .impacts = impacts,
                   .stages = timer.times(),
                   .total_seconds = seconds.count(),
                   .peak_memory = static_cast<double>(peak_memory()),
                   .threads = arguments.threads});
  if (arguments.as_json) {
    print_json(result);
  } else {
    fmt::print("{}", describe_result(result));
  }
  return ExitCode::good;
}

}  // namespace

void add_score_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("score", "Measure fragments that any tool made");
  auto a = std::make_shared<ScoreArguments>();
  command
      ->add_option("fragments", a->fragments,
                   "Folder with a mesh file for each fragment (OBJ, PLY, STL, OFF), or one file "
                   "whose connected parts are the fragments; in the frame of the parent")
      ->required();
  command->add_option("--parent", a->parent, "The mesh before it broke: a file or a named shape")
      ->required();
  command->add_option("--direction", a->direction,
                      "Direction dx,dy,dz of the impulse, for the metrics that look along it");
  command->add_option("--threads", a->threads, "Threads to use")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print the result as one JSON object");
  command->callback([&chosen, a] { chosen = [a](std::stop_token) { return score(*a); }; });
}

}  // namespace fracbench
