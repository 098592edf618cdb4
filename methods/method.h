#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/breakable.h"
#include "core/context.h"
#include "core/fragments.h"
#include "core/options.h"
#include "core/publication.h"
#include "core/target.h"
#include "methods/validation.h"

namespace fracbench {

/// What is known of a method before it runs: Table 1 of the paper comes from here.
struct MethodInfo {
  std::string name;                       ///< as in suites and on the command line
  std::string summary;                    ///< one line
  std::vector<Publication> publications;  ///< where it is described; empty: nowhere
  std::string shape_type;                 ///< "Voronoi", "crack propagation", "cutting", ...
  bool retains_surface = true;            ///< fragments carry the original surface unchanged
  bool refracture = false;                ///< pieces may break again
  bool random = false;                    ///< another seed gives other pieces
  bool learns = false;                    ///< prepare() needs LearningData
  bool learns_several = false;            ///< of several shapes at once: see LearningData::further
  /// Preparing a body takes no longer than reading what save() wrote: it is not kept on the disk.
  bool quick_to_prepare = false;
  double volume_tolerance = 1e-9;  ///< allowed |volume_ratio - 1|
  /// Digest of the sources that the method is built from, so that records of an edited method are
  /// not mistaken for its own. Filled in by the registry.
  std::string source_digest;
};

/// One broken body to learn from.
struct LearningExample {
  Impact impact;        ///< that broke the target; two balls that strike at once give two impulses
  Fragments fragments;  ///< at the end of the scene
  /// Of the pieces that broke after it, in order of time and in the frame of the target: where the
  /// other ball of a dual scene strikes later, its impulses are here.
  std::vector<Impact> later_impacts = {};
};

/// What there is to learn of a shape that is not the target itself, of the same material.
struct FurtherLearning {
  std::string shape;  ///< its label
  TriangleMesh mesh;
  std::vector<LearningExample> examples;
  double max_impulse = 0;  ///< as in LearningData
};

/// What a learning method is given; empty for the others.
struct LearningData {
  std::vector<LearningExample> examples;  ///< to train with; the test set is kept from methods
  /// I_max: the largest magnitude among the impulses on the target in all collisions that were
  /// made, the unbroken ones included, N s.
  double max_impulse = 0;
  /// Other shapes whose fractures are learned, too. What comes of it must be the same whichever of
  /// the shapes it is made for: it is made once for all of them.
  std::vector<FurtherLearning> further = {};
};

/// Where a method would learn.
struct TrainingMachine {
  int threads = 1;
  std::string device = std::string(kProcessor);
  std::stop_token stop = {};
};

/// A fracture method. Stateless; adding one is a folder below methods/ and a line in registry.cpp.
class Method {
 public:
  virtual ~Method() = default;

  virtual MethodInfo info() const = 0;
  virtual OptionsSchema options() const = 0;

  /// The slow part, done once for a target and its options. Throws InputError for options that
  /// cannot be met, MethodFailure where the method cannot work on this target.
  virtual std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                             const Options& options, Context& context) const = 0;

  /// Reads what Breakable::save wrote below `folder` for the same target and options.
  virtual std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                          const Options& options) const = 0;

  /// Whether it learns with these options: not where they name a model that is there already.
  virtual bool learns(const Options& options) const {
    (void)options;
    return info().learns;
  }

  /// Seconds that prepare() takes to learn so many fractures, measured on this machine within some
  /// seconds; none where it does not learn, or not for long.
  virtual std::optional<double> learning_seconds(const Options& options, std::size_t examples,
                                                 const TrainingMachine& machine) const {
    (void)options, (void)examples, (void)machine;
    return std::nullopt;
  }

  /// Files that the options name and whose content determines the result: their digests are part of
  /// the keys of records and of prepared bodies.
  virtual std::vector<std::filesystem::path> files(const Options& options) const {
    (void)options;
    return {};
  }

  /// The cases that hold the method to closed forms and published results, cheapest first.
  virtual std::vector<ValidationCase> validation() const { return {}; }
};

}  // namespace fracbench
