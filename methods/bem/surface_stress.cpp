#include "methods/bem/surface_stress.h"

#include "methods/bem/elastic_operator.h"

namespace fracbench::bem {

double lame_lambda(const Material& material) {
  const double nu = material.poisson_ratio;
  return material.young_modulus * nu / ((1 + nu) * (1 - 2 * nu));
}

Mat3 stress_of_gradient(const Mat3& gradient, const Material& material) {
  return lame_lambda(material) * gradient.trace() * Mat3::Identity() +
         shear_modulus(material) * (gradient + gradient.transpose());
}

std::vector<Mat3> surface_stress(const BoundaryElements& elements,
                                 const Eigen::VectorXd& displacements,
                                 const Eigen::Matrix3Xd& tractions, const Material& material) {
  const double nu = material.poisson_ratio;
  const double mu = shear_modulus(material);
  std::vector<Mat3> stresses(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const Vec3& n = elements.normals[k];
    const Vec3 t = tractions.col(static_cast<Eigen::Index>(k));
    Mat3 gradient = Mat3::Zero();  // in the plane: d u_i / d x_j
    for (int a = 0; a < 3; ++a) {
      // The gradient of a hat function from its curl n x gradient.
      const Vec3 slope = elements.curls[k][a].cross(n);
      gradient +=
          displacements.segment<3>(3 * static_cast<Eigen::Index>(elements.triangles[k][a])) *
          slope.transpose();
    }
    const Mat3 in_plane = Mat3::Identity() - n * n.transpose();
    const Mat3 strain = in_plane * (gradient + gradient.transpose()) / 2 * in_plane;
    const double normal_stress = t.dot(n);
    const double mean = 2 * mu * nu / (1 - nu) * strain.trace() + nu / (1 - nu) * normal_stress;
    const Vec3 shear = t - normal_stress * n;
    stresses[k] = 2 * mu * strain + mean * in_plane + normal_stress * n * n.transpose() +
                  shear * n.transpose() + n * shear.transpose();
  }
  return stresses;
}

}  // namespace fracbench::bem
