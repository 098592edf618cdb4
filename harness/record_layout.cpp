#include "harness/record_layout.h"

#include <fmt/format.h>

#include <algorithm>

namespace fracbench {

namespace {

using Reals = std::vector<double>;
using Integers = std::vector<std::int32_t>;
using Starts = std::vector<std::uint64_t>;

void append(Reals& list, const Vec3& v) { list.insert(list.end(), {v.x(), v.y(), v.z()}); }

void append(Reals& list, const Pose& pose) {
  append(list, pose.position);
  const auto& q = pose.orientation;
  list.insert(list.end(), {q.w(), q.x(), q.y(), q.z()});
}

Vec3 vector_at(const Reals& list, std::size_t index) {
  return {list[index], list[index + 1], list[index + 2]};
}

Pose pose_at(const Reals& list, std::size_t index) {
  Pose pose;
  pose.position = vector_at(list, index);
  pose.orientation.w() = list[index + 3];
  pose.orientation.vec() = vector_at(list, index + 4);
  return pose;
}

void require(bool good, const std::string& prefix) {
  if (!good) throw DataError(fmt::format("the arrays below '{}' do not fit each other", prefix));
}

/// Starts of the parts of a list of `size` values; checked to be just that.
Starts get_starts(const DataTree& tree, const std::string& path, std::size_t size) {
  Starts starts = tree.words(path);
  const bool good = !starts.empty() && starts.front() == 0 && starts.back() == size &&
                    std::ranges::is_sorted(starts);
  require(good, path);
  return starts;
}

void append_mesh(const TriangleMesh& mesh, Reals& vertices, Integers& faces) {
  for (const Vec3& v : mesh.vertices) append(vertices, v);
  for (const Face& f : mesh.faces) faces.insert(faces.end(), f.begin(), f.end());
}

/// A range of rows.
struct Rows {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

TriangleMesh mesh_from(const Reals& vertices, Rows vertex_rows, const Integers& faces,
                       Rows face_rows, const std::string& prefix) {
  TriangleMesh mesh;
  for (auto i = vertex_rows.begin; i < vertex_rows.end; ++i) {
    mesh.vertices.push_back(vector_at(vertices, 3 * i));
  }
  for (auto i = face_rows.begin; i < face_rows.end; ++i) {
    mesh.faces.push_back({faces[3 * i], faces[3 * i + 1], faces[3 * i + 2]});
    for (const std::int32_t index : mesh.faces.back()) {
      require(index >= 0 && static_cast<std::size_t>(index) < mesh.vertices.size(), prefix);
    }
  }
  return mesh;
}

}  // namespace

void put_mesh(DataTree& tree, const std::string& prefix, const TriangleMesh& mesh) {
  Reals vertices;
  Integers faces;
  append_mesh(mesh, vertices, faces);
  tree.put(prefix + "/vertices", vertices, 3);
  tree.put(prefix + "/faces", faces, 3);
}

TriangleMesh get_mesh(const DataTree& tree, const std::string& prefix) {
  const Reals vertices = tree.reals(prefix + "/vertices", 3);
  const Integers faces = tree.integers(prefix + "/faces", 3);
  return mesh_from(vertices, {0, vertices.size() / 3}, faces, {0, faces.size() / 3}, prefix);
}

void put_fragments(DataTree& tree, const std::string& prefix, const Fragments& fragments) {
  Reals vertices;
  Integers faces, original, interface, piece, parent, generation;
  Starts vertex_start = {0}, face_start = {0};
  for (const Fragment& fragment : fragments) {
    append_mesh(fragment.mesh, vertices, faces);
    for (const FragmentFace& face : fragment.faces) {
      original.push_back(face.original_face);
      interface.push_back(face.interface);
    }
    vertex_start.push_back(vertices.size() / 3);
    face_start.push_back(faces.size() / 3);
    piece.push_back(fragment.piece);
    parent.push_back(fragment.parent);
    generation.push_back(fragment.generation);
  }
  tree.put(prefix + "/vertices", vertices, 3);
  tree.put(prefix + "/faces", faces, 3);
  tree.put(prefix + "/face_original", original);
  tree.put(prefix + "/face_interface", interface);
  tree.put(prefix + "/vertex_start", vertex_start);
  tree.put(prefix + "/face_start", face_start);
  tree.put(prefix + "/piece", piece);
  tree.put(prefix + "/parent", parent);
  tree.put(prefix + "/generation", generation);
}

Fragments get_fragments(const DataTree& tree, const std::string& prefix) {
  const Reals vertices = tree.reals(prefix + "/vertices", 3);
  const Integers faces = tree.integers(prefix + "/faces", 3);
  const Integers original = tree.integers(prefix + "/face_original");
  const Integers interface = tree.integers(prefix + "/face_interface");
  const Starts vertex_start = get_starts(tree, prefix + "/vertex_start", vertices.size() / 3);
  const Starts face_start = get_starts(tree, prefix + "/face_start", faces.size() / 3);
  const Integers piece = tree.integers(prefix + "/piece");
  const Integers parent = tree.integers(prefix + "/parent");
  const Integers generation = tree.integers(prefix + "/generation");
  require(original.size() == faces.size() / 3 && interface.size() == original.size() &&
              face_start.size() == vertex_start.size() && piece.size() + 1 == face_start.size() &&
              parent.size() == piece.size() && generation.size() == piece.size(),
          prefix);
  Fragments fragments(piece.size());
  for (std::size_t f = 0; f < fragments.size(); ++f) {
    Fragment& fragment = fragments[f];
    const Rows face_rows{face_start[f], face_start[f + 1]};
    fragment.mesh =
        mesh_from(vertices, {vertex_start[f], vertex_start[f + 1]}, faces, face_rows, prefix);
    for (auto i = face_rows.begin; i < face_rows.end; ++i) {
      fragment.faces.push_back({original[i], interface[i]});
    }
    fragment.piece = piece[f];
    fragment.parent = parent[f];
    fragment.generation = generation[f];
  }
  return fragments;
}

void put_impacts(DataTree& tree, const std::string& prefix, const std::vector<Impact>& impacts) {
  Reals time, time_step, body, break_test, overload, point, direction, magnitude, normal, area,
      striker;
  Integers fragment, face;
  Starts start = {0};
  for (const Impact& impact : impacts) {
    require(impact.strikers.size() == impact.impulses.size(), prefix);
    time.push_back(impact.time);
    time_step.push_back(impact.time_step);
    fragment.push_back(impact.fragment);
    append(body, impact.body.pose);
    append(body, impact.body.velocity);
    append(body, impact.body.angular_velocity);
    const BreakTestValues& test = impact.break_test;
    break_test.insert(break_test.end(), {test.total_impulse, test.balanced_force,
                                         test.eq2_face_stress, test.eq2_patch_stress});
    overload.push_back(impact.overload);
    for (const Impulse& impulse : impact.impulses) {
      append(point, impulse.point);
      append(direction, impulse.direction);
      magnitude.push_back(impulse.magnitude);
      face.push_back(impulse.face);
      append(normal, impulse.normal);
      area.push_back(impulse.face_area);
    }
    for (const Striker& s : impact.strikers) {
      striker.insert(striker.end(), {s.mass, s.radius, s.young_modulus, s.poisson_ratio});
      append(striker, s.velocity);
    }
    start.push_back(magnitude.size());
  }
  tree.put(prefix + "/time", time);
  tree.put(prefix + "/time_step", time_step);
  tree.put(prefix + "/fragment", fragment);
  tree.put(prefix + "/body", body, 13);
  tree.put(prefix + "/break_test", break_test, 4);
  tree.put(prefix + "/overload", overload);
  tree.put(prefix + "/impulse_start", start);
  tree.put(prefix + "/impulse_point", point, 3);
  tree.put(prefix + "/impulse_direction", direction, 3);
  tree.put(prefix + "/impulse_magnitude", magnitude);
  tree.put(prefix + "/impulse_face", face);
  tree.put(prefix + "/impulse_normal", normal, 3);
  tree.put(prefix + "/impulse_face_area", area);
  tree.put(prefix + "/striker", striker, 7);
}

std::vector<Impact> get_impacts(const DataTree& tree, const std::string& prefix) {
  const Reals time = tree.reals(prefix + "/time");
  const Reals time_step = tree.reals(prefix + "/time_step");
  const Integers fragment = tree.integers(prefix + "/fragment");
  const Reals body = tree.reals(prefix + "/body", 13);
  const Reals break_test = tree.reals(prefix + "/break_test", 4);
  // Records of earlier programs lack it.
  const Reals overload =
      tree.has(prefix + "/overload") ? tree.reals(prefix + "/overload") : Reals(time.size(), 0.0);
  const Reals point = tree.reals(prefix + "/impulse_point", 3);
  const Reals direction = tree.reals(prefix + "/impulse_direction", 3);
  const Reals magnitude = tree.reals(prefix + "/impulse_magnitude");
  const Integers face = tree.integers(prefix + "/impulse_face");
  const Reals normal = tree.reals(prefix + "/impulse_normal", 3);
  const Reals area = tree.reals(prefix + "/impulse_face_area");
  const Reals striker = tree.reals(prefix + "/striker", 7);
  const Starts start = get_starts(tree, prefix + "/impulse_start", magnitude.size());
  const std::size_t n = time.size();
  const std::size_t m = magnitude.size();
  require(time_step.size() == n && fragment.size() == n && body.size() == 13 * n &&
              break_test.size() == 4 * n && overload.size() == n && start.size() == n + 1 &&
              point.size() == 3 * m && direction.size() == 3 * m && face.size() == m &&
              normal.size() == 3 * m && area.size() == m && striker.size() == 7 * m,
          prefix);
  std::vector<Impact> impacts(n);
  for (std::size_t k = 0; k < n; ++k) {
    Impact& impact = impacts[k];
    impact.time = time[k];
    impact.time_step = time_step[k];
    impact.fragment = fragment[k];
    impact.body.pose = pose_at(body, 13 * k);
    impact.body.velocity = vector_at(body, 13 * k + 7);
    impact.body.angular_velocity = vector_at(body, 13 * k + 10);
    const double* test = &break_test[4 * k];
    impact.break_test = {test[0], test[1], test[2], test[3]};
    impact.overload = overload[k];
    for (std::size_t i = start[k]; i < start[k + 1]; ++i) {
      impact.impulses.push_back({vector_at(point, 3 * i), vector_at(direction, 3 * i), magnitude[i],
                                 face[i], vector_at(normal, 3 * i), area[i]});
      const double* s = &striker[7 * i];
      impact.strikers.push_back({s[0], s[1], s[2], s[3], vector_at(striker, 7 * i + 4)});
    }
  }
  return impacts;
}

void put_trajectory(DataTree& tree, const std::string& prefix, const Trajectory& trajectory) {
  Integers kind, index, first_frame;
  Starts start = {0};
  Reals poses;
  for (const Track& track : trajectory.tracks) {
    kind.push_back(static_cast<std::int32_t>(track.kind));
    index.push_back(track.index);
    first_frame.push_back(track.first_frame);
    for (const Pose& pose : track.poses) append(poses, pose);
    start.push_back(poses.size() / 7);
  }
  tree.put(prefix + "/frame_seconds", trajectory.frame_seconds);
  tree.put(prefix + "/kind", kind);
  tree.put(prefix + "/index", index);
  tree.put(prefix + "/first_frame", first_frame);
  tree.put(prefix + "/pose_start", start);
  tree.put(prefix + "/poses", poses, 7);
}

Trajectory get_trajectory(const DataTree& tree, const std::string& prefix) {
  const Integers kind = tree.integers(prefix + "/kind");
  const Integers index = tree.integers(prefix + "/index");
  const Integers first_frame = tree.integers(prefix + "/first_frame");
  const Reals poses = tree.reals(prefix + "/poses", 7);
  const Starts start = get_starts(tree, prefix + "/pose_start", poses.size() / 7);
  require(index.size() == kind.size() && first_frame.size() == kind.size() &&
              start.size() == kind.size() + 1,
          prefix);
  Trajectory trajectory{.frame_seconds = tree.real(prefix + "/frame_seconds"), .tracks = {}};
  for (std::size_t k = 0; k < kind.size(); ++k) {
    require(kind[k] >= 0 && kind[k] <= static_cast<std::int32_t>(Track::Kind::piece), prefix);
    Track track{static_cast<Track::Kind>(kind[k]), index[k], first_frame[k], {}};
    for (std::size_t i = start[k]; i < start[k + 1]; ++i) {
      track.poses.push_back(pose_at(poses, 7 * i));
    }
    trajectory.tracks.push_back(std::move(track));
  }
  return trajectory;
}

void put_replacements(DataTree& tree, const std::string& path,
                      const std::vector<Replacement>& replacements) {
  Reals rows;
  for (const Replacement& r : replacements) {
    rows.insert(rows.end(), {r.time, r.momentum_error, r.angular_momentum_error, r.energy_ratio});
  }
  tree.put(path, rows, 4);
}

std::vector<Replacement> get_replacements(const DataTree& tree, const std::string& path) {
  const Reals rows = tree.reals(path, 4);
  std::vector<Replacement> result;
  for (std::size_t i = 0; i < rows.size(); i += 4) {
    result.push_back({rows[i], rows[i + 1], rows[i + 2], rows[i + 3]});
  }
  return result;
}

void put_measurement(DataTree& tree, const std::string& prefix, const Measurement& measurement) {
  std::vector<std::string> names, units, series_names, series_units;
  Reals values, series_values;
  Starts start = {0};
  for (const MetricValue& value : measurement.values) {
    names.push_back(value.name);
    units.push_back(value.unit);
    values.push_back(value.value);
  }
  for (const MetricSeries& series : measurement.series) {
    series_names.push_back(series.name);
    series_units.push_back(series.unit);
    series_values.insert(series_values.end(), series.values.begin(), series.values.end());
    start.push_back(series_values.size());
  }
  tree.put(prefix + "/names", names);
  tree.put(prefix + "/units", units);
  tree.put(prefix + "/values", values);
  tree.put(prefix + "/series_names", series_names);
  tree.put(prefix + "/series_units", series_units);
  tree.put(prefix + "/series_start", start);
  tree.put(prefix + "/series_values", series_values);
}

Measurement get_measurement(const DataTree& tree, const std::string& prefix) {
  const auto names = tree.texts(prefix + "/names");
  const auto units = tree.texts(prefix + "/units");
  const Reals values = tree.reals(prefix + "/values");
  const auto series_names = tree.texts(prefix + "/series_names");
  const auto series_units = tree.texts(prefix + "/series_units");
  const Reals series_values = tree.reals(prefix + "/series_values");
  const Starts start = get_starts(tree, prefix + "/series_start", series_values.size());
  require(units.size() == names.size() && values.size() == names.size() &&
              series_units.size() == series_names.size() && start.size() == series_names.size() + 1,
          prefix);
  Measurement measurement;
  for (std::size_t i = 0; i < names.size(); ++i) {
    measurement.values.push_back({names[i], values[i], units[i]});
  }
  for (std::size_t i = 0; i < series_names.size(); ++i) {
    const auto first = series_values.begin();
    measurement.series.push_back({series_names[i],
                                  {first + static_cast<std::ptrdiff_t>(start[i]),
                                   first + static_cast<std::ptrdiff_t>(start[i + 1])},
                                  series_units[i]});
  }
  return measurement;
}

}  // namespace fracbench
