#include "methods/bem/validation/behaviour_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>

#include "core/adjusted_rand_index.h"
#include "geometry/measures.h"
#include "methods/bem/validation/breakage.h"

namespace fracbench::bem {

namespace {

// Speeds of the ball, m/s. Glass of this size starts to break between the first two.
constexpr double kWeak = 25;
constexpr double kStrong = 100;

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Standard error of the mean.
double standard_error(std::span<const double> values) {
  const double m = mean(values);
  double sum = 0;
  for (const double v : values) sum += (v - m) * (v - m);
  const auto n = static_cast<double>(values.size());
  return std::sqrt(sum / (n * (n - 1)));
}

/// Mean over the fragments of the logarithm of their relative volume.
double mean_log_volume(std::span<const Piece> pieces) {
  double sum = 0;
  for (const double v : relative_volumes(pieces)) sum += std::log10(v);
  return sum / static_cast<double>(pieces.size());
}

double count(std::span<const Piece> pieces) { return static_cast<double>(pieces.size()); }

// Cracks in glass are limited by its toughness, not by their number.
Breakage glass() { return {.material = kGlass, .options = {{"max_cracks", std::int64_t{60}}}}; }

std::vector<Accuracy> nothing_below_the_threshold(Context& context) {
  double most = 0;
  for (const Hit& hit : test_hits()) {
    most = std::max(most, count(glass().pieces(hit, 0.1, context)));
  }
  return {{.name = "glass, ball at 0.1 m/s: most fragments of any impact",
           .reference = "stress below the strength everywhere",
           .expected = 1,
           .computed = most}};
}

std::vector<Accuracy> stronger_impacts(Context& context) {
  double more = 0, smaller = 0, all = 0;
  for (const Hit& hit : test_hits()) {
    const auto weak = glass().pieces(hit, kWeak, context);
    const auto strong = glass().pieces(hit, kStrong, context);
    more += strong.size() > weak.size() ? 1 : 0;
    smaller += relative_volumes(strong).front() < relative_volumes(weak).front() ? 1 : 0;
    ++all;
  }
  const std::string speeds = fmt::format("glass, ball at {} against {} m/s", kStrong, kWeak);
  return {{.name = speeds + ": share of impacts with more fragments",
           .reference = "more fragments from stronger impacts",
           .expected = 1,
           .computed = more / all,
           .tolerance = 0.2},
          {.name = speeds + ": share of impacts whose largest fragment is smaller",
           .reference = "smaller fragments from stronger impacts",
           .expected = 1,
           .computed = smaller / all,
           .tolerance = 0.2}};
}

// The published material has a toughness that never binds: what limits the number is max_cracks.
std::vector<Accuracy> number_of_cracks_binds(Context& context) {
  const auto mean_count = [&](int max_cracks, double speed) {
    std::vector<double> counts;
    for (const Hit& hit : test_hits()) {
      const Breakage paper{.options = {{"max_cracks", std::int64_t{max_cracks}}}};
      counts.push_back(count(paper.pieces(hit, speed, context)));
    }
    return mean(counts);
  };
  const double few = mean_count(3, kStrong);
  const double many = mean_count(10, kStrong);
  const double weaker = mean_count(10, kStrong / 2);
  return {{.name = "paper's material: mean count with 3 cracks over that with 10",
           .reference = "the count follows max_cracks",
           .expected = 0.3,
           .computed = few / many,
           .tolerance = 1},  // at most 0.6: fronts that meet make the count grow faster
          {.name = "paper's material: mean count at half the speed over that at full speed",
           .reference = "the count does not follow the impulse",
           .expected = 1,
           .computed = weaker / many,
           .tolerance = 0.45}};  // half the impulse, yet clearly more than half the fragments
}

/// Mean log10 of the volume of the fragments in the farther half, less that of the nearer half, by
/// their centres' distance from the impact; nothing for less than four fragments.
std::optional<double> size_gradient(std::span<const Piece> pieces, const Hit& hit) {
  if (pieces.size() < 4) return std::nullopt;
  std::vector<std::pair<double, double>> by_distance;
  for (const Piece& piece : pieces) {
    const MassProperties mass = mass_properties(piece.mesh);
    by_distance.emplace_back((mass.center - hit.point).norm(), std::log10(mass.volume));
  }
  std::sort(by_distance.begin(), by_distance.end());
  const std::size_t half = by_distance.size() / 2;
  double gradient = 0;
  for (std::size_t n = 0; n < half; ++n) {
    gradient += by_distance[by_distance.size() - 1 - n].second - by_distance[n].second;
  }
  return gradient / static_cast<double>(half);
}

// One impact tells little: its largest fragment is often at the far side of the first crack, just
// as often beside the impact. So the mean over many impacts is judged by its own standard error.
std::vector<Accuracy> finer_near_the_impact(Context& context) {
  std::vector<double> gradients;
  const auto add = [&](const Breakage& breakage, double speed) {
    for (const Hit& hit : test_hits()) {
      if (const auto g = size_gradient(breakage.pieces(hit, speed, context), hit)) {
        gradients.push_back(*g);
      }
    }
  };
  for (const double speed : {100.0, 150.0, 200.0}) add(glass(), speed);
  for (const double speed : {50.0, 75.0, 100.0}) add(Breakage{}, speed);
  return {{.name = "far less near fragments' mean log10 volume, over its standard error",
           .reference = "fragments are smaller near the impact: at least 2",
           .expected = 6,
           .computed = mean(gradients) / standard_error(gradients),
           .tolerance = 2.0 / 3}};
}

/// Counts and sizes of two settings over the same impacts and seeds of a random strength, each
/// against the spread between seeds.
std::vector<Accuracy> within_the_spread(const std::string& what, const OptionMap& finer,
                                        Context& context) {
  std::vector<double> counts[2], sizes[2];
  const OptionMap random_strength = {{"strength_field", std::string("random")},
                                     {"max_cracks", std::int64_t{10}}};
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    for (const Hit& hit : test_hits()) {
      for (const int setting : {0, 1}) {
        Breakage breakage{.options = random_strength, .seed = seed};
        if (setting == 1) {
          for (const auto& [name, value] : finer) breakage.options[name] = value;
        }
        const auto pieces = breakage.pieces(hit, kStrong, context);
        counts[setting].push_back(count(pieces));
        sizes[setting].push_back(mean_log_volume(pieces));
      }
    }
  }
  const auto row = [&](const std::string& name, const std::vector<double>* values) {
    const double spread = 2 * std::hypot(standard_error(values[0]), standard_error(values[1]));
    return Accuracy{.name = what + ": " + name,
                    .reference = "within two standard errors of the spread between seeds",
                    .expected = mean(values[0]),
                    .computed = mean(values[1]),
                    .tolerance = spread / std::abs(mean(values[0]))};
  };
  return {row("mean count", counts), row("mean log10 of the relative volume", sizes)};
}

// Body and blow turned together, while the grid and the way of remeshing stay as they are. Where a
// crack starts and which way it turns is decided by small differences, so that any other grid gives
// other fragments: a turned body must agree with the upright one as well as one on a grid that is
// 2 % finer does.
std::vector<Accuracy> orientation(Context& context) {
  const std::vector<Hit> hits = test_hits();
  const auto labels_of = [&](const Hit& hit, const Mat3& turn, double voxel) {
    Breakage breakage{.options = {{"voxel", voxel}}};
    for (Vec3& v : breakage.body.vertices) v = turn * v;
    if (turn.determinant() < 0) {
      for (Face& face : breakage.body.faces) std::swap(face[1], face[2]);
    }
    const Hit turned{turn * hit.point, turn * hit.direction};
    return piece_labels(breakage.pieces(turned, kStrong, context), turn, context.threads);
  };
  constexpr double kVoxel = 0.04;
  std::vector<std::vector<std::int32_t>> upright;
  for (const Hit& hit : hits) upright.push_back(labels_of(hit, Mat3::Identity(), kVoxel));
  const auto agreement = [&](const Mat3& turn, double voxel) {
    std::vector<double> indices;
    for (std::size_t n = 0; n < hits.size(); ++n) {
      indices.push_back(adjusted_rand_index(upright[n], labels_of(hits[n], turn, voxel)));
    }
    return mean(indices);
  };
  const double other_grid = agreement(Mat3::Identity(), 0.98 * kVoxel);
  const auto row = [&](const std::string& name, const Mat3& turn) {
    return Accuracy{.name = name + ": mean adjusted Rand index of the fragments",
                    .reference = "the same of the upright body on a grid that is 2 % finer",
                    .expected = other_grid,
                    .computed = agreement(turn, kVoxel),
                    .tolerance = 0.6};
  };
  const Mat3 quarter = Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()).toRotationMatrix();
  const Mat3 oblique = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mat3 mirror = Vec3(-1, 1, 1).asDiagonal();
  return {row("turned by 90 degrees", quarter), row("turned by 40 degrees", oblique),
          row("mirrored", mirror)};
}

}  // namespace

std::vector<ValidationCase> behaviour_cases() {
  return {
      {.name = "below-threshold",
       .summary = "no break where the strength is nowhere exceeded",
       .seconds = 3,
       .run = nothing_below_the_threshold},
      {.name = "stronger-impacts",
       .summary = "glass: more and smaller fragments from a stronger impulse",
       .seconds = 20,
       .run = stronger_impacts},
      {.name = "number-of-cracks",
       .summary = "the paper's material: the number of fragments follows max_cracks",
       .seconds = 20,
       .run = number_of_cracks_binds},
      {.name = "near-and-far",
       .summary = "fragments are smaller near the impact, in glass and in the paper's material",
       .seconds = 15,
       .run = finer_near_the_impact},
      {.name = "half-voxel",
       .summary = "half the voxel size: same count and sizes, within the spread between seeds",
       .seconds = 60,
       .run =
           [](Context& context) {
             return within_the_spread("voxel 0.02 against 0.04 m", {{"voxel", 0.02}}, context);
           }},
      {.name = "half-triangles",
       .summary = "four times the triangles: same count and sizes, within the spread",
       .seconds = 60,
       .run =
           [](Context& context) {
             return within_the_spread("1600 triangles against 400",
                                      {{"triangles", std::int64_t{1600}}}, context);
           }},
      {.name = "orientation",
       .summary = "turned and mirrored bodies break into turned and mirrored fragments",
       .seconds = 20,
       .run = orientation},
  };
}

}  // namespace fracbench::bem
