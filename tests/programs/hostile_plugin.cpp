// A plug-in that does what its settings say, for the tests of the method `plugin`. Built three
// times: as it is, with another version, and without a function.

#include <cmath>
#include <string>

#include "methods/plugin/fracbench_plugin.h"

extern "C" std::int32_t fracbench_plugin_version() {
#ifdef HOSTILE_VERSION
  return FRACBENCH_PLUGIN_VERSION + 1;
#else
  return FRACBENCH_PLUGIN_VERSION;
#endif
}

extern "C" void* fracbench_plugin_prepare(const fracbench_mesh*, const fracbench_material*,
                                          const char* settings, const fracbench_host* host) {
  if (std::string(settings) == "no body") host->fail(host->handle, "I break no such body");
  return new std::string(settings);
}

#ifndef HOSTILE_WITHOUT_FRACTURE
extern "C" void fracbench_plugin_fracture(void* prepared, const fracbench_impact*,
                                          const fracbench_host* host) {
  const std::string& settings = *static_cast<const std::string*>(prepared);
  double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::int32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  fracbench_mesh mesh{4, vertices, 4, faces};
  if (settings == "nan") vertices[4] = std::nan("");
  if (settings == "index") faces[5] = 4;
  if (settings == "negative index") faces[5] = -1;
  if (settings == "counts") mesh.face_count = -1;
  if (settings == "null") mesh.vertices = nullptr;
  if (settings == "hang") {
    while (host->stopped(host->handle) == 0) {
    }
  }
  if (settings != "nothing") host->add_fragment(host->handle, &mesh);
}
#endif

extern "C" void fracbench_plugin_release(void* prepared) {
  delete static_cast<std::string*>(prepared);
}
