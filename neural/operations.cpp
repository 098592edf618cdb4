#include "neural/operations.h"

#include <cmath>

namespace fracbench::neural {

namespace {

double operations_of(const DecoderLayer& layer) {
  return 2.0 * layer.in * layer.out * 64 * std::pow(layer.side, 3);
}

double linear_operations(const NetworkOptions& options) {
  return 2.0 * options.code_size() * base_channels(options) * std::pow(kBaseSide, 3);
}

/// All outputs, of which the coarser ones are on the way to the finest.
double voxel_work(const NetworkOptions& options) {
  double sum = linear_operations(options);
  for (const DecoderLayer& layer : decoder_blocks(options)) sum += operations_of(layer);
  for (const DecoderLayer& layer : decoder_heads(options)) sum += operations_of(layer);
  return sum;
}

}  // namespace

double decoding_operations(const NetworkOptions& options, int resolution) {
  double sum = linear_operations(options);
  for (const DecoderLayer& layer : decoder_blocks(options)) {
    if (4 * layer.side <= resolution) sum += operations_of(layer);
  }
  for (const DecoderLayer& layer : decoder_heads(options)) {
    if (2 * layer.side == resolution) sum += operations_of(layer);
  }
  return sum;
}

double training_work(const NetworkOptions& options) {
  switch (options.decoder) {
    case Decoder::voxel:
      return voxel_work(options);
    case Decoder::implicit:  // as many places of each field, however fine it is
      return static_cast<double>(options.resolutions.size());
    case Decoder::pix2pix:
      return std::pow(options.resolutions.back(), 3);
  }
  return 1;
}

}  // namespace fracbench::neural
