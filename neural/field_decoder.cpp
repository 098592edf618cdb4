#include "neural/field_decoder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.h"
#include "neural/implicit_decoder.h"
#include "neural/pix2pix_decoder.h"
#include "neural/voxel_decoder.h"

namespace fracbench::neural {

void require_resolution(const NetworkOptions& network, int resolution) {
  if (std::ranges::find(network.resolutions, resolution) != network.resolutions.end()) return;
  throw InputError(fmt::format("the model has no output of resolution {}, only of {}", resolution,
                               fmt::join(network.resolutions, ", ")));
}

std::unique_ptr<FieldDecoder> make_decoder(const Model& model) {
  switch (model.network.decoder) {
    case Decoder::voxel:
      return std::make_unique<VoxelDecoder>(model);
    case Decoder::implicit:
      return std::make_unique<ImplicitDecoder>(model);
    case Decoder::pix2pix:
      return std::make_unique<Pix2pixDecoder>(model);
  }
  return nullptr;
}

}  // namespace fracbench::neural
