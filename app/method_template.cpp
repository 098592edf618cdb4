#include "app/method_template.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "core/atomic_file.h"
#include "core/error.h"
#include "methods/registry.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

/// "plane-cutter" as the name of a file.
std::string file_of(std::string name) {
  std::ranges::replace(name, '-', '_');
  return name;
}

/// "plane-cutter" as PlaneCutterMethod.
std::string class_of(const std::string& name) {
  std::string result;
  bool upper = true;
  for (const char c : name) {
    if (c != '-')
      result += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = c == '-';
  }
  return result + "Method";
}

void require_name(const std::string& name) {
  const bool plain = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) &&
                     std::ranges::all_of(name, [](unsigned char c) {
                       return std::islower(c) || std::isdigit(c) || c == '-';
                     });
  if (!plain) {
    throw InputError(fmt::format(
        "'{}': the name of a method is made of lower-case letters, digits and hyphens, such as "
        "plane-cutter",
        name));
  }
  for (const auto& method : methods()) {
    if (method->info().name == name) throw InputError(fmt::format("there is a method '{}'", name));
  }
}

std::string filled(const fs::path& file, const std::string& name) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.empty()) throw InputError(fmt::format("{}: cannot be read", file.string()));
  for (const auto& [word, value] : {std::pair<std::string, std::string>{"@NAME@", name},
                                    {"@FILE@", file_of(name)},
                                    {"@CLASS@", class_of(name)}}) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at)) {
      text.replace(at, word.size(), value);
    }
  }
  return text;
}

}  // namespace

std::vector<fs::path> write_method_template(const fs::path& repository, const std::string& name) {
  require_name(name);
  if (!fs::exists(repository / "methods" / "registry.cpp")) {
    throw InputError(
        fmt::format("{}: is no clone of fracbench; call this in one, or name it with --repository",
                    repository.string()));
  }
  const fs::path templates = repository / "methods" / "template";
  const std::string file = file_of(name);
  const std::vector<std::pair<fs::path, fs::path>> wanted = {
      {"method.h.in", fs::path("methods") / name / (file + ".h")},
      {"method.cpp.in", fs::path("methods") / name / (file + ".cpp")},
      {"test.cpp.in", fs::path("tests") / "methods" / name / (file + "_test.cpp")},
      {"page.md.in", fs::path("docs") / "methods" / (name + ".md")}};
  for (const auto& [from, to] : wanted) {
    if (fs::exists(repository / to)) {
      throw InputError(fmt::format("{}: is there already", (repository / to).string()));
    }
  }
  std::vector<fs::path> written;
  for (const auto& [from, to] : wanted) {
    fs::create_directories((repository / to).parent_path());
    write_file_atomically(repository / to, filled(templates / from, name));
    written.push_back(to);
  }
  return written;
}

std::vector<std::string> registry_lines(const std::string& name) {
  return {fmt::format("#include \"methods/{}/{}.h\"", name, file_of(name)), class_of(name)};
}

}  // namespace fracbench
