#include "methods/registry.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "methods/bem/bem.h"
#include "methods/cvd/cvd.h"
#include "methods/deepfracture/deepfracture.h"
#include "methods/external/external.h"
#include "methods/import/import.h"
#include "methods/modes/modes.h"
#include "methods/nearest-pattern/nearest_pattern.h"
#include "methods/plugin/plugin.h"

namespace fracbench {

namespace {

struct FolderDigest {
  std::string_view folder;
  std::string_view digest;
};

// Folders below methods/, with a digest of the sources in each and in core/ and geometry/.
constexpr FolderDigest kFolderDigests[] = {
#include "source_digests.inc"
};

// A method together with the digest of its folder, which bears its name.
class Registered : public Method {
 public:
  explicit Registered(std::unique_ptr<Method> method) : method_(std::move(method)) {
    const std::string name = method_->info().name;
    for (const auto& [folder, digest] : kFolderDigests) {
      if (folder == name) digest_ = digest;
    }
    if (digest_.empty()) throw std::logic_error("no folder methods/" + name);
  }

  MethodInfo info() const override {
    MethodInfo info = method_->info();
    info.source_digest = digest_;
    return info;
  }
  OptionsSchema options() const override { return method_->options(); }
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override {
    return method_->prepare(target, learning, options, context);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override {
    return method_->load(folder, target, options);
  }
  bool learns(const Options& options) const override { return method_->learns(options); }
  std::optional<double> learning_seconds(const Options& options, std::size_t examples,
                                         const TrainingMachine& machine) const override {
    return method_->learning_seconds(options, examples, machine);
  }
  std::vector<std::filesystem::path> files(const Options& options) const override {
    return method_->files(options);
  }
  std::vector<ValidationCase> validation() const override { return method_->validation(); }

 private:
  std::unique_ptr<Method> method_;
  std::string digest_;
};

template <typename... Methods>
std::vector<std::unique_ptr<Method>> registered() {
  std::vector<std::unique_ptr<Method>> list;
  (list.push_back(std::make_unique<Registered>(std::make_unique<Methods>())), ...);
  return list;
}

}  // namespace

const std::vector<std::unique_ptr<Method>>& methods() {
  static const std::vector<std::unique_ptr<Method>> list = registered<  //
      CvdMethod, BemMethod, ModesMethod, DeepFractureMethod, NearestPatternMethod, ExternalMethod,
      PluginMethod, ImportMethod  //
      >();
  return list;
}

const Method& find_method(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& method : methods()) {
    names.push_back(method->info().name);
    if (names.back() == name) return *method;
  }
  throw InputError(fmt::format("unknown method '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace fracbench
