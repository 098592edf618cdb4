#include "harness/breakable_cache.h"

#include <chrono>
#include <set>

#include "core/digest.h"
#include "harness/learning_set.h"
#include "harness/prepared_store.h"

namespace fracbench {

std::string BreakableCache::key(const Cell& cell, const Material& m) {
  Digest digest;
  digest.add(static_cast<std::uint64_t>(cell.shape));
  digest.add(static_cast<std::uint64_t>(cell.method));
  for (const double value : {m.young_modulus, m.poisson_ratio, m.density, m.strength, m.toughness,
                             m.compressive_factor, m.friction, m.restitution}) {
    digest.add(value);
  }
  return digest.hex();
}

Prepared BreakableCache::get(const Cell& cell, Context& context) {
  const PlannedShape& shape = plan_.shapes[cell.shape];
  const PlannedMethod& method = plan_.methods[cell.method];
  const Material& material = shape.scenarios[cell.scenario].scenario.material;
  std::shared_ptr<Entry> entry;
  {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Entry>& slot = entries_[key(cell, material)];
    if (!slot) slot = std::make_shared<Entry>();
    entry = slot;
  }
  const std::scoped_lock lock(entry->mutex);
  context.stop_if_asked();
  if (entry->made) return entry->prepared;

  Prepared prepared;
  prepared.target = std::make_shared<Target>(
      Target{.name = shape.shape.name, .mesh = shape.shape.mesh, .material = material});
  PreparedRequest request{
      .method = *method.method, .options = method.options, .target = *prepared.target};
  if (method.info.learns) {
    request.learning_digest = shape.learning_digest;
    std::vector<LearnedWith> others = method.learn_with;
    std::erase_if(others, [&](const LearnedWith& other) { return other.label == shape.label; });
    for (const LearnedWith& other : others) request.further_digests.push_back(other.digest);
    request.learning = [&plan = plan_, &shape, others] {
      LearningData data =
          load_learning_data(plan.learning_folder, shape.label, shape.learning_digest);
      for (const LearnedWith& other : others) {
        data.further.push_back(
            load_further_learning(plan.learning_folder, other.label, other.digest));
      }
      return data;
    };
  }
  const auto start = std::chrono::steady_clock::now();
  try {
    PreparedBody body = prepare_body(request, context);
    prepared.breakable = std::move(body.body);
    prepared.seconds = body.seconds;
  } catch (const MethodFailure& failure) {
    prepared.failure = failure.what();
    prepared.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  entry->prepared = prepared;
  entry->made = true;
  prepared.fresh = true;
  return prepared;
}

std::vector<Cell> bodies_of(const Plan& plan) {
  std::vector<Cell> cells;
  std::set<std::string> seen;
  for (const Cell& cell : plan.cells) {
    const Scenario& scenario = plan.shapes[cell.shape].scenarios[cell.scenario].scenario;
    if (seen.insert(BreakableCache::key(cell, scenario.material)).second) cells.push_back(cell);
  }
  return cells;
}

}  // namespace fracbench
