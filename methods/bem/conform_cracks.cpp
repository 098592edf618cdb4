#include "methods/bem/conform_cracks.h"

#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "methods/bem/carve_path.h"
#include "methods/bem/front_frames.h"
#include "methods/bem/refit_sheet.h"

namespace fracbench::bem {
namespace {

SurfaceCurve curve_of(const CrackSheet& crack, const MouthRun& run) {
  const std::vector<FrontFrame> frames = front_frames(crack);
  const std::size_t count = crack.boundary.size();
  SurfaceCurve curve;
  for (std::size_t i = run.first;; i = (i + 1) % count) {
    curve.points.push_back(crack.mesh.vertices[crack.boundary[i]]);
    curve.walls.push_back(frames[i].forward);
    if (i == run.last) break;
  }
  curve.closed = curve.points.size() == count;
  return curve;
}

}  // namespace

ConformedCracks conform_cracks(const TriangleMesh& surface, std::span<const CrackSheet> cracks) {
  struct Mouth {
    std::size_t crack;
    MouthRun run;
    std::size_t curve;
  };
  CarvedSurface carved(surface);
  std::vector<Mouth> mouths;
  std::set<std::size_t> overshooting;
  for (std::size_t c = 0; c < cracks.size(); ++c) {
    for (const MouthRun& run : mouth_runs(cracks[c])) {
      if (const auto curve = carved.carve(curve_of(cracks[c], run))) {
        mouths.push_back({c, run, *curve});
      } else {
        overshooting.insert(c);
      }
    }
  }

  ConformedCracks result;
  std::vector<CrackSheet> sheets(cracks.begin(), cracks.end());
  for (const CrackSheet& sheet : sheets) {
    auto& source = result.source_boundary.emplace_back(sheet.boundary.size());
    std::iota(source.begin(), source.end(), 0);
  }
  for (const Mouth& mouth : mouths) {
    // The run's entries moved where another mouth of the same crack has been sewn on already.
    auto& source = result.source_boundary[mouth.crack];
    std::optional<std::size_t> first;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < source.size(); ++i) {
      if (source[i] == static_cast<std::int32_t>(mouth.run.first)) first = i;
      if (source[i] == static_cast<std::int32_t>(mouth.run.last)) last = i;
    }
    std::vector<Vec3> points;
    for (const std::int32_t v : carved.path(mouth.curve))
      points.push_back(carved.mesh().vertices[v]);
    auto refit = first && last ? refit_sheet(sheets[mouth.crack], {*first, *last}, points)
                               : std::optional<RefitSheet>{};
    if (!refit) {
      overshooting.insert(mouth.crack);
      continue;
    }
    for (std::int32_t& entry : refit->source) {
      if (entry >= 0) entry = source[entry];
    }
    source = std::move(refit->source);
    sheets[mouth.crack] = std::move(refit->sheet);
  }
  result.body = split_mouths(carved.mesh(), sheets);
  result.body.overshooting = static_cast<std::int32_t>(overshooting.size());
  result.source_face = carved.source();
  return result;
}

}  // namespace fracbench::bem
