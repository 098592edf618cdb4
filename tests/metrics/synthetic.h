#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/fragments.h"
#include "metrics/metric.h"

namespace fracbench::synthetic {

/// The box with corners `low` and `high`: 8 vertices, 12 faces.
TriangleMesh box(const Vec3& low = Vec3::Zero(), const Vec3& high = Vec3::Ones());

/// The body as one fragment, every face tagged with itself.
Fragment whole(const TriangleMesh& body);

/// Both sides of a convex fragment cut by a plane that meets it: first the one the normal points
/// away from. The new faces carry the interface; both sides have the same vertices there.
std::pair<Fragment, Fragment> cut(const Fragment& convex, const Vec3& point, const Vec3& normal,
                                  std::int32_t interface);

/// A convex body cut by planes through `point`, one after the other, each cutting every fragment.
Fragments cut_all(const TriangleMesh& body, const Vec3& point, std::span<const Vec3> normals);

/// Heights z over x, the top and bottom of a slab of width 1 along y.
struct Column {
  double x;
  double low;
  double high;
};
/// The solid between the heights; faces of the top carry `top`, of the bottom `bottom` as their
/// interface where it is not negative; all others are original face 0.
Fragment slab(std::span<const Column> columns, std::int32_t bottom, std::int32_t top);

/// The unit cube in two slabs that meet in a saw tooth of so many teeth, whose flanks make
/// `degrees` with the plane z = 1/2.
Fragments corrugated_cube(int teeth, double degrees);

/// What metrics see of it.
CellResult cell(const TriangleMesh& body, const Fragments& fragments,
                std::span<const Impact> impacts = {});

/// An impact of one impulse.
Impact impact(const Vec3& direction);

/// The value of that name; fails the test where it is not there or there twice.
double value(const Measurement& measurement, std::string_view name);
bool has(const Measurement& measurement, std::string_view name);
const std::vector<double>& series(const Measurement& measurement, std::string_view name);

}  // namespace fracbench::synthetic
