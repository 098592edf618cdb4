#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/impulse_vector.h"

namespace fracbench::neural {

/// One broken body, as a network sees it.
struct Pattern {
  std::string name;             ///< "single-0012"
  std::vector<float> impulses;  ///< the features' vectors [p d I], see core/impulse_vector.h
  /// GS-SDF by resolution r: r^3 values on unit_grid(r) (core/voxel_grid.h), x fastest, m.
  std::map<int, std::vector<float>> fields;

  bool operator==(const Pattern&) const = default;
};

/// What a network learns from, complete: a training machine needs nothing else.
struct DataSet {
  std::string shape;         ///< name of the target, for people
  std::string shape_digest;  ///< of its mesh
  std::string provenance;    ///< JSON: where the patterns come from, material included
  int features = 1;          ///< impulses in each pattern
  ImpulseScaling scaling;
  /// m: what 1 stands for in a network's output, which tanh keeps within +-1. Where fields are
  /// truncated, their limit: the network then sees them as large as it can tell them.
  double field_unit = 1;
  std::vector<Pattern> patterns;

  bool operator==(const DataSet&) const = default;
};

/// One file (core/array_file.h, packed) with
///   patterns/<k>/impulses   float32, 7 values for each feature
///   patterns/<k>/<r>        float32, r^3 values
///   scaling                 float64: centre (3), half side, I_max
///   field_unit              float64
/// and the texts `shape`, `shape_digest`, `provenance` and `names` (JSON). Throws InputError.
void write_data_set(const std::filesystem::path& file, const DataSet& data);

/// Throws InputError where the file cannot be read, is damaged, or its numbers do not fit together.
DataSet read_data_set(const std::filesystem::path& file);

/// SHA-256 of everything in it.
std::string digest_of(const DataSet& data);

}  // namespace fracbench::neural
