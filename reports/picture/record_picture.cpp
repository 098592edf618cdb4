#include "reports/picture/record_picture.h"

#include <algorithm>

#include "geometry/measures.h"
#include "geometry/palette.h"
#include "reports/scene_parts.h"

namespace fracbench {

namespace {

const Vec3 kOriginal(0.56, 0.64, 0.71);
const Vec3 kFracture(0.85, 0.51, 0.17);

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

Vec3 way_to_look(const SceneResult& scene) {
  const Impact* impact = !scene.impacts.empty() ? &scene.impacts.front()
                         : scene.unbroken       ? &*scene.unbroken
                                                : nullptr;
  Vec3 way(-0.5, -0.6, -0.45);
  if (impact && !impact->impulses.empty()) way += impact->impulses.front().direction;
  return way.norm() > 1e-6 ? way : Vec3(-1, 0, 0);
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
  double reach = 0;
  for (const Vec3& v : target.vertices) reach = std::max(reach, (v - box.center()).norm());
  View view{.centre = box.center(),
            .towards = way_to_look(scene),
            .radius = (1 + 0.7 * options.apart) * reach,  // centres move, not rims
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

}  // namespace fracbench
