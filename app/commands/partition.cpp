#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/fragment_folder.h"
#include "app/result_json.h"
#include "app/shape_frame.h"
#include "core/error.h"
#include "core/peak_memory.h"
#include "core/stage_timer.h"
#include "geometry/partition_by_labels.h"
#include "geometry/read_label_volume.h"
#include "scenarios/fragments_of_pieces.h"
#include "scenarios/shapes.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

struct PartitionArguments {
  std::string mesh;
  std::filesystem::path labels;
  std::filesystem::path out;
  std::string path = "fast";
  std::string format = "obj";
  PartitionOptions options;
  bool as_json = false;
};

Json to_json(const PartitionReport& report) {
  return {{"piece_label", report.piece_label},
          {"split_labels", report.split_labels},
          {"labels_without_piece", report.labels_without_piece},
          {"merged_parts", report.merged_parts},
          {"merged_volume", report.merged_volume},
          {"small_parts_kept", report.small_parts_kept},
          {"filled_voxels", report.filled_voxels},
          {"ambiguous_cells", report.ambiguous_cells}};
}

/// What the grid could not resolve, for people.
std::string describe(const PartitionReport& report) {
  std::string text;
  if (!report.split_labels.empty()) {
    text += fmt::format("labels with several connected parts, each a piece: {}\n",
                        fmt::join(report.split_labels, ", "));
  }
  if (!report.labels_without_piece.empty()) {
    text +=
        fmt::format("labels without a piece: {}\n", fmt::join(report.labels_without_piece, ", "));
  }
  if (report.merged_parts > 0) {
    text += fmt::format("parts smaller than the minimum, merged into a neighbour: {}\n",
                        report.merged_parts);
  }
  if (report.filled_voxels > 0) {
    text += fmt::format("voxels inside the mesh without a label, given to the nearest: {}\n",
                        report.filled_voxels);
  }
  return text;
}

ExitCode partition(const PartitionArguments& arguments) {
  if (!std::isfinite(arguments.options.minimum_voxels)) {
    throw InputError(fmt::format("--minimum-voxels {}: must be a number from 0 on",
                                 arguments.options.minimum_voxels));
  }
  require_usable_folder(arguments.out);
  reset_peak_memory();
  StageTimer timer;
  const auto begin = std::chrono::steady_clock::now();
  VoxelGrid<std::int32_t> labels;
  Shape shape;
  {
    const auto stage = timer.stage("read");
    shape = load_shape({.name = arguments.mesh, .longest_side = 0});
    for (const std::string& note : shape.notes) {
      fmt::print(stderr, "{}: {}\n", arguments.mesh, note);
    }
    labels = read_label_volume(arguments.labels);
  }
  const ShapeFrame frame(std::move(shape.mesh));
  Partition parts;
  {
    const auto stage = timer.stage("partition");
    try {
      parts = partition_by_labels(frame.own(), labels, arguments.options);
    } catch (const InputError& error) {
      throw InputError(
          fmt::format("{} and {}: {}", arguments.mesh, arguments.labels.string(), error.what()));
    }
  }
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  const Fragments fragments = fragments_of(frame.own(), std::move(parts.pieces));
  Fragments normalized = fragments;
  for (Fragment& fragment : normalized) fragment.mesh = frame.to_normalized(fragment.mesh);
  Json result = result_json({.body = frame.normalized(),
                             .fragments = normalized,
                             .impacts = {},
                             .stages = timer.times(),
                             .total_seconds = seconds.count(),
                             .peak_memory = static_cast<double>(peak_memory()),
                             .threads = arguments.options.threads});
  result["mesh"] = arguments.mesh;
  result["labels"] = arguments.labels.string();
  result["partition"] = to_json(parts.report);
  write_fragment_folder(arguments.out, fragments, arguments.format, {{kResultFile, result}});
  if (arguments.as_json) {
    print_json(result);
  } else {
    fmt::print("{}{}written to         {}\n", describe_result(result), describe(parts.report),
               arguments.out.string());
  }
  return ExitCode::good;
}

}  // namespace

void add_partition_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand("partition", "Cut a mesh into the regions of a label volume");
  auto a = std::make_shared<PartitionArguments>();
  command->add_option("mesh", a->mesh, "A mesh file (OBJ, PLY, STL, OFF) or a named shape")
      ->required();
  command
      ->add_option("labels", a->labels,
                   "NRRD or HDF5 file of whole numbers, above 0 inside; placed in the frame of the "
                   "mesh (docs/segmentation.md)")
      ->required();
  command->add_option("--out", a->out, "Folder for fragments, fragments.glb and result.json")
      ->required();
  command
      ->add_option("--path", a->path,
                   "fast: cut the surface once; exact: one corefinement for each label, slower")
      ->check(CLI::IsMember({"fast", "exact"}))
      ->capture_default_str();
  command
      ->add_option("--smoothing", a->options.smoothing_steps,
                   "Sweeps that smooth the steps of the grid; 0 keeps them")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--minimum-voxels", a->options.minimum_voxels,
                   "Smaller parts join a neighbour (fast)")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--format", a->format, "Format of the fragments' files")
      ->check(CLI::IsMember({"obj", "ply", "stl", "glb"}))
      ->capture_default_str();
  command->add_option("--threads", a->options.threads, "Threads to use")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--json", a->as_json, "Print the result as one JSON object");
  command->callback([&chosen, a] {
    a->options.path = a->path == "exact" ? PartitionPath::exact : PartitionPath::fast;
    chosen = [a](std::stop_token) { return partition(*a); };
  });
}

}  // namespace fracbench
