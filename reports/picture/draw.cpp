#include "reports/picture/draw.h"

#include <GL/osmesa.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace fracbench {

namespace {

constexpr int kSamples = 2;        // along each side of a pixel
constexpr double kHalfView = 0.3;  // tangent of half the angle of view
constexpr double kMargin = 1.08;   // around the sphere that has to be seen
constexpr double kAmbient = 0.42;

struct Destroy {
  void operator()(OSMesaContext context) const { OSMesaDestroyContext(context); }
};

using Matrix = Eigen::Matrix4d;

/// Of a camera that sees the whole sphere of the view.
struct Camera {
  Vec3 eye, forward, right, up;
  double distance;

  explicit Camera(const View& view) {
    forward = view.towards.normalized();
    const Vec3 vertical = std::abs(forward.z()) > 0.99 ? Vec3::UnitY() : Vec3::UnitZ();
    right = forward.cross(vertical).normalized();
    up = right.cross(forward);
    distance = kMargin * view.radius * std::sqrt(1 + 1 / (kHalfView * kHalfView));
    eye = view.centre - distance * forward;
  }

  Matrix model_view() const {
    Matrix m = Matrix::Identity();
    m.block<1, 3>(0, 0) = right.transpose();
    m.block<1, 3>(1, 0) = up.transpose();
    m.block<1, 3>(2, 0) = -forward.transpose();
    m.block<3, 1>(0, 3) = -m.block<3, 3>(0, 0) * eye;
    return m;
  }

  Matrix projection(double aspect, double radius) const {
    const double near = std::max(distance - 20 * radius, 0.02 * distance);
    const double far = distance + 20 * radius;
    const double x = aspect < 1 ? kHalfView : kHalfView * aspect;
    const double y = aspect < 1 ? kHalfView / aspect : kHalfView;
    Matrix m = Matrix::Zero();
    m(0, 0) = 1 / x;
    m(1, 1) = 1 / y;
    m(2, 2) = -(far + near) / (far - near);
    m(2, 3) = -2 * far * near / (far - near);
    m(3, 2) = -1;
    return m;
  }
};

/// How bright a face is: from both sides the same, brightest where it faces the light.
double shade(const Vec3& normal, const Camera& camera) {
  const Vec3 key = (-camera.forward + 0.5 * camera.up + 0.35 * camera.right).normalized();
  return kAmbient + (1 - kAmbient) * std::max(0.0, normal.dot(key));
}

void draw_faces(const DrawnMesh& drawn, const Camera& camera, bool lines) {
  const TriangleMesh& mesh = *drawn.mesh;
  std::vector<Vec3> places;
  places.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) places.push_back(drawn.pose.to_world(v + drawn.shift));
  ::glPolygonMode(GL_FRONT_AND_BACK, lines ? GL_LINE : GL_FILL);
  ::glBegin(GL_TRIANGLES);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corner = [&](int k) -> const Vec3& { return places[mesh.faces[f][k]]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
    const Vec3 colour = lines ? Vec3(0.13, 0.13, 0.15) : drawn.colours[f] * shade(normal, camera);
    ::glColor3d(colour.x(), colour.y(), colour.z());
    for (int k = 0; k < 3; ++k) ::glVertex3d(corner(k).x(), corner(k).y(), corner(k).z());
  }
  ::glEnd();
}

/// Every pixel the mean of its samples; the renderer's rows go upwards.
Picture reduced(const std::vector<std::uint8_t>& rgba, int width, int height) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int sy = 0; sy < kSamples; ++sy) {
          for (int sx = 0; sx < kSamples; ++sx) {
            const std::size_t row = static_cast<std::size_t>(kSamples * (height - 1 - y) + sy);
            const std::size_t column = static_cast<std::size_t>(kSamples * x + sx);
            sum += rgba[4 * (row * kSamples * width + column) + c];
          }
        }
        picture.rgb[3 * (static_cast<std::size_t>(y) * width + x) + c] =
            static_cast<std::uint8_t>(sum / (kSamples * kSamples));
      }
    }
  }
  return picture;
}

}  // namespace

Picture draw(const std::vector<DrawnMesh>& meshes, const View& view, int width, int height) {
  const int columns = kSamples * width;
  const int rows = kSamples * height;
  const std::unique_ptr<osmesa_context, Destroy> context(
      OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr));
  std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(columns) * rows);
  if (!context || !OSMesaMakeCurrent(context.get(), rgba.data(), GL_UNSIGNED_BYTE, columns, rows)) {
    throw std::runtime_error("pictures: Mesa's software renderer cannot be started");
  }
  const Camera camera(view);
  ::glViewport(0, 0, columns, rows);
  ::glMatrixMode(GL_PROJECTION);
  ::glLoadMatrixd(camera.projection(static_cast<double>(width) / height, view.radius).data());
  ::glMatrixMode(GL_MODELVIEW);
  ::glLoadMatrixd(camera.model_view().data());
  ::glEnable(GL_DEPTH_TEST);
  ::glClearColor(1, 1, 1, 1);
  ::glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  // Faces a little farther away, so that edges lie on top.
  ::glEnable(GL_POLYGON_OFFSET_FILL);
  ::glPolygonOffset(1, 1);
  for (const DrawnMesh& drawn : meshes) draw_faces(drawn, camera, false);
  if (view.wireframe) {
    ::glLineWidth(kSamples);
    for (const DrawnMesh& drawn : meshes) draw_faces(drawn, camera, true);
  }
  ::glFinish();
  return reduced(rgba, width, height);
}

}  // namespace fracbench
