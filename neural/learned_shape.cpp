#include "neural/learned_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench::neural {

namespace {

constexpr const char* kShapes = "shapes";
constexpr const char* kScaling = "scaling";
constexpr std::size_t kScalingValues = 5;

}  // namespace

std::optional<std::size_t> find_shape(std::span<const LearnedShape> shapes,
                                      std::string_view digest) {
  const auto found = std::ranges::find(shapes, digest, &LearnedShape::digest);
  if (found == shapes.end()) return std::nullopt;
  return static_cast<std::size_t>(found - shapes.begin());
}

std::string names_of(std::span<const LearnedShape> shapes) {
  std::string text;
  for (const LearnedShape& shape : shapes) text += (text.empty() ? "" : ", ") + shape.name;
  return text;
}

void put_shapes(ArrayFile& file, std::span<const LearnedShape> shapes) {
  auto list = nlohmann::json::array();
  std::vector<double>& scaling = file.reals[kScaling];
  for (const LearnedShape& shape : shapes) {
    list.push_back({{"name", shape.name}, {"digest", shape.digest}});
    const Vec3& c = shape.scaling.centre;
    scaling.insert(scaling.end(),
                   {c.x(), c.y(), c.z(), shape.scaling.half_side, shape.scaling.max_impulse});
  }
  file.texts[kShapes] = list.dump();
}

std::vector<LearnedShape> take_shapes(ArrayFile& file) {
  const auto text = file.texts.find(kShapes);
  if (text == file.texts.end()) throw InputError("it has no text 'shapes'");
  const std::vector<double>& scaling = file.reals[kScaling];
  std::vector<LearnedShape> shapes;
  for (const auto& entry : nlohmann::json::parse(text->second)) {
    const std::size_t at = kScalingValues * shapes.size();
    if (scaling.size() < at + kScalingValues) break;
    const std::span<const double> s = std::span(scaling).subspan(at, kScalingValues);
    if (!std::ranges::all_of(s, [](double v) { return std::isfinite(v); }) || s[3] <= 0 ||
        s[4] <= 0) {
      throw InputError("array 'scaling' is not that of a body");
    }
    shapes.push_back(
        {.name = entry.at("name"),
         .digest = entry.at("digest"),
         .scaling = {.centre = {s[0], s[1], s[2]}, .half_side = s[3], .max_impulse = s[4]}});
  }
  if (shapes.empty() || kScalingValues * shapes.size() != scaling.size()) {
    throw InputError("its shapes and their scaling do not fit");
  }
  return shapes;
}

}  // namespace fracbench::neural
