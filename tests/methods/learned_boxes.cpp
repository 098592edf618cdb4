#include "tests/methods/learned_boxes.h"

#include <unistd.h>

#include "geometry/partition_by_labels.h"

namespace fracbench::learned_boxes {

namespace {

const Vec3 kHalf(0.95, 0.5, 0.45);

TriangleMesh box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c) {
    mesh.vertices.emplace_back(c & 1 ? high.x() : low.x(), c & 2 ? high.y() : low.y(),
                               c & 4 ? high.z() : low.z());
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace

Target body() { return {.name = "box", .mesh = box(-kHalf, kHalf), .material = {}}; }

Impact impact_at(double x) {
  Impulse impulse{.point = {x, 0, kHalf.z()},
                  .direction = {0, 0, -1},
                  .magnitude = 2e5,
                  .face = 2,
                  .normal = Vec3::UnitZ(),
                  .face_area = 0.95};
  Impact impact;
  impact.impulses = {impulse};
  impact.strikers.resize(1);
  impact.time_step = 1.0 / 250;
  return impact;
}

LearningExample example(double x) {
  VoxelGrid<std::int32_t> labels = unit_grid<std::int32_t>(32);
  for (std::size_t v = 0; v < labels.values.size(); ++v) {
    const auto i = static_cast<int>(v % 32);
    labels.values[v] = labels.position(i, 0, 0).x() < x ? 1 : 2;
  }
  LearningExample result{.impact = impact_at(x), .fragments = {}};
  for (Piece& piece : partition_by_labels(body().mesh, labels).pieces) {
    Fragment fragment{.mesh = std::move(piece.mesh), .faces = {}};
    for (const PieceFace& face : piece.faces) {
      fragment.faces.push_back(
          {.original_face = face.parent_face, .interface = face.is_fracture() ? 0 : -1});
    }
    result.fragments.push_back(std::move(fragment));
  }
  return result;
}

LearningData learning_data(int count) {
  LearningData data{.examples = {}, .max_impulse = 3e5};
  for (int n = 0; n < count; ++n) {
    data.examples.push_back(example(count > 1 ? -0.6 + 1.2 * n / (count - 1) : 0));
  }
  return data;
}

bool same_pieces(const std::vector<Piece>& a, const std::vector<Piece>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t n = 0; n < a.size(); ++n) {
    if (a[n].mesh.vertices != b[n].mesh.vertices || a[n].mesh.faces != b[n].mesh.faces ||
        a[n].faces != b[n].faces) {
      return false;
    }
  }
  return true;
}

std::filesystem::path fresh_folder(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() /
                      (name + "_" + std::to_string(static_cast<long>(getpid())));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace fracbench::learned_boxes
