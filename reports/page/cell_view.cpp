#include "reports/page/cell_view.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "geometry/simplify.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kViewVersion = 1;
constexpr std::size_t kLeastFaces = 60;  // of a fragment, however many there are

template <typename Number>
std::string base64(const std::vector<Number>& numbers) {
  const std::size_t size = numbers.size() * sizeof(Number);
  std::string text(4 * ((size + 2) / 3) + 1, '\0');
  const int length = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                     reinterpret_cast<const unsigned char*>(numbers.data()),
                                     static_cast<int>(size));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

/// Coordinates as 16 bit numbers between the corners of the box that holds all fragments.
class Grid {
 public:
  void hold(const TriangleMesh& mesh) {
    for (const Vec3& v : mesh.vertices) {
      low_ = low_.cwiseMin(v);
      high_ = high_.cwiseMax(v);
    }
  }
  double step() const { return std::max((high_ - low_).maxCoeff(), 1e-12) / 65535; }
  const Vec3& corner() const { return low_; }
  std::vector<std::uint16_t> places(const std::vector<Vec3>& points) const {
    std::vector<std::uint16_t> result;
    result.reserve(3 * points.size());
    for (const Vec3& p : points) {
      for (int k = 0; k < 3; ++k) {
        result.push_back(static_cast<std::uint16_t>(std::lround((p[k] - low_[k]) / step())));
      }
    }
    return result;
  }

 private:
  Vec3 low_ = Vec3::Constant(1e300);
  Vec3 high_ = Vec3::Constant(-1e300);
};

Json fragment_json(const Fragment& fragment, const Grid& grid, double share) {
  std::vector<std::int32_t> groups;
  groups.reserve(fragment.faces.size());
  for (const FragmentFace& face : fragment.faces) groups.push_back(face.is_fracture() ? 1 : 0);
  const auto wanted = static_cast<std::size_t>(share * static_cast<double>(groups.size()));
  const GroupedMesh view = simplify(fragment.mesh, groups, std::max(wanted, kLeastFaces));
  std::vector<std::uint32_t> indices;
  for (const Face& face : view.mesh.faces) {
    for (const std::int32_t v : face) indices.push_back(static_cast<std::uint32_t>(v));
  }
  return {{"piece", fragment.piece},
          {"parent", fragment.parent},
          {"faces", fragment.mesh.faces.size()},
          {"original", std::ranges::count(view.groups, 0)},
          {"vertices", base64(grid.places(view.mesh.vertices))},
          {"indices", base64(indices)}};
}

Json trajectory_json(const Trajectory& trajectory) {
  Json tracks = Json::array();
  for (const Track& track : trajectory.tracks) {
    std::vector<float> poses;
    for (const Pose& pose : track.poses) {
      const Vec3 p = pose.position;
      const auto& q = pose.orientation;
      for (const double value : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) {
        poses.push_back(static_cast<float>(value));
      }
    }
    tracks.push_back({{"kind", static_cast<int>(track.kind)},
                      {"index", track.index},
                      {"first_frame", track.first_frame},
                      {"poses", base64(poses)}});
  }
  return {{"frame_seconds", trajectory.frame_seconds}, {"tracks", std::move(tracks)}};
}

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json impacts_json(const SceneResult& scene) {
  Json impacts = Json::array();
  const auto add = [&](const Impact& impact) {
    Json impulses = Json::array();
    for (const Impulse& impulse : impact.impulses) {
      impulses.push_back({{"point", vector_json(impulse.point)},
                          {"direction", vector_json(impulse.direction)},
                          {"magnitude", impulse.magnitude}});
    }
    impacts.push_back(
        {{"time", impact.time}, {"fragment", impact.fragment}, {"impulses", std::move(impulses)}});
  };
  for (const Impact& impact : scene.impacts) add(impact);
  if (scene.impacts.empty() && scene.unbroken) add(*scene.unbroken);
  return impacts;
}

}  // namespace

std::string cell_view_head(std::string_view key) {
  return fmt::format("fracbenchCell({{\"version\":{},\"key\":\"{}\",", kViewVersion, key);
}

std::string cell_view(const Record& record, const TriangleMesh& target,
                      const CellViewOptions& options) {
  const SceneResult& scene = record.outcome.scene;
  const Fragments fragments = shown_fragments(record, target);
  Grid grid;
  std::size_t faces = 0;
  for (const Fragment& fragment : fragments) {
    grid.hold(fragment.mesh);
    faces += fragment.mesh.faces.size();
  }
  const double share =
      faces == 0 ? 1
                 : std::min(1.0, static_cast<double>(options.faces) / static_cast<double>(faces));
  Json json;
  json["corner"] = vector_json(grid.corner());
  json["step"] = grid.step();
  json["fragments"] = Json::array();
  for (const Fragment& fragment : fragments) {
    json["fragments"].push_back(fragment_json(fragment, grid, share));
  }
  json["trajectory"] = trajectory_json(scene.trajectory);
  json["impacts"] = impacts_json(scene);
  json["balls"] = ball_radii(record);
  const std::string body = json.dump();
  return cell_view_head(record.key) + body.substr(1) + ");\n";
}

}  // namespace fracbench
