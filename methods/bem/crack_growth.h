#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "methods/bem/crack_sheet.h"
#include "methods/bem/crack_traces.h"
#include "methods/bem/cut_links.h"
#include "methods/bem/initiation.h"

namespace fracbench::bem {

/// A point of the front at the resolution of the voxels. The coarse sheet's boundary vertices are
/// some of the markers.
struct FrontMarker {
  Vec3 position;
  Vec3 forward;      ///< the way in which it advances, unit length
  Vec3 normal;       ///< of the crack's surface, unit length, orthogonal to forward
  double speed = 0;  ///< m/s
  double turn = 0;   ///< rad, the last kink
  FrontState state = FrontState::advancing;
  std::int32_t vertex = -1;  ///< of Crack::surface
  std::int32_t coarse = -1;  ///< vertex of Crack::sheet's mesh; -1: the marker lies between two
};

/// A crack as a value: it can be carried on in another body that holds a part of it.
struct Crack {
  CrackSheet sheet;      ///< for the boundary elements
  TriangleMesh surface;  ///< the surface that the markers have swept, as fine as the voxels
  std::vector<FrontMarker> front;  ///< in the order of sheet.boundary, a closed loop
};

struct GrowthOptions {
  double mesh_size = 0.1;  ///< h, m: edge length of the coarse sheet
  double spacing = 0.01;   ///< m: distance of the markers, at most a voxel and h / 5
};

/// The body in which cracks grow, with all that they have cut.
struct CrackSpace {
  explicit CrackSpace(CutLinks& links_) : links(links_), traces(links_.spacing()) {}

  CutLinks& links;
  CrackTraces traces;
};

/// What a vertex of the coarse boundary does during a step.
struct FrontMotion {
  double angle = 0;  ///< rad, kink from FrontFrame::forward towards FrontFrame::normal
  double speed = 0;  ///< m/s; 0: arrested
};

/// A crack that has just started.
struct SeededCrack {
  Crack crack;
  double area = 0;  ///< m^2, inside the body
};

/// A new crack: a disc of radius mesh_size / 2 around the seed, in its plane, that ends where it
/// leaves the body or meets another crack; cuts the links in the name of `crack`. Empty where the
/// seed's plane cuts no voxel of the body.
std::optional<SeededCrack> seed_crack(const CrackSeed& seed, std::int32_t crack, CrackSpace& space,
                                      const GrowthOptions& options);

/// Turns the markers and gives them their speeds: angle and speed are linear in arc length between
/// the coarse vertices (those that do not advance take the nearest one that does), the directions
/// come from the front itself, smoothed over mesh_size. `motions` is parallel to sheet.boundary.
void steer(Crack& crack, std::span<const FrontMotion> motions, const GrowthOptions& options);

/// Moves the markers by speed * duration, at most about a spacing, and cuts the links of the swept
/// surface. A marker that leaves the body goes on for two voxels and stays (at_surface); one that
/// meets a crack goes on for one voxel and stays (at_crack): another crack that it crosses, or one
/// in nearly its own plane, itself included where the front has gone around a hole. The front's
/// ends are drawn along the surface or crack at which they end. Returns the area swept inside the
/// body, m^2.
double advance(Crack& crack, std::int32_t id, double duration, CrackSpace& space,
               const GrowthOptions& options);

/// Lets the coarse sheet follow the markers: a strip of triangles where the boundary has moved far,
/// moved vertices elsewhere; edges above 1.4 mesh_size split, below 0.2 mesh_size collapsed. The
/// boundary stays one loop; every part of the front that advances has a vertex. Throws
/// MethodFailure where the sheet does not stay a manifold.
void follow_front(Crack& crack, const GrowthOptions& options);

/// A crack of a broken body in one of its pieces (`space`): cuts its links there and stops the
/// markers that lie outside. Empty where the crack's surface does not touch the piece.
std::optional<Crack> inherit(const Crack& crack, std::int32_t id, CrackSpace& space,
                             const GrowthOptions& options);

/// Whether any part of the front may still advance.
bool advances(const Crack& crack);

}  // namespace fracbench::bem
