#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/random.h"
#include "neural/learned_shape.h"
#include "neural/network_options.h"
#include "neural/siren.h"

namespace fracbench::neural {

/// One epoch of a training.
struct EpochRecord {
  double loss = 0;     ///< mean over the patterns of the training objective
  double seconds = 0;  ///< that it took
};

/// A trained network, complete: what it needs to predict, and where it comes from.
struct Model {
  NetworkOptions network;
  std::vector<LearnedShape> shapes;
  double field_unit = 1;  ///< m: what 1 of its outputs stands for
  Siren siren;
  std::map<std::string, std::vector<float>> weights;  ///< by the names of weight_specs
  /// Statistics of batch normalisation, "block0.mean" and "block0.variance", where the network
  /// uses stored ones.
  std::map<std::string, std::vector<float>> statistics;
  /// Rows of network.code_size() values (E(J), Z^segment), equation (7) of the paper.
  std::vector<float> codebook;
  std::vector<std::int32_t> codebook_pattern;  ///< per row the training pattern it comes from
  std::vector<std::int32_t> codebook_shape;    ///< and whose pattern that is: index into `shapes`
  std::vector<EpochRecord> epochs;
  std::string provenance;  ///< JSON: options of the training, data set, program, machine, time

  std::size_t rows() const { return codebook_pattern.size(); }
  std::span<const float> row(std::size_t k) const;
};

/// One file (core/array_file.h): the shapes (learned_shape.h), the texts `network` (JSON) and
/// `provenance`, and the arrays `field_unit`, `siren.weight`, `siren.bias`, `codebook`,
/// `codebook_pattern`, `codebook_shape`, `epoch_loss`, `epoch_seconds`, `statistics/...` and
/// `weights/...`.
void write_model(const std::filesystem::path& file, const Model& model);

/// Reads such a file; nothing in it is run. Throws InputError where it cannot be read, is damaged,
/// or an array has not the size that the network's options ask for.
Model read_model(const std::filesystem::path& file);

/// A segment code as they are initialised and drawn: Xavier-normal for a row of n values, standard
/// deviation sqrt(2 / (n + 1)).
std::vector<float> random_segment_code(int size, Random& random);

/// Of the rows of that shape in the codebook the one nearest to (E(J), Z^random) in the Euclidean
/// norm over all values, equations (8) and (9); the first of equals. Throws InputError where it has
/// none, or the number of impulses is not the network's.
std::size_t nearest_row(const Model& model, std::size_t shape, std::span<const float> impulses,
                        Random& random);

}  // namespace fracbench::neural
