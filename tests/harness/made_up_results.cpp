#include "tests/harness/made_up_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace fracbench {

namespace {

/// Volumes that add up to 10: powers of uniform numbers, the more uneven the larger the exponent.
std::vector<double> volumes(int count, double exponent, Random& random) {
  std::vector<double> list;
  double total = 0;
  for (int i = 0; i < count; ++i) {
    list.push_back(std::pow(random.uniform(), exponent));
    total += list.back();
  }
  for (double& volume : list) volume *= 10 / total;
  return list;
}

CellSummary make_cell(const MadeUpResults& law, std::size_t collision, int repeat) {
  const std::string name = fmt::format("{:04}", collision);
  Random impact(derive_seed(99, {name}));
  Random method(derive_seed(law.seed, {name, std::to_string(repeat)}));
  Random clock(derive_seed(law.rerun, {name, std::to_string(repeat)}));
  const double size =
      std::exp(law.count_between * impact.normal() + law.count_within * method.normal()) *
      law.count * law.count_shift;
  const double exponent = std::exp(law.slope_between * impact.normal() +
                                   law.slope_within * method.normal() + law.volume_shift);
  const int count = std::max(2, static_cast<int>(std::lround(size)));

  CellSummary cell;
  cell.key = fmt::format("{}-{}-{}", name, repeat, law.seed);
  cell.method = cell.label = "cvd";
  cell.shape = collision % 2 == 0 ? "pot" : "bunny";
  cell.family = "single";
  cell.scenario = name;
  cell.repeat = repeat;
  cell.cpu = law.cpu;
  cell.impulses = {1e5 * (1 + impact.uniform())};
  cell.values = {{"fragment_count", static_cast<double>(count), ""},
                 {"normal_along", 0.5 + 0.05 * impact.normal() + 0.02 * method.normal(), ""},
                 {"roughness", 10 + impact.normal() + 0.5 * method.normal(), "degree"},
                 {"volume_ratio", 1 + 1e-13 * method.normal(), ""}};
  cell.series = {{"fragment_volume", volumes(count, exponent, method), "V_body / 10"}};
  const double cut = 0.2 * law.time_shift * std::exp(law.time_noise * clock.normal());
  cell.stages = {{"cut", cut}, {"other", 1e-5}};
  cell.total_seconds = cut + 1e-5;
  return cell;
}

}  // namespace

Results MadeUpResults::make() const {
  Results results;
  results.suite.name = "made up";
  results.suite.values = {{"name", "made up"}, {"seed", 1}};
  results.suite.cells = collisions * static_cast<std::size_t>(repeats);
  for (std::size_t collision = 0; collision < collisions; ++collision) {
    for (int repeat = 0; repeat < repeats; ++repeat) {
      results.cells.push_back(make_cell(*this, collision, repeat));
    }
  }
  return results;
}

}  // namespace fracbench
