#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace fracbench::neural {

/// How a network normalises the activations of a layer over the voxels of one sample.
enum class Normalisation {
  batch,  ///< batch normalisation, as in the paper; with batches of one, over the sample itself
  group,  ///< group normalisation, eight groups of channels
};

/// Which statistics batch normalisation uses where the network is not being trained.
enum class Statistics {
  sample,       ///< those of the very sample: the function that was trained with batches of one
  running,      ///< moving averages of training, momentum 0.1 (libtorch's default, the authors')
  reestimated,  ///< the mean over all training patterns with the final weights
};

/// What makes a field of a code.
enum class Decoder {
  voxel,     ///< the paper's code-to-voxel decoder
  implicit,  ///< a perceptron of code and place, as DeepSDF: supplement, section 6
  pix2pix,   ///< a 3D U-Net from a volume that holds the impulse, no code: supplement, section 9
};

/// What a network is, without its weights. Everything of section 6.2 of the paper that has a value
/// is a parameter; defaults are the paper's.
struct NetworkOptions {
  std::vector<int> resolutions = {128};  ///< r of its outputs, ascending, of {32, 64, 128, 256}
  double width = 1;                      ///< factor of all channel counts; 1: 47 M parameters
  int features = 1;                      ///< N_features: impulses that it is given
  int impulse_code = 128;                ///< N_dim^impulse: values of the code of one impulse
  int segment_code = 8;                  ///< N_dim^segment; 0: none
  double omega = 1;                      ///< w_0 of the SIREN layer
  double slope = 0.2;                    ///< of the leaky ReLU
  Normalisation normalisation = Normalisation::batch;
  Statistics statistics = Statistics::sample;
  Decoder decoder = Decoder::voxel;
  double epsilon = 1e-5;  ///< added to variances; the authors' program has 0.8

  int code_size() const { return features * impulse_code + segment_code; }
  bool operator==(const NetworkOptions&) const = default;
};

/// One layer of the code-to-voxel decoder, a transposed convolution of kernel 4, stride 2,
/// padding 1.
struct DecoderLayer {
  std::string name;  ///< "block0", ..., "head64"
  int in = 0;        ///< channels
  int out = 0;
  int side = 0;  ///< voxels along each side of its input
  bool operator==(const DecoderLayer&) const = default;
};

/// Voxels along each side of the volume that the linear layer makes of a code.
inline constexpr int kBaseSide = 8;

/// Channels of that volume: 512 at width 1.
int base_channels(const NetworkOptions& options);

/// The blocks (convolution, normalisation, leaky ReLU), each the next one's input: 256, 128, 64 and
/// 32 channels at width 1, as many as the finest output needs.
std::vector<DecoderLayer> decoder_blocks(const NetworkOptions& options);

/// For each resolution the layer that makes its output, of the features of half that side.
std::vector<DecoderLayer> decoder_heads(const NetworkOptions& options);

/// Values of each hidden layer of the implicit decoder (512 at width 1), and how many layers.
int hidden_values(const NetworkOptions& options);
inline constexpr int kHiddenLayers = 8;
/// The hidden layer that is given the input anew, as DeepSDF has it.
inline constexpr int kSkipLayer = 4;

/// Channels of the U-Net from the volume's first halving on, down to 4^3 voxels: 64, 128, 256, 512,
/// 512 at width 1, as many as the finest resolution needs.
std::vector<int> unet_channels(const NetworkOptions& options);

struct WeightSpec {
  std::string name;
  std::vector<int> shape;
  std::size_t size() const;
};

/// The names and shapes of all trained arrays of the network, in a fixed order. Segment codes,
/// codebook and the frozen encoder are not among them.
std::vector<WeightSpec> weight_specs(const NetworkOptions& options);

/// The sum of their sizes.
std::size_t parameter_count(const NetworkOptions& options);

/// Throws InputError for values out of range, with what would do.
void check(const NetworkOptions& options);

std::string_view to_string(Normalisation value);
std::string_view to_string(Statistics value);
std::string_view to_string(Decoder value);

nlohmann::ordered_json to_json(const NetworkOptions& options);
/// Throws InputError.
NetworkOptions network_options_from_json(const nlohmann::ordered_json& json);

}  // namespace fracbench::neural
