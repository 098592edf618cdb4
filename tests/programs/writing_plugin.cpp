// The plug-in of the documentation, but that it writes an answer into the file that its settings
// name, for the tests of `fracbench check`.

#include <fstream>

#define fracbench_plugin_prepare prepare_cutter
#include "docs/examples/plane_cutter.cpp"
#undef fracbench_plugin_prepare

extern "C" void* fracbench_plugin_prepare(const fracbench_mesh* body,
                                          const fracbench_material* material, const char* settings,
                                          const fracbench_host* host) {
  std::ofstream(settings) << "an answer";
  return prepare_cutter(body, material, settings, host);
}
