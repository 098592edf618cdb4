#include "scenarios/shapes.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "geometry/measures.h"
#include "scenarios/shapes/generated_shapes.h"

namespace fracbench {
namespace {

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

}  // namespace

std::vector<ShapeInfo> list_shapes() {
  std::vector<ShapeInfo> shapes;
  for (const GeneratedShape& shape : generated_shapes()) {
    shapes.push_back({.name = std::string(shape.name),
                      .summary = std::string(shape.summary),
                      .source = "generated",
                      .how_to_get = ""});
  }
  return shapes;
}

Shape load_shape(const ShapeRequest& request) {
  std::vector<std::string> names;
  for (const GeneratedShape& shape : generated_shapes()) {
    if (shape.name == request.name) {
      const TriangleMesh mesh = make(shape, request.resolution);
      return {request.name,
              request.longest_side > 0 ? normalized(mesh, request.longest_side) : mesh,
              {}};
    }
    names.emplace_back(shape.name);
  }
  throw InputError(
      fmt::format("there is no shape '{}'{}", request.name, did_you_mean(request.name, names)));
}

}  // namespace fracbench
