#pragma once

#include <string>

#include "core/material.h"
#include "core/triangle_mesh.h"

namespace fracbench {

/// The body that is to be broken: a closed mesh in its own frame, and what it is made of.
struct Target {
  std::string name;
  TriangleMesh mesh;
  Material material;
};

}  // namespace fracbench
