#include "reports/picture/record_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "geometry/measures.h"
#include "geometry/palette.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

const Vec3 kOriginal(0.56, 0.64, 0.71);
const Vec3 kFracture(0.85, 0.51, 0.17);
const Vec3 kArrow(0.75, 0.15, 0.15);
/// The way to look where nothing says from where.
const Vec3 kFromAbove(-0.5, -0.6, -0.45);

std::vector<Vec3> face_colours(const Fragment& fragment, std::size_t number, bool by_surface) {
  std::vector<Vec3> colours;
  for (const FragmentFace& face : fragment.faces) {
    const Vec3 own = fragment_color(number);
    if (by_surface) {
      colours.push_back(face.is_fracture() ? kFracture : kOriginal);
    } else {
      colours.push_back(face.is_fracture() ? Vec3(0.65 * own + 0.35 * fracture_color()) : own);
    }
  }
  return colours;
}

const Track* track_at(const Trajectory& trajectory, Track::Kind kind, std::int32_t index,
                      int frame) {
  for (const Track& track : trajectory.tracks) {
    if (track.kind == kind && track.index == index && frame >= track.first_frame &&
        !track.poses.empty()) {
      return &track;
    }
  }
  return nullptr;
}

/// Where a fragment is at a frame: on its own track, before that its parent's or the target's.
Pose pose_at(const Trajectory& trajectory, const Fragment& fragment, int frame) {
  const Track* track = track_at(trajectory, Track::Kind::piece, fragment.piece, frame);
  if (!track) track = track_at(trajectory, Track::Kind::piece, fragment.parent, frame);
  if (!track) track = track_at(trajectory, Track::Kind::target, 0, frame);
  if (!track) return {};
  const auto last = static_cast<int>(track->poses.size()) - 1;
  return track->poses[static_cast<std::size_t>(std::clamp(frame - track->first_frame, 0, last))];
}

const Impact* first_impact(const SceneResult& scene) {
  if (!scene.impacts.empty()) return &scene.impacts.front();
  return scene.unbroken ? &*scene.unbroken : nullptr;
}

Vec3 way_to_look(const SceneResult& scene) {
  const Impact* impact = first_impact(scene);
  Vec3 way = kFromAbove;
  if (impact && !impact->impulses.empty()) way += impact->impulses.front().direction;
  return way.norm() > 1e-6 ? way : Vec3(-1, 0, 0);
}

/// How far the mesh reaches from the middle of its box.
double reach_of(const TriangleMesh& mesh) {
  const Vec3 centre = bounding_box(mesh).center();
  double reach = 0;
  for (const Vec3& v : mesh.vertices) reach = std::max(reach, (v - centre).norm());
  return reach;
}

/// A cone at the end of a rod, the tip at the origin, along a unit vector.
TriangleMesh arrow(const Vec3& direction, double length) {
  constexpr int sides = 16;
  const Vec3 across = direction.unitOrthogonal();
  const Vec3 beside = direction.cross(across);
  TriangleMesh mesh;
  // From the tip backwards: distance from it and radius of each ring, as shares of the length.
  for (const auto& [back, radius] :
       {std::pair(0.0, 0.0), std::pair(0.35, 0.12), std::pair(0.35, 0.045), std::pair(1.0, 0.045),
        std::pair(1.0, 0.0)}) {
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.vertices.push_back(
          length *
          (radius * (std::cos(angle) * across + std::sin(angle) * beside) - back * direction));
    }
  }
  for (std::int32_t first = 0; first + sides < std::ssize(mesh.vertices); first += sides) {
    for (std::int32_t k = 0; k < sides; ++k) {
      const std::int32_t here = first + k, next = first + (k + 1) % sides;
      mesh.faces.push_back({here, next + sides, next});
      mesh.faces.push_back({here, here + sides, next + sides});
    }
  }
  return mesh;
}

/// Outward, of the crack that takes most of the fragment's surface: a fragment amid others has
/// fracture surface all around. Zero where there is none.
Vec3 largest_crack_normal(const Fragment& fragment) {
  std::map<std::int32_t, Vec3> cracks;
  for (std::size_t f = 0; f < fragment.faces.size(); ++f) {
    const FragmentFace& face = fragment.faces[f];
    if (!face.is_fracture()) continue;
    const auto [crack, is_new] = cracks.try_emplace(face.interface, Vec3::Zero());
    crack->second += area_vector2(fragment.mesh, f);
  }
  Vec3 largest = Vec3::Zero();
  for (const auto& [crack, normal] : cracks) {
    if (normal.norm() > largest.norm()) largest = normal;
  }
  return largest;
}

}  // namespace

int frames_of(const Record& record) {
  int frames = 0;
  for (const Track& track : record.outcome.scene.trajectory.tracks) {
    frames = std::max(frames, track.first_frame + static_cast<int>(track.poses.size()));
  }
  return frames;
}

Picture picture_of(const Record& record, const TriangleMesh& target,
                   const RecordPictureOptions& options) {
  const SceneResult& scene = record.outcome.scene;
  const Fragments fragments = shown_fragments(record, target);
  const BoundingBox box = bounding_box(target);
  const View view{.centre = box.center(),
                  .towards = way_to_look(scene),
                  .radius = (1 + 0.7 * options.apart) * reach_of(target),  // centres move, not rims
                  .wireframe = options.wireframe};
  std::vector<DrawnMesh> meshes;
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    const Fragment& fragment = fragments[n];
    DrawnMesh drawn{.mesh = &fragment.mesh,
                    .colours = face_colours(fragment, n, options.by_surface)};
    drawn.shift = options.apart * (bounding_box(fragment.mesh).center() - box.center());
    if (options.frame) drawn.pose = pose_at(scene.trajectory, fragment, *options.frame);
    meshes.push_back(std::move(drawn));
  }
  return draw(meshes, view, options.width, options.height);
}

Picture collision_picture_of(const Record& record, const TriangleMesh& target,
                             const RecordPictureOptions& options) {
  const double reach = reach_of(target);
  const View view{.centre = bounding_box(target).center(),
                  .towards = way_to_look(record.outcome.scene),
                  .radius = 1.35 * reach,  // arrows stand beside the body
                  .wireframe = options.wireframe};
  std::vector<TriangleMesh> arrows;
  std::vector<DrawnMesh> meshes{
      {.mesh = &target, .colours = std::vector<Vec3>(target.faces.size(), kOriginal)}};
  const Impact* impact = first_impact(record.outcome.scene);
  if (impact) arrows.reserve(impact->impulses.size());
  for (std::size_t i = 0; impact && i < impact->impulses.size(); ++i) {
    const Impulse& impulse = impact->impulses[i];
    if (!(impulse.direction.norm() > 0)) continue;
    arrows.push_back(arrow(impulse.direction.normalized(), 0.5 * reach));
    meshes.push_back({.mesh = &arrows.back(),
                      .colours = std::vector<Vec3>(arrows.back().faces.size(), kArrow),
                      .shift = impulse.point});
  }
  return draw(meshes, view, options.width, options.height);
}

std::optional<std::size_t> most_cracked(const Fragments& fragments) {
  std::optional<std::size_t> most;
  double largest = 0;
  for (std::size_t n = 0; n < fragments.size(); ++n) {
    const double area = fracture_area(fragments[n]);
    if (area > largest) {
      largest = area;
      most = n;
    }
  }
  return most;
}

Picture fracture_picture_of(const Fragment& fragment, const RecordPictureOptions& options) {
  const Vec3 normal = largest_crack_normal(fragment);
  // From a little above and aside, so that steps in the surface have shades.
  const Vec3 towards =
      normal.norm() > 0 ? Vec3(-normal.normalized() + Vec3(0.15, 0.15, -0.15)) : kFromAbove;
  const View view{.centre = bounding_box(fragment.mesh).center(),
                  .towards = towards,
                  .radius = reach_of(fragment.mesh),
                  .wireframe = options.wireframe};
  return draw({{.mesh = &fragment.mesh, .colours = face_colours(fragment, 0, true)}}, view,
              options.width, options.height);
}

}  // namespace fracbench
