#include "methods/external/external.h"

#include <fmt/format.h>

#include <sstream>
#include <system_error>

#include "core/child_process.h"
#include "core/error.h"
#include "core/temporary_folder.h"
#include "methods/external/exchange.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

struct Program {
  std::vector<std::string> interpreter;
  fs::path file;
  std::string settings;
};

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

Program program_in(const Options& options) {
  const std::string& file = options.text("program");
  if (file.empty()) {
    throw InputError(
        "external: which program breaks the body is missing, such as program = \"cutter.py\" with "
        "interpreter = \"python3\" (docs/add-a-method.md)");
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    throw InputError(fmt::format("external: there is no program '{}'", file));
  }
  // It works in a folder of its own.
  return {.interpreter = words_of(options.text("interpreter")),
          .file = fs::absolute(file),
          .settings = options.text("settings")};
}

class ExternalBody : public Breakable {
 public:
  ExternalBody(const Target& target, Program program)
      : target_(target), program_(std::move(program)) {}

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    const TemporaryWorkFolder work("external");
    const fs::path in = work.path() / "in";
    const fs::path out = work.path() / "out";
    fs::create_directories(in);
    fs::create_directories(out);
    constexpr int kBitsThatJsonKeeps = 53;
    external::write_request(in, target_, impact,
                            {.seed = context.random.bits() >> (64 - kBitsThatJsonKeeps),
                             .threads = context.threads,
                             .settings = program_.settings});
    {
      const auto stage = context.timer.stage("program");
      run(in, out, work.path(), context);
    }
    const auto stage = context.timer.stage("reading");
    return external::read_pieces(out, target_.mesh, context.threads);
  }

  void save(const fs::path&) const override {}

 private:
  void run(const fs::path& in, const fs::path& out, const fs::path& folder,
           const Context& context) const {
    std::vector<std::string> arguments = program_.interpreter;
    for (const fs::path& path : {program_.file, in, out}) arguments.push_back(path.string());
    try {
      const ChildResult result =
          run_child(arguments,
                    {.folder = folder, .stop = context.stop, .on_line = [&](std::string_view line) {
                       context.progress.update(std::string(line), 0);
                     }});
      if (!result.good()) {
        throw MethodFailure(fmt::format("external: '{}' ended {}",
                                        program_.file.filename().string(), result.describe()));
      }
    } catch (const std::system_error& error) {
      throw InputError(fmt::format("external: '{}' cannot be started: {}", arguments.front(),
                                   error.code().message()));
    }
  }

  Target target_;
  Program program_;
};

}  // namespace

MethodInfo ExternalMethod::info() const {
  MethodInfo info;
  info.name = "external";
  info.summary = "a program of yours, called with a folder in and a folder out";
  info.shape_type = "unknown";
  info.random = true;
  info.quick_to_prepare = true;
  info.volume_tolerance = 1e-3;  // programs write six digits and cut with tolerances of their own
  return info;
}

OptionsSchema ExternalMethod::options() const {
  return {{.name = "program",
           .fallback = std::string(),
           .unit = "",
           .summary = "the program's file; what is in it is part of what determines a result"},
          {.name = "interpreter",
           .fallback = std::string(),
           .unit = "",
           .summary = "what runs it, such as python3; empty: the file itself can be run"},
          {.name = "settings",
           .fallback = std::string(),
           .unit = "",
           .summary = "passed on to the program as it is"}};
}

std::unique_ptr<Breakable> ExternalMethod::prepare(const Target& target, const LearningData&,
                                                   const Options& options, Context&) const {
  return std::make_unique<ExternalBody>(target, program_in(options));
}

std::unique_ptr<Breakable> ExternalMethod::load(const fs::path&, const Target& target,
                                                const Options& options) const {
  return std::make_unique<ExternalBody>(target, program_in(options));
}

std::vector<fs::path> ExternalMethod::files(const Options& options) const {
  const std::string& file = options.text("program");
  if (file.empty()) return {};
  return {file};
}

}  // namespace fracbench
