#include "scenarios/shapes/generated_shapes.h"

#include <array>

namespace fracbench {
namespace {

// Longest sides of the shapes as they are defined here, m; load_shape scales them afterwards.
constexpr double bar_length = 1.9;
constexpr double cube_side = 1.9;
constexpr double chair_height = 1.9;
constexpr double letter_height = 1.9;
constexpr double pot_height = 1.9;
constexpr double plinth_width = 1.9;

TriangleMesh bar(int resolution) { return block_surface(bar_blocks(), bar_length / resolution); }
TriangleMesh cube(int resolution) { return block_surface(cube_blocks(), cube_side / resolution); }
TriangleMesh chair(int resolution) {
  return block_surface(chair_blocks(), chair_height / resolution);
}
TriangleMesh letter_a(int resolution) {
  return extrusion(letter_a_outlines(), letter_a_depth(), letter_height / resolution);
}
TriangleMesh pot(int resolution) { return lathe(pot_profile(), pot_height / resolution, 24); }
TriangleMesh plinth(int resolution) {
  return lathe(plinth_profile(), plinth_width / resolution, 24);
}

constexpr std::array<GeneratedShape, 8> shapes{{
    {"bar", "slender square bar, 1.9 x 0.3 x 0.3", 4, 48, bar},
    {"pot", "hollow collared jar, a surface of revolution", 12, 48, pot},
    {"mug", "cup with a handle, genus 1", 16, 36, mug_mesh},
    {"A", "extruded letter A with its hole, genus 1", 8, 32, letter_a},
    {"chair", "four legs, seat and an open back, genus 2", 12, 40, chair},
    {"plinth", "round stepped base with mouldings", 12, 40, plinth},
    {"sphere", "geodesic sphere", 4, 30, sphere_mesh},
    {"cube", "cube", 1, 16, cube},
}};

}  // namespace

std::span<const GeneratedShape> generated_shapes() { return shapes; }

std::vector<Block> bar_blocks() { return {{Vec3(-0.95, -0.15, -0.15), Vec3(0.95, 0.15, 0.15)}}; }

std::vector<Block> cube_blocks() { return {{Vec3::Constant(-0.95), Vec3::Constant(0.95)}}; }

std::vector<Block> chair_blocks() {
  constexpr double width = 0.9, leg = 0.13, seat = 0.88, thickness = 0.12;
  constexpr double far = width - leg, top = seat + thickness;
  return {
      {Vec3(0, 0, 0), Vec3(leg, leg, seat)},
      {Vec3(far, 0, 0), Vec3(width, leg, seat)},
      {Vec3(0, far, 0), Vec3(leg, width, seat)},
      {Vec3(far, far, 0), Vec3(width, width, seat)},
      {Vec3(0, 0, seat), Vec3(width, width, top)},
      // The back: two posts and two rails.
      {Vec3(0, far, top), Vec3(leg, width, chair_height)},
      {Vec3(far, far, top), Vec3(width, width, chair_height)},
      {Vec3(leg, far, 1.24), Vec3(far, width, 1.4)},
      {Vec3(leg, far, 1.65), Vec3(far, width, chair_height)},
  };
}

std::vector<Outline> letter_a_outlines() {
  const auto point = [](double x, double z) { return Eigen::Vector2d(x, z); };
  return {{point(-0.8, 0), point(-0.45, 0), point(-0.33, 0.4), point(0.33, 0.4), point(0.45, 0),
           point(0.8, 0), point(0.22, letter_height), point(-0.22, letter_height)},
          {point(-0.24, 0.7), point(0, 1.5), point(0.24, 0.7)}};
}

double letter_a_depth() { return 0.45; }

Profile pot_profile() {
  const auto p = [](double r, double z) { return ProfilePoint(r, z); };
  return {
      line_piece(p(0, 0), p(0.38, 0)),                                        // foot
      line_piece(p(0.38, 0), p(0.40, 0.08)),                                  //
      curve_piece(p(0.40, 0.08), p(0.12, 0.30), p(0, 0.35), p(0.70, 1.02)),   // belly
      curve_piece(p(0.70, 1.02), p(0, 0.35), p(-0.20, 0.15), p(0.42, 1.56)),  // shoulder
      curve_piece(p(0.42, 1.56), p(-0.06, 0.06), p(0.02, 0.10), p(0.42, 1.76)),
      curve_piece(p(0.42, 1.76), p(0.02, 0.05), p(0, 0.05), p(0.50, 1.86)),  // collar
      curve_piece(p(0.50, 1.86), p(0, 0.05), p(-0.05, 0), p(0.44, 1.90)),    // rim
      curve_piece(p(0.44, 1.90), p(-0.06, 0), p(-0.02, -0.10), p(0.31, 1.72)),
      curve_piece(p(0.31, 1.72), p(-0.02, -0.10), p(0.06, -0.06), p(0.34, 1.48)),
      curve_piece(p(0.34, 1.48), p(0.20, -0.15), p(0, -0.30), p(0.58, 1.02)),
      curve_piece(p(0.58, 1.02), p(0, -0.35), p(-0.10, -0.20), p(0.30, 0.20)),
      curve_piece(p(0.30, 0.20), p(-0.04, -0.06), p(-0.10, 0), p(0.15, 0.12)),
      line_piece(p(0.15, 0.12), p(0, 0.12)),  // floor
  };
}

Profile plinth_profile() {
  const auto p = [](double r, double z) { return ProfilePoint(r, z); };
  return {
      line_piece(p(0, 0), p(0.95, 0)),
      line_piece(p(0.95, 0), p(0.95, 0.10)),  // lower step
      line_piece(p(0.95, 0.10), p(0.90, 0.10)),
      curve_piece(p(0.90, 0.10), p(0.05, 0.02), p(-0.05, 0.02), p(0.90, 0.20)),  // torus
      curve_piece(p(0.90, 0.20), p(-0.08, 0), p(0, 0.08), p(0.80, 0.30)),        // cove
      line_piece(p(0.80, 0.30), p(0.86, 0.30)),
      line_piece(p(0.86, 0.30), p(0.86, 0.40)),  // upper step
      line_piece(p(0.86, 0.40), p(0, 0.40)),
  };
}

}  // namespace fracbench
