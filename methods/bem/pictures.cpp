#include "methods/bem/pictures.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <vector>

#include "geometry/write_vtk.h"

namespace fracbench::bem {
namespace {

void push(std::vector<float>& values, const Vec3& v) {
  for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(v[c]));
}

VtkData surface_data(const PictureData& data) {
  VtkArray displacement{"displacement", 3, {}}, traction{"traction", 3, {}};
  VtkArray largest{"principal_stress_1", 1, {}}, middle{"principal_stress_2", 1, {}},
      least{"principal_stress_3", 1, {}}, direction{"principal_direction_1", 3, {}};
  for (std::size_t v = 0; v < data.elements.vertices.size(); ++v) {
    push(displacement.values, data.stress.displacements().segment<3>(3 * v));
  }
  for (std::size_t f = 0; f < data.elements.faces.size(); ++f) {
    push(traction.values, data.tractions.col(f));
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(data.stress.on_surface()[f]);
    largest.values.push_back(static_cast<float>(principal.eigenvalues()[2]));
    middle.values.push_back(static_cast<float>(principal.eigenvalues()[1]));
    least.values.push_back(static_cast<float>(principal.eigenvalues()[0]));
    push(direction.values, principal.eigenvectors().col(2));
  }
  return {{displacement}, {largest, middle, least, direction, traction}};
}

void append(TriangleMesh& all, const TriangleMesh& part) {
  const auto base = static_cast<std::int32_t>(all.vertices.size());
  all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const Face& f : part.faces) all.faces.push_back({f[0] + base, f[1] + base, f[2] + base});
}

}  // namespace

void write_pictures(const std::filesystem::path& folder, std::int32_t which,
                    const PictureData& data) {
  const std::string stem =
      which < 0 ? std::string("bem_target_") : fmt::format("bem_piece_{}_", which);
  write_vtp(folder / (stem + "surface.vtp"), data.elements, surface_data(data));

  TriangleMesh surfaces, sheets;
  VtkArray surface_crack{"crack", 1, {}}, sheet_crack{"crack", 1, {}};
  std::vector<CrackSheet> all;
  for (std::size_t c = 0; c < data.cracks.size(); ++c) {
    const Crack& crack = data.cracks[c];
    all.push_back(crack.sheet);
    append(surfaces, crack.surface);
    append(sheets, crack.sheet.mesh);
    surface_crack.values.resize(surfaces.faces.size(), static_cast<float>(c));
    sheet_crack.values.resize(sheets.faces.size(), static_cast<float>(c));
  }
  write_vtp(folder / (stem + "cracks.vtp"), surfaces, {{}, {surface_crack}});

  VtkArray k1{"K_I", 1, std::vector<float>(sheets.vertices.size(), 0.0F)};
  VtkArray k2{"K_II", 1, k1.values}, k3{"K_III", 1, k1.values};
  const auto intensities = data.stress_intensity(all);
  std::size_t base = 0;
  for (std::size_t c = 0; c < all.size(); ++c) {
    for (std::size_t b = 0; b < all[c].boundary.size(); ++b) {
      const std::size_t v = base + all[c].boundary[b];
      k1.values[v] = static_cast<float>(intensities[c][b].mode_1);
      k2.values[v] = static_cast<float>(intensities[c][b].mode_2);
      k3.values[v] = static_cast<float>(intensities[c][b].mode_3);
    }
    base += all[c].mesh.vertices.size();
  }
  write_vtp(folder / (stem + "sheets.vtp"), sheets, {{k1, k2, k3}, {sheet_crack}});
  write_vti(folder / (stem + "labels.vti"), data.labels);
}

}  // namespace fracbench::bem
