#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/command.h"
#include "core/error.h"
#include "geometry/write_mesh.h"
#include "geometry/write_motion.h"
#include "harness/record_store.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  fs::path record;
  fs::path out;
  bool still = false;
};

ExitCode export_record(ExportArguments a) {
  const fs::path file = fs::weakly_canonical(a.record);
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: there is no such file", a.record.string()));
  if (file.extension() != ".h5" || file.parent_path().filename() != "records") {
    throw InputError(fmt::format(
        "{}: is no record; give the file records/KEY.h5 of a results folder", a.record.string()));
  }
  const fs::path folder = file.parent_path().parent_path();
  const std::string key = file.stem().string();
  if (a.out.empty()) a.out = key.substr(0, 12) + ".glb";
  try {
    const Record record = read_record(folder, key);
    const SceneResult& scene = record.outcome.scene;
    const TriangleMesh target = read_target(folder, record.identity.shape_digest);
    if (a.out.extension() == ".glb" && !a.still) {
      write_motion(a.out, target, scene.fragments, scene.trajectory, ball_radii(record));
    } else if (scene.fragments.empty()) {
      write_mesh(a.out, target);
    } else {
      write_fragments(a.out, scene.fragments);
    }
  } catch (const DataError& error) {
    throw InputError(fmt::format("{}: {}", a.record.string(), error.what()));
  }
  fmt::print("{}\n", a.out.string());
  return ExitCode::good;
}

}  // namespace

void add_export_command(CLI::App& app, Action& chosen) {
  auto* command = app.add_subcommand(
      "export", "Writes the fragments of a record, with their motion as animated glTF");
  auto a = std::make_shared<ExportArguments>();
  command->add_option("record", a->record, "File records/KEY.h5 of a results folder")->required();
  command->add_option("--out", a->out,
                      "File: .glb with the motion; .obj, .ply or .stl [<start of the key>.glb]");
  command->add_flag("--still", a->still, "Fragments as if they had never moved, in .glb, too");
  command->callback([&chosen, a] { chosen = [a](std::stop_token) { return export_record(*a); }; });
}

}  // namespace fracbench
