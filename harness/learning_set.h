#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "harness/learning_index.h"
#include "methods/method.h"

namespace fracbench {

/// What can be learned of one shape.
struct LearningShapeSet {
  std::string label;
  TriangleMesh mesh;                   ///< of the target, as its fragments were made from
  std::vector<LearningExample> train;  ///< in the order of their scenes, as is `test`
  std::vector<LearningExample> test;
  double max_impulse = 0;  ///< I_max, N s; see LearningData
  std::size_t spare = 0;   ///< collisions that broke it and are in neither
  std::size_t unbroken = 0;
  std::size_t failed = 0;
  std::string digest;  ///< of everything that determines it
};

struct LearningSet {
  std::string suite;
  std::string method;          ///< that made it
  std::string method_options;  ///< JSON
  std::string family;
  std::vector<LearningShapeSet> shapes;
};

/// Learning data of one shape of a folder that `fracbench prepare` made. Each record is verified
/// against its digests. Throws InputError where the folder holds none of that shape, DataError
/// where a record is missing, damaged or not the one that the index was made from.
LearningShapeSet load_learning_shape(const std::filesystem::path& folder,
                                     const LearningShape& shape);

/// The same for all shapes; their meshes are all in memory then.
LearningSet load_learning_set(const std::filesystem::path& folder);

/// What a method that learns is given for a shape of a plan: examples to train with, and I_max.
/// Throws InputError where the folder's data is not that of `digest` (PlannedShape), or is damaged.
LearningData load_learning_data(const std::filesystem::path& folder, std::string_view label,
                                std::string_view digest);

/// The same of a shape that is learned besides the target.
FurtherLearning load_further_learning(const std::filesystem::path& folder, std::string_view label,
                                      std::string_view digest);

}  // namespace fracbench
