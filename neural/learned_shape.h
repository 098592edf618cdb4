#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/array_file.h"
#include "core/impulse_vector.h"

namespace fracbench::neural {

/// A target, as data sets and models know it: one network may learn the fractures of several.
struct LearnedShape {
  std::string name;        ///< for people
  std::string digest;      ///< of its mesh
  ImpulseScaling scaling;  ///< of the impulses on it

  bool operator==(const LearnedShape&) const = default;
};

/// Its place in the list, where it is there.
std::optional<std::size_t> find_shape(std::span<const LearnedShape> shapes,
                                      std::string_view digest);

/// "pot", or "pot, mug".
std::string names_of(std::span<const LearnedShape> shapes);

/// In a file: the text `shapes` (JSON, objects with `name` and `digest`) and the array `scaling`,
/// float64, for each of them centre (3), half side and I_max.
void put_shapes(ArrayFile& file, std::span<const LearnedShape> shapes);

/// Throws InputError where they are missing or no scaling of a body; nlohmann::json::exception
/// where the text is none.
std::vector<LearnedShape> take_shapes(ArrayFile& file);

}  // namespace fracbench::neural
