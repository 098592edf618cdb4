#pragma once

#include <array>
#include <span>
#include <vector>

#include "methods/bem/boundary_elements.h"
#include "methods/bem/pair_kernel.h"

namespace fracbench::bem {

/// The double integrals over a pair of flat triangles that every entry of the elastic boundary
/// operators is made of: with r = x - y, x on the test triangle and y on the trial triangle,
///   values[0..5]  integral of r r^T / |r|^3: xx, yy, zz, xy, xz, yz (m^3),
///   values[6..8]  integral of n_y . r / |r|^3 times the hat function of each corner of the trial
///                 triangle (m^2), the Laplace double layer; only where asked for.
/// The integral of 1/|r| is the trace of the first.
struct PairIntegrals {
  std::array<double, kPairComponents + kDoubleLayerComponents> values = {};

  double inverse_distance() const { return values[0] + values[1] + values[2]; }
};

/// Integrates one test triangle against many trial triangles, in batches. Pairs that share corners
/// (the same coordinates, whatever their indices) are integrated after removing the singularity;
/// others by rules whose points grow with nearness, triangles being cut in half where they are
/// too near. Relative errors, measured by the tests: 1e-5 of the integral of 1/|r| for triangles
/// of ordinary shape.
class PairIntegrator {
 public:
  explicit PairIntegrator(bool double_layer);

  /// results[k] belongs to trial triangle trial_indices[k]. One object serves one thread.
  void integrate(const BoundaryElements& test, std::size_t test_index,
                 const BoundaryElements& trial, std::span<const std::int32_t> trial_indices,
                 std::span<PairIntegrals> results);

  /// One pair of any two triangles.
  PairIntegrals integrate(const Corners& test, const Corners& trial);

 private:
  /// The pairs that wait for one rule.
  struct Queue {
    int points = 0;
    int filled = 0;
    PairBatch batch;
    std::array<double, kPairLanes> scales;                 ///< product of the areas
    std::array<std::array<double, 9>, kPairLanes> shapes;  ///< see Part::shape
    std::array<PairIntegrals*, kPairLanes> targets;
  };
  /// A triangle or a part of one that was cut.
  struct Part {
    Corners corners;
    Vec3 centroid;
    double radius = 0;
    double area = 0;
    int depth = 0;
    /// The whole triangle's hat functions (columns) at the part's corners (rows).
    std::array<double, 9> shape = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  };

  void add(const Part& test, const Part& trial, PairIntegrals& target);
  void flush(Queue& queue);
  void flush_all();
  /// Cut across its longest side.
  static std::array<Part, 2> halves(const Part& part);

  bool double_layer_;
  std::array<Queue, 3> queues_;
};

}  // namespace fracbench::bem
