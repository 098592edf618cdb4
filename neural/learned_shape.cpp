#include "neural/learned_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/error.h"

namespace fracbench::neural {

namespace {

constexpr const char* kShapes = "shapes";
constexpr const char* kScaling = "scaling";

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
    std::ranges::copy(scaling_values(shape.scaling), std::back_inserter(scaling));
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
    const auto values = std::span(scaling).subspan(at).first<kScalingValues>();
    const ImpulseScaling of_shape = scaling_of(values);
    if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }) ||
        of_shape.half_side <= 0 || of_shape.max_impulse <= 0) {
      throw InputError("array 'scaling' is not that of a body");
    }
    shapes.push_back({.name = entry.at("name"), .digest = entry.at("digest"), .scaling = of_shape});
  }
  if (shapes.empty() || kScalingValues * shapes.size() != scaling.size()) {
    throw InputError("its shapes and their scaling do not fit");
  }
  return shapes;
}

}  // namespace fracbench::neural
