#include "methods/bem/body_files.h"

#include <fmt/format.h>

#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "geometry/measures.h"

namespace fracbench::bem {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr const char* kFile = "bem.json";

std::string digest_of(const Target& body, const Settings& s) {
  Digest digest;
  digest.add(body.mesh);
  const Material& m = body.material;
  for (const double value : {m.young_modulus,
                             m.poisson_ratio,
                             m.density,
                             m.strength,
                             m.toughness,
                             m.compressive_factor,
                             s.voxel,
                             s.crack_mesh,
                             s.strength.weibull_modulus,
                             s.strength.correlation_length,
                             s.strength.direction.x(),
                             s.strength.direction.y(),
                             s.strength.direction.z(),
                             s.strength.thickness,
                             s.strength.grain_size,
                             s.strength.boundary_width,
                             s.strength.ratio,
                             s.smallest_fragment,
                             s.smallest_voxels,
                             s.hull_volume,
                             s.refracture_volume}) {
    digest.add(value);
  }
  for (const int value : {s.triangles, s.max_cracks, static_cast<int>(s.mode),
                          static_cast<int>(s.calibrated), static_cast<int>(s.balance),
                          static_cast<int>(s.strength.kind), static_cast<int>(s.parity)}) {
    digest.add(static_cast<std::uint64_t>(value));
  }
  return digest.hex();
}

Json to_json(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Vec3 vec3_from(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Json to_json(const TriangleMesh& mesh) {
  Json vertices = Json::array();
  for (const Vec3& v : mesh.vertices) vertices.push_back(to_json(v));
  return {{"vertices", vertices}, {"faces", mesh.faces}};
}

TriangleMesh mesh_from(const Json& json) {
  TriangleMesh mesh;
  for (const Json& v : json.at("vertices")) mesh.vertices.push_back(vec3_from(v));
  mesh.faces = json.at("faces").get<std::vector<Face>>();
  const auto count = static_cast<std::int32_t>(mesh.vertices.size());
  for (const Face& face : mesh.faces) {
    for (const std::int32_t v : face) {
      if (v < 0 || v >= count) throw InputError("a face has a vertex that is not there");
    }
  }
  return mesh;
}

Json to_json(const Crack& crack) {
  Json states = Json::array(), front = Json::array();
  for (const FrontState s : crack.sheet.states) states.push_back(static_cast<int>(s));
  for (const FrontMarker& m : crack.front) {
    front.push_back({{"position", to_json(m.position)},
                     {"forward", to_json(m.forward)},
                     {"normal", to_json(m.normal)},
                     {"speed", m.speed},
                     {"turn", m.turn},
                     {"state", static_cast<int>(m.state)},
                     {"vertex", m.vertex},
                     {"coarse", m.coarse}});
  }
  return {{"sheet", to_json(crack.sheet.mesh)},
          {"boundary", crack.sheet.boundary},
          {"states", states},
          {"surface", to_json(crack.surface)},
          {"front", front}};
}

FrontState state_from(const Json& json) {
  const int value = json.get<int>();
  if (value < 0 || value > static_cast<int>(FrontState::at_crack)) {
    throw InputError("a front has a state that is not known");
  }
  return static_cast<FrontState>(value);
}

Crack crack_from(const Json& json) {
  Crack crack;
  crack.sheet.mesh = mesh_from(json.at("sheet"));
  crack.sheet.boundary = json.at("boundary").get<std::vector<std::int32_t>>();
  for (const Json& s : json.at("states")) crack.sheet.states.push_back(state_from(s));
  crack.surface = mesh_from(json.at("surface"));
  for (const Json& m : json.at("front")) {
    FrontMarker marker;
    marker.position = vec3_from(m.at("position"));
    marker.forward = vec3_from(m.at("forward"));
    marker.normal = vec3_from(m.at("normal"));
    marker.speed = m.at("speed").get<double>();
    marker.turn = m.at("turn").get<double>();
    marker.state = state_from(m.at("state"));
    marker.vertex = m.at("vertex").get<std::int32_t>();
    marker.coarse = m.at("coarse").get<std::int32_t>();
    crack.front.push_back(marker);
  }
  return crack;
}

}  // namespace

void write_body(const std::filesystem::path& folder, const BodyState& state) {
  Json json;
  json["version"] = kVersion;
  json["digest"] = digest_of(state.body, state.settings);
  json["target_volume"] = state.target_volume;
  json["target_area"] = state.target_area;
  json["is_piece"] = state.is_piece;
  json["strength_seed"] = state.strength_seed;
  json["elements"] = state.elements ? to_json(*state.elements) : Json();
  json["cracks"] = Json::array();
  for (const Crack& crack : state.cracks) json["cracks"].push_back(to_json(crack));
  write_file_atomically(folder / kFile, json.dump());
}

BodyState read_body(const std::filesystem::path& folder, const Target& target,
                    const Settings& settings) {
  const std::filesystem::path path = folder / kFile;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path.string() + ": cannot be read; prepare the body again");
  try {
    const Json json = Json::parse(file);
    if (json.at("version").get<int>() != kVersion) {
      throw InputError(fmt::format("version {}, known is {}", json.at("version").dump(), kVersion));
    }
    BodyState state{.settings = settings,
                    .body = target,
                    .target_volume = json.at("target_volume").get<double>(),
                    .target_area = json.at("target_area").get<double>(),
                    .is_piece = json.at("is_piece").get<bool>(),
                    .strength_seed = json.at("strength_seed").get<std::uint64_t>()};
    if (json.at("digest").get<std::string>() != digest_of(target, settings)) {
      throw InputError("it is of another mesh, material or other options");
    }
    if (!json.at("elements").is_null()) state.elements = mesh_from(json.at("elements"));
    for (const Json& crack : json.at("cracks")) state.cracks.push_back(crack_from(crack));
    return state;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}; prepare the body again", path.string(), error.what()));
  } catch (const nlohmann::json::exception& error) {
    throw InputError(
        fmt::format("{}: damaged ({}); prepare the body again", path.string(), error.what()));
  }
}

}  // namespace fracbench::bem
