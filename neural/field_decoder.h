#pragma once

#include <memory>
#include <span>

#include "core/voxel_grid.h"
#include "neural/model.h"

namespace fracbench::neural {

/// What a field is decoded from.
struct FieldSource {
  std::span<const float> code;      ///< network.code_size() values
  std::span<const float> impulses;  ///< 7 for each feature; what the pix2pix decoder goes by
};

/// Decodes fields with a trained model, whatever its kind, arranged for prediction: no gradients,
/// and matrix products for all the work. The number of threads of BLAS is a setting of the process.
class FieldDecoder {
 public:
  virtual ~FieldDecoder() = default;

  /// The field at one of the network's resolutions, m. Throws InputError for another resolution,
  /// naming those that there are, and for sources of another length. That of a voxel decoder is the
  /// same for any number of threads.
  virtual VoxelGrid<float> decode(const FieldSource& source, int resolution, int threads) const = 0;
};

/// The decoder of the model's kind; the model must outlive it. Throws InputError where the model's
/// statistics are missing.
std::unique_ptr<FieldDecoder> make_decoder(const Model& model);

/// Throws InputError where the network has no output of that resolution.
void require_resolution(const NetworkOptions& network, int resolution);

}  // namespace fracbench::neural
