#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "neural/learned_shape.h"

namespace fracbench::neural {

/// One broken body, as a network sees it.
struct Pattern {
  std::string name;             ///< "single-0012"
  int shape = 0;                ///< whose it is: index into DataSet::shapes
  std::vector<float> impulses;  ///< the features' vectors [p d I], see core/impulse_vector.h
  /// GS-SDF by resolution r: r^3 values on unit_grid(r) (core/voxel_grid.h), x fastest, m.
  std::map<int, std::vector<float>> fields;

  bool operator==(const Pattern&) const = default;
};

/// What a network learns from, complete: a training machine needs nothing else.
struct DataSet {
  std::vector<LearnedShape> shapes;
  std::string provenance;  ///< JSON: where the patterns come from, material included
  int features = 1;        ///< impulses in each pattern
  /// m: what 1 stands for in a network's output, which tanh keeps within +-1. Where fields are
  /// truncated, their limit: the network then sees them as large as it can tell them.
  double field_unit = 1;
  std::vector<Pattern> patterns;

  bool operator==(const DataSet&) const = default;
};

/// One file (core/array_file.h, packed) with
///   patterns/<k>/impulses   float32, 7 values for each feature
///   patterns/<k>/<r>        float32, r^3 values
///   pattern_shape           int32, for each pattern
///   field_unit              float64
/// the shapes (learned_shape.h) and the texts `provenance` and `names` (JSON). Throws InputError.
void write_data_set(const std::filesystem::path& file, const DataSet& data);

/// Throws InputError where the file cannot be read, is damaged, or its numbers do not fit together.
DataSet read_data_set(const std::filesystem::path& file);

/// The patterns of all of them, as one network may learn them. Throws InputError where a shape is
/// in two of them, or they differ in what a pattern is.
DataSet joined(std::vector<DataSet> sets);

/// SHA-256 of everything in it.
std::string digest_of(const DataSet& data);

}  // namespace fracbench::neural
