#pragma once

#include <vector>

#include "core/triangle_mesh.h"
#include "core/vec3.h"
#include "reports/picture/picture.h"

namespace fracbench {

/// A mesh in one place, with a colour for each face.
struct DrawnMesh {
  const TriangleMesh* mesh = nullptr;
  std::vector<Vec3> colours;  ///< parallel to the faces, sRGB in [0, 1]
  Pose pose = {};
  Vec3 shift = Vec3::Zero();  ///< before the pose
};

/// From where it is looked at, in perspective; z is up.
struct View {
  Vec3 centre = Vec3::Zero();
  Vec3 towards = Vec3(-0.5, -0.7, -0.4);  ///< the way that is looked
  double radius = 1;                      ///< of what has to be seen around the centre, m
  bool wireframe = false;                 ///< edges of the faces on top
};

/// Draws without a display (Mesa's software renderer, four samples a pixel), faces flat, lit from
/// above the camera. Throws std::runtime_error where the renderer cannot be had.
Picture draw(const std::vector<DrawnMesh>& meshes, const View& view, int width, int height);

}  // namespace fracbench
