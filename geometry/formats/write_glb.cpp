#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "geometry/formats/shading_normals.h"
#include "geometry/formats/writers.h"
#include "geometry/palette.h"

namespace fracbench::formats {

namespace {

using Json = nlohmann::ordered_json;

// Constants of the glTF 2.0 specification, sections 3.6, 5.1 and 4.4.
constexpr int float_components = 5126, uint32_components = 5125;
constexpr int vertex_buffer = 34962, index_buffer = 34963;
constexpr std::uint32_t magic = 0x46546C67, version = 2;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

class GlbBuilder {
 public:
  void add(const Part& part, std::size_t index) {
    std::vector<std::int32_t> original, fracture;
    for (std::size_t f = 0; f < part.mesh->faces.size(); ++f) {
      const bool is_fracture = f < part.fracture.size() && part.fracture[f];
      (is_fracture ? fracture : original).push_back(static_cast<std::int32_t>(f));
    }
    Json primitives = Json::array();
    if (!original.empty()) {
      const int material = add_material(part.name, fragment_color(index), 0.55);
      primitives.push_back(add_primitive(smooth_shaded(*part.mesh, original), material));
    }
    if (!fracture.empty()) {
      if (fracture_material_ < 0) {
        fracture_material_ = add_material("fracture surface", fracture_color(), 0.9);
      }
      primitives.push_back(add_primitive(flat_shaded(*part.mesh, fracture), fracture_material_));
    }
    Json node = {{"name", part.name}};
    if (!primitives.empty()) {
      node["mesh"] = meshes_.size();
      meshes_.push_back({{"name", part.name}, {"primitives", std::move(primitives)}});
    }
    scene_.push_back(nodes_.size());
    nodes_.push_back(std::move(node));
    if (!part.motion.seconds.empty()) moving_.push_back({nodes_.size() - 1, &part.motion});
  }

  /// After the last part: the animation of those that move.
  void animate() {
    float begin = std::numeric_limits<float>::infinity();
    float end = -begin;
    for (const auto& [node, motion] : moving_) {
      begin = std::min(begin, motion->seconds.front());
      end = std::max(end, motion->seconds.back());
    }
    for (const auto& [node, motion] : moving_) {
      const std::size_t times = add_times(motion->seconds);
      std::vector<Eigen::Vector3f> places;
      std::vector<Eigen::Vector4f> turns;
      for (const Pose& pose : motion->poses) {
        places.push_back(pose.position.cast<float>());
        Eigen::Vector4f turn = pose.orientation.coeffs().cast<float>().normalized();
        // Of the two signs the one nearer to the last turn: viewers go straight from one to the
        // next.
        if (!turns.empty() && turn.dot(turns.back()) < 0) turn = -turn;
        turns.push_back(turn);
      }
      add_channel(node, "translation", times, add_vectors(places, false, 0), "LINEAR");
      add_channel(node, "rotation", times, add_turns(turns), "LINEAR");
      std::vector<float> changes;
      std::vector<Eigen::Vector3f> scales;
      const auto show = [&](float when, float size) {
        changes.push_back(when);
        scales.push_back(Eigen::Vector3f::Constant(size));
      };
      if (motion->seconds.front() > begin) show(begin, 0);
      show(motion->seconds.front(), 1);
      if (motion->seconds.back() < end) show(after(motion->seconds), 0);
      add_channel(node, "scale", add_times(changes), add_vectors(scales, false, 0), "STEP");
    }
  }

  std::string bytes() const {
    Json root = {{"asset", {{"version", "2.0"}, {"generator", "fracbench"}}}};
    if (!nodes_.empty()) {
      root["scene"] = 0;
      root["scenes"] = Json::array({{{"nodes", scene_}}});
      root["nodes"] = nodes_;
    }
    if (!meshes_.empty()) {
      if (!channels_.empty()) {
        root["animations"] =
            Json::array({{{"name", "motion"}, {"channels", channels_}, {"samplers", samplers_}}});
      }
      root["meshes"] = meshes_;
      root["materials"] = materials_;
      root["accessors"] = accessors_;
      root["bufferViews"] = views_;
      root["buffers"] = Json::array({{{"byteLength", data_.size()}}});
    }
    std::string json = root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + json.size() + (data_.empty() ? 0 : 8 + data_.size());
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      throw InputError("the mesh is too large for a glTF file (4 GiB at most); write PLY instead");
    }
    std::string file;
    file.reserve(total);
    const auto append = [&](std::size_t value) {
      const auto word = static_cast<std::uint32_t>(value);
      char raw[4];
      std::memcpy(raw, &word, 4);
      file.append(raw, 4);
    };
    append(magic);
    append(version);
    append(total);
    append(json.size());
    append(json_chunk);
    file += json;
    if (!data_.empty()) {
      append(data_.size());
      append(binary_chunk);
      file += data_;
    }
    return file;
  }

 private:
  /// When a part is gone: a frame after its last pose.
  static float after(const std::vector<float>& seconds) {
    const std::size_t n = seconds.size();
    return seconds.back() + (n > 1 ? seconds[n - 1] - seconds[n - 2] : 0.01F);
  }

  int add_material(const std::string& name, const Vec3& srgb, double roughness) {
    const Vec3 color = linear_color(srgb);
    materials_.push_back({{"name", name},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {color[0], color[1], color[2], 1.0}},
                            {"metallicFactor", 0.0},
                            {"roughnessFactor", roughness}}}});
    return static_cast<int>(materials_.size()) - 1;
  }

  /// `target` 0: not for drawing.
  std::size_t add_view(const void* data, std::size_t size, int target) {
    views_.push_back({{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", size}});
    if (target != 0) views_.back()["target"] = target;
    data_.append(static_cast<const char*>(data), size);  // always a multiple of four
    return views_.size() - 1;
  }

  std::size_t add_times(const std::vector<float>& seconds) {
    accessors_.push_back({{"bufferView", add_view(seconds.data(), 4 * seconds.size(), 0)},
                          {"componentType", float_components},
                          {"count", seconds.size()},
                          {"type", "SCALAR"},
                          {"min", {seconds.front()}},
                          {"max", {seconds.back()}}});
    return accessors_.size() - 1;
  }

  std::size_t add_turns(const std::vector<Eigen::Vector4f>& turns) {
    static_assert(sizeof(Eigen::Vector4f) == 16);
    accessors_.push_back({{"bufferView", add_view(turns.data(), 16 * turns.size(), 0)},
                          {"componentType", float_components},
                          {"count", turns.size()},
                          {"type", "VEC4"}});
    return accessors_.size() - 1;
  }

  void add_channel(std::size_t node, const char* path, std::size_t times, std::size_t values,
                   const char* interpolation) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", times}, {"output", values}, {"interpolation", interpolation}});
  }

  std::size_t add_vectors(const std::vector<Eigen::Vector3f>& vectors, bool with_bounds,
                          int target = vertex_buffer) {
    static_assert(sizeof(Eigen::Vector3f) == 12);
    Json accessor = {{"bufferView", add_view(vectors.data(), 12 * vectors.size(), target)},
                     {"componentType", float_components},
                     {"count", vectors.size()},
                     {"type", "VEC3"}};
    if (with_bounds) {
      Eigen::Vector3f low = vectors[0], high = vectors[0];
      for (const Eigen::Vector3f& v : vectors) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      accessor["min"] = {low[0], low[1], low[2]};
      accessor["max"] = {high[0], high[1], high[2]};
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
  }

  Json add_primitive(const ShadedFaces& shaded, int material) {
    const std::size_t position = add_vectors(shaded.positions, true);
    const std::size_t normal = add_vectors(shaded.normals, false);
    accessors_.push_back(
        {{"bufferView", add_view(shaded.indices.data(), 4 * shaded.indices.size(), index_buffer)},
         {"componentType", uint32_components},
         {"count", shaded.indices.size()},
         {"type", "SCALAR"}});
    return {{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
            {"indices", accessors_.size() - 1},
            {"material", material}};
  }

  Json scene_ = Json::array(), nodes_ = Json::array(), meshes_ = Json::array(),
       materials_ = Json::array(), accessors_ = Json::array(), views_ = Json::array(),
       channels_ = Json::array(), samplers_ = Json::array();
  std::vector<std::pair<std::size_t, const Motion*>> moving_;  // nodes
  std::string data_;
  int fracture_material_ = -1;
};

}  // namespace

std::string glb_bytes(std::span<const Part> parts) {
  GlbBuilder builder;
  for (std::size_t p = 0; p < parts.size(); ++p) builder.add(parts[p], p);
  builder.animate();
  return builder.bytes();
}

}  // namespace fracbench::formats
