#include "methods/bem/fast_model.h"

#include <utility>

#include "methods/bem/front_frames.h"
#include "methods/bem/growth_law.h"

namespace fracbench::bem {

StressIntensityModel fast_model(StressField stress, const FastFactors& factors,
                                double compressive_factor) {
  return [stress = std::move(stress), factors,
          compressive_factor](std::span<const CrackSheet> cracks) {
    std::vector<Vec3> points;
    for (const CrackSheet& crack : cracks) {
      for (std::size_t i = 0; i < crack.boundary.size(); ++i) {
        if (crack.states[i] != FrontState::advancing) continue;
        points.push_back(crack.mesh.vertices[crack.boundary[i]]);
      }
    }
    const std::vector<Mat3> stresses = stress(points);
    std::size_t next = 0;
    std::vector<std::vector<StressIntensity>> result;
    for (const CrackSheet& crack : cracks) {
      const std::vector<FrontFrame> frames = front_frames(crack);
      const double area = sheet_area(crack);
      auto& intensities = result.emplace_back(crack.boundary.size());
      for (std::size_t i = 0; i < crack.boundary.size(); ++i) {
        if (crack.states[i] != FrontState::advancing) continue;
        const Mat3 driving = driving_stress(stresses[next++], compressive_factor);
        intensities[i] = fast_stress_intensity(driving, area, frames[i], factors);
      }
    }
    return result;
  };
}

}  // namespace fracbench::bem
