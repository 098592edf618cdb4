#include "harness/learning_set.h"

#include <fmt/format.h>

#include "core/digest.h"
#include "core/error.h"
#include "harness/data_file.h"
#include "harness/record.h"
#include "harness/record_layout.h"

namespace fracbench {

namespace {

LearningExample load_example(const std::filesystem::path& folder, const LearningRecord& record) {
  const std::filesystem::path file = folder / "records" / fmt::format("{}.h5", record.key);
  try {
    const DataTree tree = read_hdf5(file);
    Record whole = to_record(tree);
    if (whole.key != record.key) throw DataError("is the record of another cell");
    if (tree.text("result_digest") != record.result_digest) {
      throw DataError("is not the record that learning.json was made from");
    }
    std::vector<Impact>& impacts = whole.outcome.scene.impacts;
    if (impacts.empty()) throw DataError("holds no impact");
    LearningExample example{.impact = std::move(impacts.front()),
                            .fragments = std::move(whole.outcome.scene.fragments)};
    impacts.erase(impacts.begin());
    example.later_impacts = std::move(impacts);
    return example;
  } catch (const DataError& error) {
    throw DataError(
        fmt::format("{}: {}; fracbench prepare makes it anew", file.string(), error.what()));
  }
}

std::vector<LearningExample> load_examples(const std::filesystem::path& folder,
                                           const LearningShape& shape, LearningRole role) {
  std::vector<LearningExample> examples;
  examples.reserve(shape.count(role));
  for (const LearningRecord& record : shape.records) {
    if (record.role == role) examples.push_back(load_example(folder, record));
  }
  return examples;
}

TriangleMesh load_mesh(const std::filesystem::path& folder, const LearningShape& shape) {
  const std::filesystem::path file = folder / "shapes" / (shape.mesh_digest + ".h5");
  TriangleMesh mesh = get_mesh(read_hdf5(file), "mesh");
  Digest digest;
  digest.add(mesh);
  if (digest.hex() != shape.mesh_digest) {
    throw DataError(fmt::format(
        "{}: is damaged; fracbench prepare makes it anew once it is removed", file.string()));
  }
  return mesh;
}

/// The shape of a folder's index whose data is that of the digest.
LearningShape learned_shape(const std::filesystem::path& folder, std::string_view label,
                            std::string_view digest) {
  const LearningIndex index = read_learning_index(folder);
  const LearningShape& shape = index.shape(label, folder.string());
  if (shape.digest != digest) {
    throw InputError(
        fmt::format("{}: the learning data of shape '{}' was made by other values of the suite or "
                    "other sources of the program; make it anew with fracbench prepare",
                    folder.string(), label));
  }
  return shape;
}

/// For who is told what to do about damaged data.
template <typename Load>
auto as_input(const Load& load) {
  try {
    return load();
  } catch (const DataError& error) {
    throw InputError(error.what());
  }
}

}  // namespace

LearningShapeSet load_learning_shape(const std::filesystem::path& folder,
                                     const LearningShape& shape) {
  return {.label = shape.label,
          .mesh = load_mesh(folder, shape),
          .train = load_examples(folder, shape, LearningRole::train),
          .test = load_examples(folder, shape, LearningRole::test),
          .max_impulse = shape.max_impulse,
          .spare = shape.count(LearningRole::spare),
          .unbroken = shape.count(LearningRole::unbroken),
          .failed = shape.count(LearningRole::failed),
          .digest = shape.digest};
}

LearningSet load_learning_set(const std::filesystem::path& folder) {
  const LearningIndex index = read_learning_index(folder);
  LearningSet set{.suite = index.suite,
                  .method = index.method,
                  .method_options = index.method_options,
                  .family = index.family,
                  .shapes = {}};
  for (const LearningShape& shape : index.shapes) {
    set.shapes.push_back(load_learning_shape(folder, shape));
  }
  return set;
}

LearningData load_learning_data(const std::filesystem::path& folder, std::string_view label,
                                std::string_view digest) {
  const LearningShape shape = learned_shape(folder, label, digest);
  return as_input([&]() -> LearningData {
    return {.examples = load_examples(folder, shape, LearningRole::train),
            .max_impulse = shape.max_impulse};
  });
}

FurtherLearning load_further_learning(const std::filesystem::path& folder, std::string_view label,
                                      std::string_view digest) {
  const LearningShape shape = learned_shape(folder, label, digest);
  return as_input([&]() -> FurtherLearning {
    return {.shape = shape.label,
            .mesh = load_mesh(folder, shape),
            .examples = load_examples(folder, shape, LearningRole::train),
            .max_impulse = shape.max_impulse};
  });
}

}  // namespace fracbench
