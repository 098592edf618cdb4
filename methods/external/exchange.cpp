#include "methods/external/exchange.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/material_json.h"
#include "geometry/pieces_of_fragments.h"
#include "geometry/read_fragments.h"
#include "geometry/tag_surfaces.h"
#include "geometry/write_mesh.h"

namespace fracbench::external {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

Json vector_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json impulses_json(const Impact& impact) {
  Json list = Json::array();
  for (const Impulse& impulse : impact.impulses) {
    list.push_back({{"point", vector_json(impulse.point)},
                    {"direction", vector_json(impulse.direction)},
                    {"magnitude", impulse.magnitude},
                    {"face", impulse.face},
                    {"normal", vector_json(impulse.normal)},
                    {"face_area", impulse.face_area}});
  }
  return list;
}

}  // namespace

void write_request(const fs::path& folder, const Target& target, const Impact& impact,
                   const Request& request) {
  write_mesh(folder / "body.obj", target.mesh);
  const Json json{{"version", kVersion},
                  {"shape", target.name},
                  {"seed", request.seed},
                  {"threads", request.threads},
                  {"settings", request.settings},
                  {"material", breaking_json(target.material)},
                  {"impulses", impulses_json(impact)},
                  {"overload", impact.overload},
                  {"time_step", impact.time_step},
                  {"velocity", vector_json(impact.body.velocity)},
                  {"angular_velocity", vector_json(impact.body.angular_velocity)}};
  write_file_atomically(folder / "request.json", json.dump(1) + "\n");
}

std::vector<Piece> read_pieces(const fs::path& folder, const TriangleMesh& body, int threads) {
  if (mesh_files(folder).empty()) {
    throw MethodFailure(
        "external: the program left no mesh in its folder; a body that stays whole is one mesh");
  }
  std::vector<TriangleMesh> meshes;
  try {
    meshes = read_fragment_meshes(folder);
  } catch (const InputError& error) {
    throw MethodFailure(fmt::format("external: {}", error.what()));
  }
  return pieces_of_fragments(tag_fragments(body, std::move(meshes), {.threads = threads}));
}

}  // namespace fracbench::external
