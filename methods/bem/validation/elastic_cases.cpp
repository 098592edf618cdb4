#include "methods/bem/validation/elastic_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/measures.h"
#include "methods/bem/body_stress.h"
#include "methods/bem/elastic_body.h"
#include "methods/bem/elastic_operator.h"
#include "methods/bem/surface_stress.h"
#include "methods/bem/triangle_rules.h"
#include "methods/bem/validation/known_fields.h"
#include "methods/bem/validation/smooth_bodies.h"

namespace fracbench::bem {
namespace {

Material test_material() {
  Material material;
  material.young_modulus = 3e9;
  material.poisson_ratio = 0.3;
  return material;
}

using Field = std::function<Vec3(const Vec3&)>;

Eigen::VectorXd at_vertices(const BoundaryElements& elements, const Field& field) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(elements.unknowns()));
  for (std::size_t v = 0; v < elements.vertices.size(); ++v) {
    values.segment<3>(3 * static_cast<Eigen::Index>(v)) = field(elements.vertices[v]);
  }
  return values;
}

// Means over each triangle of the traction of a stress field.
Eigen::Matrix3Xd mean_tractions(const BoundaryElements& elements,
                                const std::function<Mat3(const Vec3&)>& stress) {
  Eigen::Matrix3Xd tractions =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(elements.size()));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Corners corners = elements.corners(k);
    for (const TrianglePoint& point : triangle_rule(12)) {
      const Vec3 x =
          corners[0] + point.u * (corners[1] - corners[0]) + point.v * (corners[2] - corners[0]);
      tractions.col(static_cast<Eigen::Index>(k)) += point.weight * stress(x) * elements.normals[k];
    }
  }
  return tractions;
}

std::vector<Accuracy> rigid_modes(Context& context) {
  std::vector<Accuracy> rows;
  for (const auto& [name, mesh] : {std::pair{"cube, 384 triangles", cube_surface(8)},
                                   std::pair{"sphere, 320 triangles", sphere_surface(1, 2)}}) {
    const BoundaryElements elements = make_boundary_elements(mesh);
    const Eigen::MatrixXd matrix = assemble_hypersingular(elements, test_material(), context);
    double worst_shift = 0;
    double worst_turn = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 axis = Vec3::Unit(k);
      const auto force = [&](const Field& field) {
        const Eigen::VectorXd u = at_vertices(elements, field);
        return (matrix * u).norm() / (matrix.norm() * u.norm());
      };
      worst_shift = std::max(worst_shift, force([&](const Vec3&) { return axis; }));
      worst_turn =
          std::max(worst_turn, force([&](const Vec3& x) -> Vec3 { return axis.cross(x); }));
    }
    const std::string reference = "zero force on rigid motions";
    rows.push_back({fmt::format("translations, {}", name), reference, 0, worst_shift, 1e-12,
                    "|D u| / (|D| |u|)"});
    rows.push_back(
        {fmt::format("rotations, {}", name), reference, 0, worst_turn, 1e-5, "|D u| / (|D| |u|)"});
  }
  return rows;
}

// The stress component of the triangle where it is farthest from `expected`.
double worst_of(const std::vector<Mat3>& stresses, int row, int column, double expected) {
  double worst = expected;
  for (const Mat3& stress : stresses) {
    if (!(std::abs(stress(row, column) - expected) <= std::abs(worst - expected))) {
      worst = stress(row, column);
    }
  }
  return worst;
}

std::vector<Accuracy> uniform_stress(Context& context) {
  const Material material = test_material();
  const auto surface = [&](const TriangleMesh& mesh, const Mat3& stress) {
    const ElasticBody body(mesh, material, context);
    const Eigen::Matrix3Xd tractions =
        mean_tractions(body.elements(), [&](const Vec3&) { return stress; });
    return surface_stress(body.elements(), body.displacements(tractions, context), tractions,
                          material);
  };
  Mat3 tension = Mat3::Zero();
  tension(0, 0) = 1e6;
  const std::vector<Mat3> cube = surface(cube_surface(8), tension);
  const std::vector<Mat3> sphere = surface(sphere_surface(1, 2), -1e6 * Mat3::Identity());
  return {{"cube in tension, axial stress", "closed form, worst triangle", 1e6,
           worst_of(cube, 0, 0, 1e6), 1e-4, "Pa"},
          {"cube in tension, lateral stress over axial", "closed form, worst triangle", 0,
           worst_of(cube, 1, 1, 0) / 1e6, 1e-4, ""},
          {"sphere under pressure, stress", "closed form, worst triangle", -1e6,
           worst_of(sphere, 0, 0, -1e6), 1e-4, "Pa"}};
}

// A point force outside the body: what it does on the body's surface is a load whose answer is
// known.
struct KelvinErrors {
  double displacement = 0;  // relative, root mean square over the vertices, rigid motion removed
  double strain = 0;        // relative, root mean square over the area
  double interpolated = 0;  // the strain's if all displacements were exact
  double inside = 0;        // stress, relative to the largest: worst of some points
};

KelvinErrors kelvin_errors(const TriangleMesh& mesh, const KelvinSource& source,
                           std::span<const Vec3> inside, Context& context) {
  const Material material = test_material();
  const ElasticBody body(mesh, material, context);
  const BoundaryElements& elements = body.elements();
  const BalancedLoad load{
      mean_tractions(elements, [&](const Vec3& x) { return source.stress(x, material); }), {}};
  const BodyStress stress(body, load, context);
  Eigen::VectorXd exact =
      at_vertices(elements, [&](const Vec3& x) { return source.displacement(x, material); });
  const std::vector<Mat3> best = surface_stress(elements, exact, load.tractions, material);
  exact -= body.rigid_motions() * (body.rigid_motions().transpose() * exact);
  KelvinErrors errors;
  errors.displacement = (stress.displacements() - exact).norm() / exact.norm();

  const double nu = material.poisson_ratio;
  const auto strain = [&](const Mat3& s) -> Mat3 {
    return (1 + nu) * s - nu * s.trace() * Mat3::Identity();  // times Young's modulus
  };
  double squared = 0;
  double least = 0;
  double all = 0;
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Mat3 expected = strain(source.stress(elements.centroids[k], material));
    squared += elements.areas[k] * (strain(stress.on_surface()[k]) - expected).squaredNorm();
    least += elements.areas[k] * (strain(best[k]) - expected).squaredNorm();
    all += elements.areas[k] * expected.squaredNorm();
  }
  errors.strain = std::sqrt(squared / all);
  errors.interpolated = std::sqrt(least / all);
  for (const Vec3& x : inside) {
    const Mat3 expected = source.stress(x, material);
    errors.inside = std::max(errors.inside, (stress.at(x) - expected).norm() / expected.norm());
  }
  return errors;
}

// Order of convergence from one mesh to a finer one.
double order(const std::array<double, 3>& errors, const std::array<std::size_t, 3>& triangles,
             int from) {
  return 2 * std::log(errors[from] / errors[from + 1]) /
         std::log(static_cast<double>(triangles[from + 1]) / static_cast<double>(triangles[from]));
}

struct KelvinBody {
  std::string name;
  std::array<TriangleMesh, 3> meshes;
  KelvinSource source;
  std::vector<Vec3> inside;
};

std::vector<Accuracy> kelvin(const KelvinBody& body, Context& context) {
  std::array<double, 3> displacement;
  std::array<double, 3> strain;
  std::array<std::size_t, 3> triangles;
  KelvinErrors finest;
  for (std::size_t k = 0; k < 3; ++k) {
    finest = kelvin_errors(body.meshes[k], body.source, body.inside, context);
    displacement[k] = finest.displacement;
    strain[k] = finest.strain;
    triangles[k] = body.meshes[k].faces.size();
  }
  const std::string reference = "Kelvin's solution, source outside";
  const std::string size = fmt::format("{}, {} triangles", body.name, triangles[2]);
  return {{size + ", displacement", reference, 0, finest.displacement, 0.003, "relative error"},
          {size + ", strain", reference, 0, finest.strain, 0.01, "relative error"},
          {size + ", stress inside", reference, 0, finest.inside, 0.01, "relative error"},
          {size + ", strain over that of exact displacements", "theory: nothing lost", 1,
           finest.strain / finest.interpolated, 0.1, ""},
          {fmt::format("{}, order of the displacements, {} to {}", body.name, triangles[1],
                       triangles[2]),
           "theory", 2, order(displacement, triangles, 1), 0.25, ""},
          {fmt::format("{}, order of the displacements, {} to {}", body.name, triangles[0],
                       triangles[1]),
           "theory; the coarsest mesh is not in the asymptotic range yet", 2,
           order(displacement, triangles, 0), 1, ""},
          {fmt::format("{}, order of the strains, {} to {}", body.name, triangles[1], triangles[2]),
           "theory", 1, order(strain, triangles, 1), 0.1, ""}};
}

std::vector<Accuracy> kelvin_sphere(Context& context) {
  return kelvin({"sphere",
                 {sphere_surface(1, 1), sphere_surface(1, 2), sphere_surface(1, 3)},
                 {{2.4, 3, -2.6}, {1e6, -2e6, 3e6}},
                 {{0, 0, 0}, {0.3, 0.4, -0.5}, {-0.6, 0.2, 0.3}, {0.1, 0.85, 0.1}}},
                context);
}

std::vector<Accuracy> kelvin_cube(Context& context) {
  return kelvin({"cube",
                 {cube_surface(4), cube_surface(8), cube_surface(12)},
                 {{3.2, 3.6, -2}, {1e6, -2e6, 3e6}},
                 {{0.5, 0.5, 0.5}, {0.2, 0.3, 0.6}, {0.9, 0.85, 0.4}, {0.1, 0.1, 0.1}}},
                context);
}

std::vector<Accuracy> thick_sphere(Context& context) {
  const Material material = test_material();
  const double pressure = 1e6;
  // As large as spheres of radius 2 and 1: flat triangles between points on a sphere enclose less.
  const double flat = volume(sphere_surface(1, 2)) / (4 * std::numbers::pi / 3);
  const double scale = 1 / std::cbrt(flat);
  const TriangleMesh mesh = hollow_surface(sphere_surface(2 * scale, 2), sphere_surface(scale, 2));
  const ElasticBody body(mesh, material, context);
  const BoundaryElements& elements = body.elements();
  Eigen::Matrix3Xd tractions =
      Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(elements.size()));
  for (std::size_t k = elements.size() / 2; k < elements.size(); ++k) {
    tractions.col(static_cast<Eigen::Index>(k)) = -pressure * elements.normals[k];
  }
  const BodyStress stress(body, {tractions, {}}, context);
  const auto mean_hoop = [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    double area = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3& n = elements.normals[k];
      const Mat3& s = stress.on_surface()[k];
      sum += elements.areas[k] * (s.trace() - n.dot(s * n)) / 2;
      area += elements.areas[k];
    }
    return sum / area;
  };
  const std::string reference = "closed form (Lame 1852)";
  // In between: sigma_r = p a^3 (1 - b^3 / r^3) / (b^3 - a^3).
  const Vec3 x = 1.5 * Vec3(1, 2, -1).normalized();
  const double radial = x.normalized().dot(stress.at(x) * x.normalized());
  return {{"hoop stress at the inner surface", reference, thick_sphere_hoop_stress(1, 2, pressure),
           mean_hoop(elements.size() / 2, elements.size()), 0.02, "Pa"},
          {"hoop stress at the outer surface", reference, 1.5 * pressure / 7,
           mean_hoop(0, elements.size() / 2), 0.02, "Pa"},
          {"radial stress halfway", reference, pressure * (1 - 8 / 3.375) / 7, radial, 0.02, "Pa"}};
}

std::vector<Accuracy> hertz(Context&) {
  std::vector<Accuracy> rows;
  const std::pair<const char*, HertzContact> contacts[] = {
      {"body and ball of the published scene", {100, 1.7e9, 0.2, 25}},
      {"steel ball of a gram", {1e-3, 1.1e11, 0.003, 1}}};
  for (const auto& [name, contact] : contacts) {
    rows.push_back({fmt::format("contact duration, {}", name), "integration of Hertz's law",
                    integrated_contact_duration(contact), contact_duration(contact), 0.01, "s"});
  }
  return rows;
}

}  // namespace

std::vector<ValidationCase> elastic_validation_cases() {
  return {{"rigid-modes", "rigid motions of a free body take no force", 0.2, rigid_modes},
          {"uniform-stress", "bodies under uniform stress, which the elements represent exactly",
           0.3, uniform_stress},
          {"kelvin-sphere", "a point force outside a sphere: errors and order of convergence", 0.8,
           kelvin_sphere},
          {"kelvin-cube", "a point force outside a cube: errors and order of convergence", 0.8,
           kelvin_cube},
          {"thick-sphere", "a hollow sphere under inner pressure", 2, thick_sphere},
          {"hertz", "duration of an elastic contact", 0.1, hertz}};
}

}  // namespace fracbench::bem
