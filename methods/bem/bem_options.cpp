#include "methods/bem/bem_options.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "core/error.h"

namespace fracbench::bem {
namespace {

struct Range {
  const char* name;
  double value;
  double low, high;
  bool low_allowed;
  const char* unit;
};

}  // namespace

OptionsSchema options_schema() {
  return {
      {.name = "triangles",
       .fallback = std::int64_t{1500},
       .unit = "",
       .summary = "triangles of the boundary elements; pieces get a share by their area",
       .minimum = 64,
       .maximum = 20000},
      {.name = "voxel",
       .fallback = 0.01,
       .unit = "m",
       .summary = "size of the voxels that cracks cut apart, and of the crack front's markers",
       .minimum = 1e-4,
       .maximum = 1.0},
      {.name = "crack_mesh",
       .fallback = 0.1,
       .unit = "m",
       .summary = "edge length of the cracks' triangles; the time step is this over the Rayleigh "
                  "wave's speed",
       .minimum = 1e-3,
       .maximum = 1.0},
      {.name = "max_cracks",
       .fallback = std::int64_t{10},
       .unit = "",
       .summary = "at most so many cracks start in one break",
       .minimum = 0,
       .maximum = 1000},
      {.name = "mode",
       .fallback = std::string("fast"),
       .unit = "",
       .summary = "fast: one elastic solve; full: the cracks' openings are solved for in each step",
       .choices = {"fast", "full"}},
      {.name = "k_factor",
       .fallback = std::string("authors"),
       .unit = "",
       .summary =
           "factor of the stress intensity in fast mode: the authors' 1.1215, or exact for a "
           "penny-shaped crack",
       .choices = {"authors", "calibrated"}},
      {.name = "balance",
       .fallback = std::string("min-norm"),
       .unit = "",
       .summary = "what balances the impact: the least correction of the tractions, or the body's "
                  "inertia",
       .choices = {"min-norm", "inertia-relief"}},
      {.name = "strength_field",
       .fallback = std::string("homogeneous"),
       .unit = "",
       .summary = "strength of the material by place; its mean is the material's strength",
       .choices = {"homogeneous", "random", "layered", "grain"}},
      {.name = "weibull_modulus",
       .fallback = 10.0,
       .unit = "",
       .summary = "shape of the strength's Weibull distribution (strength_field random)",
       .minimum = 1.0,
       .maximum = 1000.0},
      {.name = "correlation_length",
       .fallback = 0.2,
       .unit = "m",
       .summary = "length over which the strength changes (strength_field random)",
       .minimum = 1e-3,
       .maximum = 100.0},
      {.name = "layer_normal",
       .fallback = std::vector<double>{0, 0, 1},
       .unit = "",
       .summary = "direction across the layers (strength_field layered)"},
      {.name = "layer_thickness",
       .fallback = 0.1,
       .unit = "m",
       .summary = "of one layer (strength_field layered)",
       .minimum = 1e-3,
       .maximum = 100.0},
      {.name = "grain_size",
       .fallback = 0.3,
       .unit = "m",
       .summary = "mean distance of neighbouring grains (strength_field grain)",
       .minimum = 1e-2,
       .maximum = 100.0},
      {.name = "grain_boundary",
       .fallback = 0.05,
       .unit = "m",
       .summary = "width of the weak boundaries (strength_field grain)",
       .minimum = 1e-4,
       .maximum = 10.0},
      {.name = "weak_ratio",
       .fallback = 0.5,
       .unit = "",
       .summary = "strength of weak layers and boundaries over the material's (strength_field "
                  "layered and grain)",
       .minimum = 1e-3,
       .maximum = 1.0},
      {.name = "smallest_fragment",
       .fallback = 1e-6,
       .unit = "of the body's volume",
       .summary = "smaller parts join the neighbour with the largest shared crack",
       .minimum = 0,
       .maximum = 0.5},
      {.name = "smallest_voxels",
       .fallback = 30.0,
       .unit = "voxels",
       .summary = "smaller parts join likewise: the grid does not resolve them",
       .minimum = 0,
       .maximum = 1e6},
      {.name = "refracture_volume",
       .fallback = 0.02,
       .unit = "of the target's volume",
       .summary = "larger pieces may break again; 1: none",
       .minimum = 0,
       .maximum = 1},
      {.name = "hull_volume",
       .fallback = 0.005,
       .unit = "of the target's volume",
       .summary = "smaller pieces become convex hulls (parity only)",
       .minimum = 0,
       .maximum = 1},
      {.name = "parity",
       .fallback = false,
       .unit = "",
       .summary = "as the authors' program: re-meshed surfaces, hulls for small pieces, cracks "
                  "start under compression too"},
  };
}

Settings settings_from(const Options& options) {
  Settings s;
  s.triangles = static_cast<int>(options.integer("triangles"));
  s.voxel = options.number("voxel");
  s.crack_mesh = options.number("crack_mesh");
  s.max_cracks = static_cast<int>(options.integer("max_cracks"));
  s.mode = options.text("mode") == "full" ? Mode::full : Mode::fast;
  s.calibrated = options.text("k_factor") == "calibrated";
  s.balance = load_balance(options.text("balance"));
  s.strength.kind = strength_kind(options.text("strength_field"));
  s.strength.weibull_modulus = options.number("weibull_modulus");
  s.strength.correlation_length = options.number("correlation_length");
  const std::vector<double>& normal = options.numbers("layer_normal");
  if (normal.size() != 3 || !(std::hypot(normal[0], normal[1], normal[2]) > 0)) {
    throw InputError("bem: option 'layer_normal' must be three numbers, not all 0");
  }
  s.strength.direction = Vec3(normal[0], normal[1], normal[2]);
  s.strength.thickness = options.number("layer_thickness");
  s.strength.grain_size = options.number("grain_size");
  s.strength.boundary_width = options.number("grain_boundary");
  s.strength.ratio = options.number("weak_ratio");
  s.parity = options.flag("parity");
  s.smallest_fragment = options.number("smallest_fragment");
  s.smallest_voxels = options.number("smallest_voxels");
  s.hull_volume = options.number("hull_volume");
  s.refracture_volume = options.number("refracture_volume");
  if (s.crack_mesh < s.voxel) {
    throw InputError(fmt::format(
        "bem: option 'crack_mesh' is {} m, finer than the voxels of {} m; give at least {} m, or a "
        "smaller 'voxel'",
        s.crack_mesh, s.voxel, s.voxel));
  }
  if (s.mode == Mode::full && s.balance == LoadBalance::inertia_relief) {
    throw InputError(
        "bem: option 'balance' inertia-relief is for mode fast: the body force does not reach the "
        "cracks that mode full solves for; use min-norm");
  }
  return s;
}

void check_material(const Material& material) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const Range& r : std::initializer_list<Range>{
           {"Young's modulus", material.young_modulus, 0, infinite, false, " Pa"},
           {"Poisson's ratio", material.poisson_ratio, 0, 0.5, true, ""},
           {"density", material.density, 0, infinite, false, " kg/m^3"},
           {"strength", material.strength, 0, infinite, false, " Pa"},
           {"toughness", material.toughness, 0, infinite, false, " Pa sqrt(m)"},
           {"compressive factor", material.compressive_factor, 1, infinite, true, ""}}) {
    if ((r.low_allowed ? r.value >= r.low : r.value > r.low) && r.value < r.high) continue;
    throw InputError(fmt::format(
        "bem: the material's {} is {}{}; it must be {} {}{}{}", r.name, r.value, r.unit,
        r.low_allowed ? "at least" : "above", r.low, r.unit,
        std::isfinite(r.high) ? fmt::format(" and below {}", r.high) : std::string(" and finite")));
  }
}

}  // namespace fracbench::bem
