#pragma once

#include <span>
#include <string_view>

#include "core/triangle_mesh.h"
#include "scenarios/shapes/block_surface.h"
#include "scenarios/shapes/extrusion.h"
#include "scenarios/shapes/lathe.h"

namespace fracbench {

/// A shape that is made in code: the same bytes each time, a solid at every resolution in its
/// range.
struct GeneratedShape {
  std::string_view name;
  std::string_view summary;
  int least_resolution;    ///< below it, thin parts could not be told apart
  int default_resolution;  ///< some thousand faces
  /// The mesh with triangles of about longest side / resolution, in a scale of its own.
  TriangleMesh (*make)(int resolution);
};

constexpr int greatest_resolution = 400;

/// In the order of the documentation.
std::span<const GeneratedShape> generated_shapes();

// What the shapes are made of, so that tests can compute their volumes by other ways.
std::vector<Block> bar_blocks();
std::vector<Block> cube_blocks();
std::vector<Block> chair_blocks();
std::vector<Outline> letter_a_outlines();
double letter_a_depth();
Profile pot_profile();
Profile plinth_profile();

TriangleMesh sphere_mesh(int resolution);
TriangleMesh mug_mesh(int resolution);

}  // namespace fracbench
