#include "harness/conformance/sound_fragments.h"

#include <fmt/format.h>

#include <cmath>

#include "core/error.h"
#include "metrics/surface_retention.h"
#include "metrics/validity.h"
#include "scenarios/fragments_of_pieces.h"

namespace fracbench::conformance {

namespace {

ValidityReport report_of(const Bench& bench, const std::vector<Piece>& pieces) {
  const TriangleMesh& mesh = bench.subject().target.mesh;
  return check_fragments(mesh, fragments_of(mesh, pieces));
}

}  // namespace

CheckResult check_tags(const Bench& bench) {
  const std::vector<Piece> pieces = bench.broken();
  const auto faces = static_cast<std::int32_t>(bench.subject().target.mesh.faces.size());
  const auto count = static_cast<std::int32_t>(pieces.size());
  for (std::int32_t p = 0; p < count; ++p) {
    const Piece& piece = pieces[static_cast<std::size_t>(p)];
    if (piece.faces.size() != piece.mesh.faces.size()) {
      return failed(fmt::format("piece {}: {} tags for {} faces", p, piece.faces.size(),
                                piece.mesh.faces.size()));
    }
    for (const PieceFace& tag : piece.faces) {
      if (tag.parent_face >= faces || tag.parent_face < -1 || tag.neighbour >= count ||
          tag.neighbour < -1 || tag.neighbour == p) {
        return failed(
            fmt::format("piece {}: parent face {} and neighbour {} of {} faces and {} "
                        "pieces",
                        p, tag.parent_face, tag.neighbour, faces, count));
      }
    }
    for (const Vec3& v : piece.mesh.vertices) {
      if (!v.allFinite()) return failed(fmt::format("piece {}: a vertex is no number", p));
    }
  }
  return pieces.empty() ? failed("no piece at all; a body that stays whole is one")
                        : passed(fmt::format("{} pieces", count));
}

CheckResult check_closed(const Bench& bench) {
  const std::vector<Piece> pieces = bench.broken();
  const ValidityReport report = report_of(bench, pieces);
  for (std::size_t n = 0; n < report.fragments.size(); ++n) {
    const FragmentValidity& f = report.fragments[n];
    if (f.valid()) continue;
    return failed(fmt::format("fragment {} is {}", n,
                              !f.well_formed ? "no mesh"
                              : !f.closed    ? "open"
                              : !f.oriented  ? "turned inside out in part"
                                             : "meeting itself"));
  }
  return pieces.empty() ? failed("there is no fragment") : passed();
}

CheckResult check_disjoint(const Bench& bench) {
  const ValidityReport report = report_of(bench, bench.broken());
  return report.disjoint ? passed() : failed(report.describe());
}

CheckResult check_volume(const Bench& bench) {
  const double ratio = report_of(bench, bench.broken()).volume_ratio;
  const double tolerance = bench.subject().method.info().volume_tolerance;
  const std::string text = fmt::format("|{:.10g} - 1|, allowed {:g}", ratio, tolerance);
  return std::abs(ratio - 1) <= tolerance ? passed(text) : failed(text);
}

CheckResult check_surface(const Bench& bench) {
  if (!bench.subject().method.info().retains_surface) {
    return skipped("the method does not say that it keeps the surface");
  }
  const TriangleMesh& mesh = bench.subject().target.mesh;
  const Fragments fragments = fragments_of(mesh, bench.broken());
  const Measurement measured = SurfaceRetention().measure(
      {.body = mesh, .fragments = fragments, .impacts = {}, .stages = {}});
  for (const MetricValue& value : measured.values) {
    if (value.name != "surface_retention") continue;
    constexpr double enough = 0.999;
    const std::string text = fmt::format("{:.6g} of the area, wanted {:g}", value.value, enough);
    return value.value >= enough ? passed(text) : failed(text);
  }
  return failed("it cannot be measured");
}

CheckResult check_weak_blow(const Bench& bench) {
  const auto body = bench.prepare();
  try {
    const std::vector<Piece> pieces = bench.blow(*body, bench.impact(0, 1e-9));
    if (pieces.empty()) return failed("no piece at all; a body that stays whole is one");
    return report_of(bench, pieces).valid() ? passed(fmt::format("{} piece(s)", pieces.size()))
                                            : failed("the pieces are not valid");
  } catch (const MethodFailure& failure) {
    return passed(fmt::format("refused: {}", failure.what()));
  }
}

}  // namespace fracbench::conformance
