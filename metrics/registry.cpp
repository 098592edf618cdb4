#include "metrics/registry.h"

#include "metrics/fracture_normals.h"
#include "metrics/fragment_count.h"
#include "metrics/fragment_volumes.h"
#include "metrics/locality.h"
#include "metrics/peak_memory.h"
#include "metrics/roughness.h"
#include "metrics/stage_times.h"
#include "metrics/surface_retention.h"
#include "metrics/validity.h"

namespace fracbench {

const std::vector<std::unique_ptr<Metric>>& metrics() {
  static const auto all = [] {
    std::vector<std::unique_ptr<Metric>> list;
    list.push_back(std::make_unique<FragmentCount>());
    list.push_back(std::make_unique<FragmentVolumes>());
    list.push_back(std::make_unique<FractureNormals>());
    list.push_back(std::make_unique<Roughness>());
    list.push_back(std::make_unique<Locality>());
    list.push_back(std::make_unique<Validity>());
    list.push_back(std::make_unique<SurfaceRetention>());
    list.push_back(std::make_unique<StageTimes>());
    list.push_back(std::make_unique<PeakMemory>());
    return list;
  }();
  return all;
}

}  // namespace fracbench
