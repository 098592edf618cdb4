#include "scenarios/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "geometry/measures.h"
#include "scenarios/shapes/generated_shapes.h"
#include "scenarios/shapes/paper_shapes.h"
#include "scenarios/shapes/solid_file.h"

namespace fracbench {
namespace {

// Longest side of the generated shapes, m.
constexpr double usual_size = 1.9;

constexpr const char* bunny_summary = "Stanford bunny of the npm package bunny, 3674 faces";
constexpr const char* bunny_how_to_get =
    "it comes from the npm package bunny: run ./scripts/install.sh, or set FRACBENCH_DATA to the "
    "folder that holds bunny.obj";

std::filesystem::path bunny_file() {
  const char* folder = std::getenv("FRACBENCH_DATA");
  return std::filesystem::path(folder != nullptr ? folder : FRACBENCH_DATA_DIR) / "bunny.obj";
}

TriangleMesh make(const GeneratedShape& shape, int resolution) {
  if (resolution == 0) resolution = shape.default_resolution;
  if (resolution < shape.least_resolution || resolution > greatest_resolution) {
    throw InputError(fmt::format(
        "shape '{}': resolution {} is out of range; it counts subdivisions along the longest side "
        "and must be 0 (default, {}) or from {} to {}",
        shape.name, resolution, shape.default_resolution, shape.least_resolution,
        greatest_resolution));
  }
  return shape.make(resolution);
}

Shape from_file(const std::string& name, const std::filesystem::path& file) {
  SolidFile solid = read_solid(file);
  return {name, std::move(solid.mesh), std::move(solid.notes)};
}

Shape from_paper(const PaperShape& shape) {
  const std::filesystem::path folder = shapes_folder();
  if (const auto file = find_paper_shape(shape, folder)) {
    Shape result = from_file(std::string(shape.name), *file);
    result.notes.insert(result.notes.begin(),
                        fmt::format("recognised in {} by its proportions", file->string()));
    return result;
  }
  std::string where = folder.empty()
                          ? "FRACBENCH_SHAPES is not set"
                          : fmt::format("no file in {} has its proportions", folder.string());
  if (shape.file == 0) where = "it cannot be recognised";
  throw InputError(
      fmt::format("shape '{}' is not there ({}): {}", shape.name, where, how_to_get(shape)));
}

std::optional<Shape> by_name(const ShapeRequest& request) {
  for (const GeneratedShape& shape : generated_shapes()) {
    if (shape.name == request.name) {
      return Shape{request.name, normalized(make(shape, request.resolution), usual_size), {}};
    }
  }
  if (request.name == "bunny") {
    const std::filesystem::path file = bunny_file();
    if (!std::filesystem::exists(file)) {
      throw InputError(fmt::format("shape 'bunny' is not there ({} is missing): {}", file.string(),
                                   bunny_how_to_get));
    }
    return from_file("bunny", file);
  }
  for (const PaperShape& shape : paper_shapes()) {
    if (shape.name == request.name) return from_paper(shape);
  }
  return {};
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const GeneratedShape& shape : generated_shapes()) names.emplace_back(shape.name);
  names.emplace_back("bunny");
  for (const PaperShape& shape : paper_shapes()) names.emplace_back(shape.name);
  return names;
}

/// The shape of this name, else of this path.
Shape find(const ShapeRequest& request) {
  if (std::optional<Shape> named = by_name(request)) return *std::move(named);
  const std::filesystem::path file = request.name;
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !file.has_extension() && !file.has_parent_path()) {
    throw InputError(fmt::format("there is no shape and no file '{}'{}", request.name,
                                 did_you_mean(request.name, shape_names())));
  }
  return from_file(file.stem().string(), file);
}

void scale(Shape& shape, double longest_side) {
  const double before = bounding_box(shape.mesh).longest_side();
  shape.mesh = normalized(shape.mesh, longest_side);
  const double factor = longest_side / before;
  if (std::abs(factor - 1) > 1e-6) {
    shape.notes.push_back(
        fmt::format("scaled by {:.6g} to a longest side of {:g} m", factor, longest_side));
  }
}

}  // namespace

std::vector<ShapeInfo> list_shapes() {
  std::vector<ShapeInfo> shapes;
  for (const GeneratedShape& shape : generated_shapes()) {
    shapes.push_back({.name = std::string(shape.name),
                      .summary = std::string(shape.summary),
                      .source = "generated",
                      .how_to_get = ""});
  }
  const bool has_bunny = std::filesystem::exists(bunny_file());
  shapes.push_back({.name = "bunny",
                    .summary = bunny_summary,
                    .source = "package",
                    .available = has_bunny,
                    .how_to_get = has_bunny ? "" : bunny_how_to_get});
  for (const PaperShape& shape : paper_shapes()) {
    const bool available = find_paper_shape(shape, shapes_folder()).has_value();
    shapes.push_back({.name = std::string(shape.name),
                      .summary = std::string(shape.summary),
                      .source = "file",
                      .available = available,
                      .how_to_get = available ? "" : how_to_get(shape)});
  }
  return shapes;
}

Shape load_shape(const ShapeRequest& request) {
  if (!(request.longest_side >= 0) || std::isinf(request.longest_side)) {
    throw InputError(fmt::format("shape '{}': longest side {} m must be 0 or more", request.name,
                                 request.longest_side));
  }
  Shape shape = find(request);
  if (request.longest_side > 0) scale(shape, request.longest_side);
  return shape;
}

}  // namespace fracbench
