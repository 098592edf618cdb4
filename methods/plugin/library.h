#pragma once

#include <filesystem>
#include <type_traits>

#include "methods/plugin/fracbench_plugin.h"

namespace fracbench::plugin {

/// A shared library with the functions of fracbench_plugin.h.
class Library {
 public:
  /// Throws InputError where it cannot be loaded, lacks a function, or was built against another
  /// version of the header.
  explicit Library(const std::filesystem::path& file);
  ~Library();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  std::add_pointer_t<decltype(fracbench_plugin_prepare)> prepare = nullptr;
  std::add_pointer_t<decltype(fracbench_plugin_fracture)> fracture = nullptr;
  std::add_pointer_t<decltype(fracbench_plugin_release)> release = nullptr;

 private:
  void* handle_ = nullptr;
};

}  // namespace fracbench::plugin
