#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/fragments.h"
#include "metrics/metric.h"

namespace fracbench {

/// How deep two fragments may reach into each other, over the body's longest side.
inline constexpr double kOverlapTolerance = 1e-6;

/// What is wrong with one fragment.
struct FragmentValidity {
  bool well_formed = false;  ///< finite vertices, indices in range, a tag for each face
  bool closed = false;       ///< every edge has two faces
  bool oriented = false;     ///< neighbours agree, outside is outside, positive volume
  bool manifold = false;     ///< no vertex joins two fans of faces
  bool simple = false;       ///< free of self-intersections
  double volume = 0;         ///< m^3, signed

  /// A solid. Not asked of it: that it is manifold in the vertices, since a solid may touch itself
  /// in a point.
  bool valid() const { return well_formed && closed && oriented && simple; }
};

struct ValidityReport {
  std::vector<FragmentValidity> fragments;  ///< in their order
  std::vector<std::string> findings;        ///< what is wrong, with the numbers of fragments
  bool disjoint = true;                     ///< no two closed fragments overlap
  double volume_ratio = 0;                  ///< sum of volumes over the body's

  /// There are fragments, all of them are solids, and no two overlap. The volume is left to the
  /// caller, since methods differ in what they promise.
  bool valid() const;
  /// The findings, one per line; "valid" where there is none.
  std::string describe() const;
};

/// Whether the fragments are solids that do not overlap, and what they sum up to.
ValidityReport check_fragments(const TriangleMesh& body, const Fragments& fragments,
                               int threads = 1);

/// The report in numbers: `closed`, `oriented`, `manifold`, `self_intersection_free`, `disjoint`
/// and `valid` are 1 where they hold for all fragments, else 0; `invalid_fragments` counts those
/// that are not solids; volume_ratio = sum V_i / V_body over the fragments that are well formed,
/// with signs, as a compensated sum. It is not part of `valid`: compare it with the tolerance that
/// the method declares. Series `fragment_valid`: 1 or 0 for each fragment.
class Validity final : public Metric {
 public:
  MetricInfo info() const override;
  Measurement measure(const CellResult& cell) const override;
};

}  // namespace fracbench
