#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/triangle_mesh.h"
#include "methods/bem/strength_field.h"

namespace fracbench::bem {

/// Stress on the surface of a body: one value for each element.
struct SurfaceStress {
  std::vector<Vec3> centers;  ///< m
  std::vector<Vec3> normals;  ///< outward, unit length
  std::vector<Mat3> stress;   ///< Pa, symmetric, tension positive
};

/// The centres and normals of a closed mesh's triangles with the given stresses.
SurfaceStress surface_stress(const TriangleMesh& mesh, std::vector<Mat3> stress);

struct InitiationOptions {
  int max_cracks = 10;            ///< at most so many new cracks
  double compressive_factor = 6;  ///< compressive strength over tensile strength
  /// As the authors' program: the principal stress of the largest absolute value counts, without
  /// a factor for compression.
  bool parity = false;
  double min_distance = 0.1;  ///< m, from every crack and every other new crack
};

/// Where a crack starts.
struct CrackSeed {
  std::size_t element = 0;
  Vec3 position;            ///< centre of the element, m
  Vec3 normal;              ///< of the crack's plane, unit length
  Vec3 surface_normal;      ///< of the element, outward
  double stress = 0;        ///< the principal stress that counts, Pa, with its sign
  double excess = 0;        ///< that stress over the strength there, above 1
  bool compressed = false;  ///< started by compression
};

/// New cracks, the highest excess first. An element's excess is the larger of
///   s1 / S and -s3 / (compressive_factor S),
/// where s1 >= s2 >= s3 are its principal stresses with their signs and S the strength at its
/// centre; with `parity` max |s_i| / S. The crack's plane is normal to the principal direction of
/// the stress that counts, under compression as well, as driving_stress turns the fronts that grow
/// from there. Of equal excess, the first element is taken. `occupied`: points on the cracks that
/// are there already.
///
/// Throws InputError where the arrays differ in length; MethodFailure for a stress that is no
/// number.
std::vector<CrackSeed> initiate(const SurfaceStress& surface, const StrengthField& strength,
                                std::span<const Vec3> occupied, const InitiationOptions& options);

}  // namespace fracbench::bem
