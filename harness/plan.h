#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/catalog.h"
#include "harness/suite.h"

namespace fracbench {

/// One of `count` parts of a plan, for as many machines; index from 1 on. All methods that meet the
/// same impact are in the same part.
struct Shard {
  int index = 1;
  int count = 1;
};

/// Reads "2/5". Throws InputError.
Shard parse_shard(std::string_view text);

struct PlanOptions {
  std::vector<std::string> methods = {};  ///< labels or names to keep; empty: all
  std::vector<std::string> shapes = {};   ///< labels or names to keep; empty: all
  Shard shard = {};
};

/// Whether such a list of labels or names keeps an entry; none named: all.
bool keeps(const std::vector<std::string>& wanted, const std::string& label,
           const std::string& name);

struct PlannedScenario {
  std::string name;  ///< the suite's label and that of the scene: "single-0003"
  Scenario scenario;
};

struct PlannedShape {
  std::string label;
  Shape shape;
  std::string digest;  ///< of the mesh, SHA-256
  std::vector<PlannedScenario> scenarios;
  std::string learning_digest = {};  ///< of its learning data; empty where nothing learns from it
};

/// A shape whose fractures a method learns besides those of its target.
struct LearnedWith {
  std::string label;
  std::string digest;  ///< of its learning data
};

struct PlannedMethod {
  std::string label;
  const Method* method = nullptr;
  MethodInfo info;
  Options options;
  std::string files_digest = {};  ///< of the files that the options name; empty where none
  CellLimits limits = {};
  std::vector<std::string> shapes = {};      ///< labels of those that it breaks; empty: all
  std::vector<LearnedWith> learn_with = {};  ///< by label

  bool breaks(std::string_view shape) const;
};

/// One thing to measure: a shape broken once by a method in a scene.
struct Cell {
  std::size_t shape = 0;     ///< index into Plan::shapes
  std::size_t scenario = 0;  ///< index into PlannedShape::scenarios
  std::size_t method = 0;    ///< index into Plan::methods
  int repeat = 0;
  std::uint64_t seed = 0;          ///< of the method's random numbers in this cell
  std::uint64_t prepare_seed = 0;  ///< the same for all cells that share a prepared body
  std::string key;                 ///< SHA-256 of everything that determines the result
};

/// The cells of a suite, or of the part that was asked for, in the order in which they are
/// measured: all methods on one impact, then the next shape, then the next impact, then the next
/// repeat.
struct Plan {
  Suite suite;
  std::vector<PlannedShape> shapes;
  std::vector<PlannedMethod> methods;
  std::vector<Cell> cells;
  std::size_t suite_cells = 0;  ///< of the whole suite, before anything was left out
  /// Where methods that learn find their data; no part of what determines results.
  std::filesystem::path learning_folder = {};
};

/// Version of the record's layout; part of every key.
inline constexpr int kSchemaVersion = 1;

/// Loads the shapes and derives scenes, seeds and keys. Throws InputError for shapes that are not
/// there (all of them in one message), for names in `options` that the suite does not have, and for
/// methods that learn where the suite does not say from what.
Plan make_plan(const Suite& suite, const Catalog& catalog, const PlanOptions& options = {});

}  // namespace fracbench
