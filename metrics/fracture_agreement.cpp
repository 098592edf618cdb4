#include "metrics/fracture_agreement.h"

#include "geometry/fragment_labels.h"

namespace fracbench {

ComparableFracture::ComparableFracture(const Fragments& fragments, const FractureSamples& samples,
                                       Random& random)
    : labels_(fragment_labels(fragments, unit_grid<std::int32_t>(samples.resolution), 1).values),
      surfaces_(fragments, samples.surfaces, random) {}

FractureAgreement ComparableFracture::agreement(const ComparableFracture& other) const {
  return {.partition = partition_agreement(labels_, other.labels_),
          .surfaces = surfaces_.surface_agreement(other.surfaces_),
          .fragment_chamfer = surfaces_.fragment_chamfer(other.surfaces_)};
}

}  // namespace fracbench
