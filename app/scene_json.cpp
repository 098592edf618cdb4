#include "app/scene_json.h"

#include <nlohmann/json.hpp>

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json pose_json(const Pose& pose) {
  const Vec3& p = pose.position;
  const Eigen::Quaterniond& q = pose.orientation;
  return {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
}

const char* kind_name(Track::Kind kind) {
  switch (kind) {
    case Track::Kind::target:
      return "target";
    case Track::Kind::ball:
      return "ball";
    case Track::Kind::piece:
      return "piece";
  }
  return "";
}

}  // namespace

Json impacts_json(const std::vector<Impact>& impacts) {
  Json list = Json::array();
  for (const Impact& impact : impacts) {
    Json impulses = Json::array();
    for (const Impulse& impulse : impact.impulses) {
      impulses.push_back({{"point", vector_json(impulse.point)},
                          {"direction", vector_json(impulse.direction)},
                          {"magnitude", impulse.magnitude}});
    }
    const BreakTestValues& test = impact.break_test;
    list.push_back({{"time", impact.time},
                    {"piece", impact.fragment},
                    {"overload", impact.overload},
                    {"impulses", impulses},
                    {"break_test",
                     {{"total_impulse", test.total_impulse},
                      {"balanced_force", test.balanced_force},
                      {"eq2_face_stress", test.eq2_face_stress},
                      {"eq2_patch_stress", test.eq2_patch_stress}}}});
  }
  return list;
}

Json trajectory_json(const Trajectory& trajectory) {
  Json tracks = Json::array();
  for (const Track& track : trajectory.tracks) {
    Json poses = Json::array();
    for (const Pose& pose : track.poses) poses.push_back(pose_json(pose));
    tracks.push_back({{"kind", kind_name(track.kind)},
                      {"index", track.index},
                      {"first_frame", track.first_frame},
                      {"poses", poses}});
  }
  return {{"frame", "normalized"}, {"frame_seconds", trajectory.frame_seconds}, {"tracks", tracks}};
}

}  // namespace fracbench
