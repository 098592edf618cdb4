#include "metrics/validity.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/parallel.h"
#include "core/sum.h"
#include "geometry/check_mesh.h"
#include "geometry/measures.h"
#include "geometry/overlap.h"
#include "metrics/measurement.h"

namespace fracbench {
namespace {

FragmentValidity check_fragment(const Fragment& fragment) {
  FragmentValidity result{.well_formed = is_well_formed(fragment) && !fragment.mesh.empty()};
  if (!result.well_formed) return result;
  const MeshReport report = check_mesh(fragment.mesh, {.threads = 1});
  result.closed = report.closed;
  result.oriented = report.oriented && report.volume > 0;
  result.manifold = report.manifold;
  result.simple = !report.self_intersecting;
  result.volume = volume(fragment.mesh);
  return result;
}

void find_faults(ValidityReport& report) {
  const auto list = [&](std::string_view what, const auto& holds) {
    std::vector<std::size_t> which;
    for (std::size_t i = 0; i < report.fragments.size(); ++i) {
      if (!holds(report.fragments[i])) which.push_back(i);
    }
    if (which.empty()) return;
    constexpr std::size_t most = 10;
    std::string numbers;
    for (std::size_t k = 0; k < std::min(most, which.size()); ++k) {
      numbers += fmt::format("{}{}", k == 0 ? "" : ", ", which[k]);
    }
    report.findings.push_back(fmt::format("{} fragment{} {}: {}{}", which.size(),
                                          which.size() == 1 ? "" : "s", what, numbers,
                                          which.size() > most ? ", ..." : ""));
  };
  using Checked = FragmentValidity;
  list("not a mesh (no faces, index out of range, not finite, or without tags)",
       [](const Checked& f) { return f.well_formed; });
  list("not closed", [](const Checked& f) { return !f.well_formed || f.closed; });
  list("not oriented outwards", [](const Checked& f) { return !f.well_formed || f.oriented; });
  list("self-intersecting", [](const Checked& f) { return !f.well_formed || f.simple; });
}

void find_overlapping(const TriangleMesh& body, const Fragments& fragments, int threads,
                      ValidityReport& report) {
  std::vector<std::reference_wrapper<const TriangleMesh>> solids;
  std::vector<std::size_t> number;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    // What is not closed has no inside.
    if (!report.fragments[i].closed) continue;
    solids.emplace_back(fragments[i].mesh);
    number.push_back(i);
  }
  const double tolerance = kOverlapTolerance * bounding_box(body).longest_side();
  for (const Overlap& overlap :
       find_overlaps(solids, {.tolerance = tolerance, .threads = threads})) {
    report.disjoint = false;
    report.findings.push_back(
        fmt::format("fragments {} and {} overlap, by {:.3g} m at ({:.6g}, {:.6g}, {:.6g})",
                    number[overlap.first], number[overlap.second], overlap.depth, overlap.place.x(),
                    overlap.place.y(), overlap.place.z()));
  }
}

}  // namespace

bool ValidityReport::valid() const {
  return !fragments.empty() && disjoint &&
         std::ranges::all_of(fragments, [](const FragmentValidity& f) { return f.valid(); });
}

std::string ValidityReport::describe() const {
  return findings.empty() ? "valid" : fmt::format("{}", fmt::join(findings, "\n"));
}

ValidityReport check_fragments(const TriangleMesh& body, const Fragments& fragments, int threads) {
  ValidityReport report;
  report.fragments.resize(fragments.size());
  parallel_for(fragments.size(), threads,
               [&](std::size_t i) { report.fragments[i] = check_fragment(fragments[i]); });
  Sum sum;
  for (const FragmentValidity& fragment : report.fragments) sum += fragment.volume;
  report.volume_ratio = sum.value() / volume(body);
  if (fragments.empty()) report.findings.emplace_back("no fragments");
  find_faults(report);
  find_overlapping(body, fragments, threads, report);
  return report;
}

MetricInfo Validity::info() const {
  return {.name = "validity",
          .summary = "whether fragments are disjoint solids, and their volume over the body's"};
}

Measurement Validity::measure(const CellResult& cell) const {
  const ValidityReport report = check_fragments(cell.body, cell.fragments, cell.threads);
  const auto all = [&](bool FragmentValidity::*member) {
    return std::ranges::all_of(report.fragments, member) ? 1.0 : 0.0;
  };
  Measurement result;
  add_value(result, "valid", report.valid() ? 1 : 0);
  add_value(result, "closed", all(&FragmentValidity::closed));
  add_value(result, "oriented", all(&FragmentValidity::oriented));
  add_value(result, "manifold", all(&FragmentValidity::manifold));
  add_value(result, "self_intersection_free", all(&FragmentValidity::simple));
  add_value(result, "disjoint", report.disjoint ? 1 : 0);
  add_value(result, "volume_ratio", report.volume_ratio);
  MetricSeries series{.name = "fragment_valid", .values = {}, .unit = ""};
  for (const FragmentValidity& f : report.fragments) series.values.push_back(f.valid() ? 1 : 0);
  add_value(result, "invalid_fragments",
            static_cast<double>(std::ranges::count(series.values, 0.0)));
  result.series.push_back(std::move(series));
  return result;
}

}  // namespace fracbench
