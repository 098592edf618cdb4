#include "methods/cvd/cvd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/cvd/cut_by_cells.h"
#include "methods/cvd/interior_samples.h"
#include "methods/cvd/pieces.h"
#include "methods/cvd/predicates.h"
#include "methods/cvd/sites.h"

namespace fracbench {

namespace {

using cvd::Degenerate;

// Samples of the body that carry the density: enough for smooth centres of mass.
constexpr std::size_t kSamples = 20000;
constexpr std::size_t kSamplesPerSite = 200;

// Where sites lie in a special position (a bisector through a vertex of the body, five sites on a
// sphere), each is moved by up to this share of the body's size, ten times farther at each attempt.
constexpr double kFirstShift = 1e-9;
constexpr int kAttempts = 7;

// Limits for sites by hand, as shares of the body's longest side.
constexpr double kNearestSites = 1e-5;
constexpr double kFarthestSite = 100;

struct Settings {
  std::size_t sites = 0;
  std::vector<Vec3> sites_at;
  double falloff = 0;
  int lloyd_iterations = 0;
  double minimum_volume = 0;

  explicit Settings(const Options& options)
      : sites(static_cast<std::size_t>(options.integer("sites"))),
        falloff(options.number("falloff")),
        lloyd_iterations(static_cast<int>(options.integer("lloyd_iterations"))),
        minimum_volume(options.number("minimum_volume")) {
    const std::vector<double>& numbers = options.numbers("sites_at");
    if (numbers.size() % 3 != 0) {
      throw InputError(
          fmt::format("cvd: option 'sites_at' has {} numbers, must have three (x, y, z) for each "
                      "site",
                      numbers.size()));
    }
    for (std::size_t n = 0; n < numbers.size(); n += 3) {
      sites_at.emplace_back(numbers[n], numbers[n + 1], numbers[n + 2]);
    }
  }
};

void check_sites(const std::vector<Vec3>& sites, const BoundingBox& box) {
  const double size = box.longest_side();
  for (std::size_t a = 0; a < sites.size(); ++a) {
    const Vec3& p = sites[a];
    if ((p - box.center()).norm() > kFarthestSite * size) {
      throw InputError(fmt::format(
          "cvd: option 'sites_at': site {} at ({}, {}, {}) m is farther than {} m from the body",
          a + 1, p[0], p[1], p[2], kFarthestSite * size));
    }
    for (std::size_t b = a + 1; b < sites.size(); ++b) {
      if ((p - sites[b]).norm() < kNearestSites * size) {
        throw InputError(fmt::format(
            "cvd: option 'sites_at': sites {} and {} are nearer than {} m at ({}, {}, {}) m; "
            "remove one of them",
            a + 1, b + 1, kNearestSites * size, p[0], p[1], p[2]));
      }
    }
  }
}

class CvdBody : public Breakable {
 public:
  CvdBody(const Target& target, const Options& options)
      : settings_(options), topology_(cvd::surface_topology(target.mesh)) {
    check_sites(settings_.sites_at, topology_.box);
    if (settings_.sites_at.empty()) {
      samples_ = cvd::interior_samples(
          topology_, std::max(kSamples, kSamplesPerSite * settings_.sites), settings_.sites);
    }
  }

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    const std::vector<Vec3> sites = choose_sites(impact, context);
    std::string reason;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      context.stop_if_asked();
      try {
        return break_at(shifted(sites, attempt), context);
      } catch (const Degenerate& degenerate) {
        reason = degenerate.what();
      }
    }
    throw MethodFailure(fmt::format("cvd: no consistent cut after {} attempts with moved sites: {}",
                                    kAttempts, reason));
  }

  // Everything follows quickly from the target and the options: nothing is stored.
  void save(const std::filesystem::path&) const override {}

 private:
  std::vector<Vec3> choose_sites(const Impact& impact, Context& context) const {
    if (!settings_.sites_at.empty()) return settings_.sites_at;
    const auto stage = context.timer.stage("sites");
    const bool directed = !impact.impulses.empty();
    const cvd::WeightedSamples density =
        cvd::density(samples_, directed ? impact.impulses.front().point : Vec3::Zero(),
                     directed ? settings_.falloff : 0);
    return cvd::lloyd(density, cvd::draw_sites(density, settings_.sites, context.random),
                      settings_.lloyd_iterations, context.threads)
        .sites;
  }

  std::vector<Vec3> shifted(std::vector<Vec3> sites, int attempt) const {
    if (attempt == 0) return sites;
    const double shift = kFirstShift * std::pow(10.0, attempt - 1) * topology_.box.longest_side();
    Random random(static_cast<std::uint64_t>(attempt));
    for (Vec3& site : sites) {
      for (int c = 0; c < 3; ++c) site[c] += random.uniform(-shift, shift);
    }
    return sites;
  }

  std::vector<Piece> break_at(const std::vector<Vec3>& sites, Context& context) const {
    cvd::VoronoiCells cells;
    cvd::CellComplex complex;
    cvd::CellParts parts;
    {
      const auto stage = context.timer.stage("cells");
      cells = cvd::voronoi_cells(sites, topology_.box);
    }
    context.stop_if_asked();
    {
      const auto stage = context.timer.stage("cut");
      complex = cvd::cut_by_cells(topology_, cells, context.threads);
    }
    context.stop_if_asked();
    {
      const auto stage = context.timer.stage("components");
      parts = cvd::connected_parts(complex, topology_.volume);
    }
    const auto stage = context.timer.stage("merge");
    const std::vector<std::int32_t> piece_of_part =
        cvd::merge_small_parts(complex, parts, settings_.minimum_volume * topology_.volume);
    return cvd::build_pieces(complex, parts, piece_of_part);
  }

  Settings settings_;
  cvd::SurfaceTopology topology_;
  std::vector<Vec3> samples_;
};

}  // namespace

MethodInfo CvdMethod::info() const {
  MethodInfo info;
  info.name = "cvd";
  info.summary = "centroidal Voronoi cells around the impact, cut exactly by the body's mesh";
  info.publications = {{.key = "du1999",
                        .authors = "Qiang Du and Vance Faber and Max Gunzburger",
                        .title = "Centroidal Voronoi tessellations: applications and algorithms",
                        .journal = "SIAM Review",
                        .volume = "41",
                        .number = "4",
                        .year = 1999,
                        .doi = "10.1137/S0036144599352836"},
                       {.key = "rycroft2009",
                        .authors = "Chris H. Rycroft",
                        .title = "VORO++: A three-dimensional Voronoi cell library in C++",
                        .journal = "Chaos",
                        .volume = "19",
                        .year = 2009,
                        .doi = "10.1063/1.3215722"}};
  info.shape_type = "Voronoi";
  info.random = true;
  info.quick_to_prepare = true;
  return info;
}

OptionsSchema CvdMethod::options() const {
  return {
      {.name = "sites",
       .fallback = std::int64_t{20},
       .unit = "",
       .summary = "number of Voronoi sites; unused where sites_at is given",
       .minimum = 1,
       .maximum = 10000},
      {.name = "sites_at",
       .fallback = std::vector<double>{},
       .unit = "m",
       .summary = "sites by hand, x, y, z of each in the body's frame; used as they are"},
      {.name = "falloff",
       .fallback = 0.5,
       .unit = "m",
       .summary = "length over which the sites' density falls by e away from the strongest "
                  "impulse; 0: uniform",
       .minimum = 0},
      {.name = "lloyd_iterations",
       .fallback = std::int64_t{10},
       .unit = "",
       .summary = "steps that move sampled sites to the centres of mass of their cells",
       .minimum = 0,
       .maximum = 1000},
      {.name = "minimum_volume",
       .fallback = 1e-4,
       .unit = "of the body's volume",
       .summary = "smaller pieces join the neighbour with the largest shared face",
       .minimum = 0,
       .maximum = 0.5},
  };
}

std::unique_ptr<Breakable> CvdMethod::prepare(const Target& target, const LearningData&,
                                              const Options& options, Context& context) const {
  const auto stage = context.timer.stage("sites");
  return std::make_unique<CvdBody>(target, options);
}

std::unique_ptr<Breakable> CvdMethod::load(const std::filesystem::path&, const Target& target,
                                           const Options& options) const {
  return std::make_unique<CvdBody>(target, options);
}

}  // namespace fracbench
