#include "methods/nearest-pattern/nearest_pattern.h"

#include <fmt/format.h>

#include <limits>
#include <span>

#include "core/array_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/impulse_vector.h"
#include "geometry/pieces_of_fragments.h"

namespace fracbench {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench patterns", .version = 1, .packed = true};
constexpr const char* kFile = "patterns.fracbench";

/// A training collision: what it is compared by, and what came of it.
struct Pattern {
  std::vector<float> impulses;
  std::vector<Piece> pieces;
};

std::string digest_of(const TriangleMesh& mesh) {
  Digest digest;
  digest.add(mesh);
  return digest.hex();
}

class NearestPatternBody : public Breakable {
 public:
  NearestPatternBody(std::string body, ImpulseScaling scaling, int features,
                     std::vector<Pattern> patterns)
      : body_(std::move(body)),
        scaling_(scaling),
        features_(features),
        patterns_(std::move(patterns)) {}

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    const auto stage = context.timer.stage("prediction");
    const std::vector<float> wanted = impulse_vector(impact, scaling_, features_);
    const Pattern* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Pattern& pattern : patterns_) {
      double sum = 0;
      for (std::size_t c = 0; c < wanted.size(); ++c) {
        const double difference = static_cast<double>(wanted[c]) - pattern.impulses[c];
        sum += difference * difference;
      }
      if (sum < least) {
        least = sum;
        best = &pattern;
      }
    }
    context.note(
        fmt::format("nearest-pattern: training collision {} of {}, at a distance of {:.3f}",
                    best - patterns_.data() + 1, patterns_.size(), std::sqrt(least)));
    return best->pieces;
  }

  void save(const std::filesystem::path& folder) const override {
    ArrayFile file;
    const auto scaling = scaling_values(scaling_);
    file.reals["scaling"].assign(scaling.begin(), scaling.end());
    file.integers["features"] = {features_};
    file.texts["body"] = body_;
    auto& sizes = file.integers["pieces"];  // of each pattern
    for (const Pattern& pattern : patterns_) {
      auto& impulses = file.floats["impulses"];
      impulses.insert(impulses.end(), pattern.impulses.begin(), pattern.impulses.end());
      sizes.push_back(static_cast<std::int32_t>(pattern.pieces.size()));
      for (const Piece& piece : pattern.pieces) {
        file.integers["vertex_count"].push_back(
            static_cast<std::int32_t>(piece.mesh.vertices.size()));
        file.integers["face_count"].push_back(static_cast<std::int32_t>(piece.mesh.faces.size()));
        for (const Vec3& v : piece.mesh.vertices) {
          auto& list = file.reals["vertices"];
          list.insert(list.end(), {v.x(), v.y(), v.z()});
        }
        auto& faces = file.integers["faces"];
        for (std::size_t f = 0; f < piece.mesh.faces.size(); ++f) {
          const Face& face = piece.mesh.faces[f];
          faces.insert(faces.end(), {face[0], face[1], face[2], piece.faces[f].parent_face,
                                     piece.faces[f].neighbour});
        }
      }
    }
    write_array_file(folder / kFile, file, kKind);
  }

 private:
  std::string body_;  ///< digest of its mesh
  ImpulseScaling scaling_;
  int features_;
  std::vector<Pattern> patterns_;
};

/// Takes values from the front of a list; throws where there are not so many.
template <typename T>
std::span<const T> take(std::span<const T>& list, std::size_t count) {
  if (list.size() < count) throw InputError("its arrays do not fit");
  const std::span<const T> front = list.first(count);
  list = list.subspan(count);
  return front;
}

Piece take_piece(std::size_t vertices, std::size_t faces, std::size_t pieces,
                 std::size_t body_faces, std::span<const double>& vertex_list,
                 std::span<const std::int32_t>& face_list) {
  Piece piece;
  const auto v = take(vertex_list, 3 * vertices);
  for (std::size_t n = 0; n < v.size(); n += 3)
    piece.mesh.vertices.emplace_back(v[n], v[n + 1], v[n + 2]);
  const auto f = take(face_list, 5 * faces);
  const auto in = [](std::int32_t value, std::int32_t low, std::size_t count) {
    if (value < low || value >= static_cast<std::int64_t>(count))
      throw InputError("its indices are out of range");
    return value;
  };
  for (std::size_t n = 0; n < f.size(); n += 5) {
    piece.mesh.faces.push_back(
        {in(f[n], 0, vertices), in(f[n + 1], 0, vertices), in(f[n + 2], 0, vertices)});
    piece.faces.push_back(
        {.parent_face = in(f[n + 3], -1, body_faces), .neighbour = in(f[n + 4], -1, pieces)});
  }
  return piece;
}

std::unique_ptr<Breakable> body_of(const ArrayFile& file, const Target& target) {
  const auto reals = [&](const char* name) {
    const auto found = file.reals.find(name);
    return found == file.reals.end() ? std::span<const double>() : std::span(found->second);
  };
  const auto integers = [&](const char* name) {
    const auto found = file.integers.find(name);
    return found == file.integers.end() ? std::span<const std::int32_t>()
                                        : std::span(found->second);
  };
  const std::string body = file.texts.contains("body") ? file.texts.at("body") : "";
  if (body != digest_of(target.mesh)) throw InputError("it is not of this body");
  const auto s = reals("scaling");
  const auto features = integers("features");
  if (s.size() != kScalingValues || features.size() != 1 || features[0] < 1 || features[0] > 2) {
    throw InputError("its arrays do not fit");
  }
  const ImpulseScaling scaling = scaling_of(s.first<kScalingValues>());
  auto vertices = reals("vertices");
  auto faces = integers("faces"), vertex_count = integers("vertex_count"),
       face_count = integers("face_count");
  const auto found = file.floats.find("impulses");
  std::span<const float> impulses;
  if (found != file.floats.end()) impulses = found->second;
  std::vector<Pattern> patterns;
  for (const std::int32_t count : integers("pieces")) {
    if (count < 1) throw InputError("its arrays do not fit");
    const auto v = take(impulses, static_cast<std::size_t>(kImpulseValues * features[0]));
    Pattern pattern{.impulses = {v.begin(), v.end()}, .pieces = {}};
    for (std::int32_t n = 0; n < count; ++n) {
      const std::int32_t vertices_here = take(vertex_count, 1)[0],
                         faces_here = take(face_count, 1)[0];
      if (vertices_here < 0 || faces_here < 0) throw InputError("its arrays do not fit");
      pattern.pieces.push_back(
          take_piece(static_cast<std::size_t>(vertices_here), static_cast<std::size_t>(faces_here),
                     static_cast<std::size_t>(count), target.mesh.faces.size(), vertices, faces));
    }
    patterns.push_back(std::move(pattern));
  }
  if (patterns.empty()) throw InputError("it holds no patterns");
  return std::make_unique<NearestPatternBody>(body, scaling, features[0], std::move(patterns));
}

}  // namespace

MethodInfo NearestPatternMethod::info() const {
  MethodInfo info;
  info.name = "nearest-pattern";
  info.summary = "the fragments of the training collision with the nearest impulse, as they are";
  info.shape_type = "crack-propagation like";
  info.learns = true;
  info.quick_to_prepare = true;
  return info;
}

OptionsSchema NearestPatternMethod::options() const {
  return {{.name = "features",
           .fallback = std::int64_t{1},
           .unit = "",
           .summary = "impulses that collisions are compared by, strongest first",
           .minimum = 1,
           .maximum = 2}};
}

std::unique_ptr<Breakable> NearestPatternMethod::prepare(const Target& target,
                                                         const LearningData& learning,
                                                         const Options& options, Context&) const {
  if (learning.examples.empty()) {
    throw InputError(fmt::format(
        "nearest-pattern: there are no fractures of '{}' to learn from; the suite needs a table "
        "[learning] whose collisions break it (docs/learning-data.md)",
        target.name));
  }
  const ImpulseScaling scaling = impulse_scaling(target.mesh, learning.max_impulse);
  const int features = static_cast<int>(options.integer("features"));
  std::vector<Pattern> patterns;
  for (const LearningExample& example : learning.examples) {
    patterns.push_back({.impulses = impulse_vector(example.impact, scaling, features),
                        .pieces = pieces_of_fragments(example.fragments)});
  }
  return std::make_unique<NearestPatternBody>(digest_of(target.mesh), scaling, features,
                                              std::move(patterns));
}

std::unique_ptr<Breakable> NearestPatternMethod::load(const std::filesystem::path& folder,
                                                      const Target& target, const Options&) const {
  try {
    return body_of(read_array_file(folder / kFile, kKind), target);
  } catch (const InputError& error) {
    throw InputError(fmt::format("nearest-pattern: '{}': {}; prepare it again",
                                 (folder / kFile).string(), error.what()));
  }
}

}  // namespace fracbench
