#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "methods/bem/propagate.h"

namespace fracbench::test {

using PointStress = std::function<Mat3(const Vec3&)>;

/// The same stress everywhere: `tension` along `direction`.
PointStress uniaxial(const Vec3& direction, double tension);

/// A closed box about the origin.
TriangleMesh box(const Vec3& extent);

/// A crack may start at these points of the surface only.
struct Start {
  Vec3 position;
  Vec3 normal;  ///< of the surface, outward
};

/// With the `fast` stress intensities.
bem::FractureModel model(const PointStress& stress, const std::vector<Start>& starts);

/// As above, but cracks start in the planes of these normals, whatever the stress.
bem::FractureModel model_with_planes(const PointStress& stress, const std::vector<Start>& starts,
                                     const std::vector<Vec3>& planes);

/// The same tension in every direction: cracks stay in their planes.
PointStress hydrostatic(double tension);

/// Runs in a context of its own.
bem::Propagation run(bem::CutLinks& links, const bem::FractureModel& model,
                     const bem::PropagationOptions& options, std::vector<bem::Crack> inherited = {},
                     int threads = 1);

/// Long enough for every front to end.
bem::PropagationOptions long_run(double mesh_size, int max_cracks = 10);

/// Volumes of the connected parts, as shares of the whole, largest first.
std::vector<double> parts(const bem::CutLinks& links);

/// What is wrong with a coarse sheet of a crack; empty: nothing.
std::string sheet_faults(const bem::Crack& crack, double mesh_size);

/// All numbers of a result, for comparing it byte for byte.
std::string bytes(const bem::Propagation& result);

}  // namespace fracbench::test
