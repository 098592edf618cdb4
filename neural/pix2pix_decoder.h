#pragma once

#include <vector>

#include "neural/field_decoder.h"

namespace fracbench::neural {

/// What the pix2pix generator is given: an r^3 volume of zeros that holds, at the voxel of each
/// impulse's point, one plus its scaled strength (0 for none, 2 for the strongest one ever).
std::vector<float> impulse_volume(std::span<const float> impulses, const ImpulseScaling& scaling,
                                  int resolution);

/// The generator of a 3D pix2pix (Isola et al. 2017, with all convolutions in 3D): a U-Net of
/// convolutions of kernel 4 and stride 2 down to 4^3 voxels, and transposed ones up again, each
/// given the features of its level on the way down as well.
class Pix2pixDecoder : public FieldDecoder {
 public:
  explicit Pix2pixDecoder(const Model& model) : model_(model) {}

  VoxelGrid<float> decode(const FieldSource& source, int resolution, int threads) const override;

 private:
  const Model& model_;
};

}  // namespace fracbench::neural
