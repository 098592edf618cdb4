#include "scenarios/shapes/paper_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "geometry/measures.h"
#include "geometry/read_fragments.h"
#include "geometry/read_mesh.h"

namespace fracbench {
namespace {

// Remeshing moves volume and box by less; the shapes differ from each other by much more.
constexpr double tolerance = 0.01;

// Files that neither a number nor a name speaks for: a whole Thingi10K would take too long.
constexpr std::size_t most_unnamed_files = 200;

constexpr std::array<PaperShape, 4> shapes{{
    {"squirrel", "the paper's Squirrel", 11705, 37384, {0.230561, 0.89990, 0.63132}},
    {"base", "the paper's Base", 17204, 56265, {0.099359, 0.99996, 0.13691}},
    {"bunny-paper", "the paper's Bunny", 240197, 441708, {0.222496, 0.99828, 0.81324}},
    {"pot-paper", "the paper's Pot", 12120, 0, {}},
}};

bool is_named_after(const std::filesystem::path& file, const PaperShape& shape) {
  const std::string stem = file.stem().string();
  const auto has = [&](std::string_view part) { return stem.find(part) != std::string::npos; };
  return has(std::to_string(shape.file)) || has(std::to_string(shape.thing)) ||
         has(shape.name.substr(0, shape.name.find('-')));
}

bool holds(const std::filesystem::path& file, const PaperShape& shape) {
  try {
    return signature(read_mesh(file)).matches(shape.signature);
  } catch (const InputError&) {
    return false;  // not a mesh: not this shape
  }
}

}  // namespace

bool ShapeSignature::matches(const ShapeSignature& other) const {
  const auto near = [](double l, double r) { return std::abs(l - r) <= tolerance * std::abs(r); };
  return near(volume, other.volume) && near(middle_side, other.middle_side) &&
         near(shortest_side, other.shortest_side);
}

ShapeSignature signature(const TriangleMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  std::array<double, 3> side;
  for (int axis = 0; axis < 3; ++axis) side[axis] = box.high[axis] - box.low[axis];
  std::sort(side.begin(), side.end());
  if (!(side[2] > 0)) return {};
  return {std::abs(volume(mesh)) / (side[2] * side[2] * side[2]), side[1] / side[2],
          side[0] / side[2]};
}

std::span<const PaperShape> paper_shapes() { return shapes; }

std::filesystem::path shapes_folder() {
  const char* folder = std::getenv("FRACBENCH_SHAPES");
  return folder != nullptr ? folder : "";
}

std::optional<std::filesystem::path> find_paper_shape(const PaperShape& shape,
                                                      const std::filesystem::path& folder) {
  if (shape.file == 0 || folder.empty()) return {};
  std::vector<std::filesystem::path> files = mesh_files(folder);
  const auto unnamed = std::stable_partition(
      files.begin(), files.end(), [&](const auto& file) { return is_named_after(file, shape); });
  const auto count = static_cast<std::size_t>(files.end() - unnamed);
  files.erase(unnamed + static_cast<std::ptrdiff_t>(std::min(count, most_unnamed_files)),
              files.end());
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const auto& file) { return holds(file, shape); });
  if (found == files.end()) return {};
  return *found;
}

std::string how_to_get(const PaperShape& shape) {
  if (shape.file == 0) {
    return fmt::format(
        "the paper names thing {} of Thingiverse, which has many files, and does not say which it "
        "used; give the path of the one you mean, or use the generated shape 'pot'",
        shape.thing);
  }
  return fmt::format(
      "it is file {} (thing {}) of the Thingi10K collection, "
      "https://ten-thousand-models.appspot.com;"
      " put it into a folder and set FRACBENCH_SHAPES to that folder",
      shape.file, shape.thing);
}

}  // namespace fracbench
