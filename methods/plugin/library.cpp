#include "methods/plugin/library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.h"

namespace fracbench::plugin {
namespace {

template <typename Function>
Function* function_in(void* library, const char* name, const std::filesystem::path& file) {
  if (void* symbol = ::dlsym(library, name)) return reinterpret_cast<Function*>(symbol);
  throw InputError(
      fmt::format("plugin: '{}' exports no function '{}'; it needs all of fracbench_plugin.h, with "
                  "C linkage",
                  file.string(), name));
}

}  // namespace

Library::Library(const std::filesystem::path& file) {
  // A name without a slash would be looked for in the system's folders.
  handle_ = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) {
    const char* why = ::dlerror();
    throw InputError(fmt::format("plugin: the library cannot be loaded: {}", why ? why : "?"));
  }
  try {
    const auto version =
        function_in<decltype(fracbench_plugin_version)>(handle_, "fracbench_plugin_version", file);
    if (const std::int32_t built = version(); built != FRACBENCH_PLUGIN_VERSION) {
      throw InputError(fmt::format(
          "plugin: '{}' was built for version {} of fracbench_plugin.h, this program has {}; build "
          "it again",
          file.string(), built, FRACBENCH_PLUGIN_VERSION));
    }
    prepare =
        function_in<decltype(fracbench_plugin_prepare)>(handle_, "fracbench_plugin_prepare", file);
    fracture = function_in<decltype(fracbench_plugin_fracture)>(handle_,
                                                                "fracbench_plugin_fracture", file);
    release =
        function_in<decltype(fracbench_plugin_release)>(handle_, "fracbench_plugin_release", file);
  } catch (...) {
    ::dlclose(handle_);
    throw;
  }
}

Library::~Library() { ::dlclose(handle_); }

}  // namespace fracbench::plugin
