#pragma once

#include <functional>
#include <memory>
#include <span>

#include "methods/method.h"
#include "metrics/metric.h"
#include "scenarios/families.h"
#include "scenarios/scene.h"
#include "scenarios/shapes.h"

namespace fracbench {

/// What suites may name and cells are made of. Handed around instead of reaching for the
/// registries, so that a program can add its own parts.
struct Catalog {
  std::span<const std::unique_ptr<Method>> methods;
  std::span<const std::unique_ptr<ScenarioFamily>> families;
  std::span<const std::unique_ptr<Metric>> metrics;
  std::function<Shape(const ShapeRequest&)> load_shape;
  std::function<SceneResult(const Scenario&, const Target&, std::shared_ptr<const Breakable>,
                            Context&)>
      run_scene;

  /// Both throw InputError for an unknown name, with the nearest known one; `where` says who asks.
  const Method& method(std::string_view name, std::string_view where) const;
  const ScenarioFamily& family(std::string_view name, std::string_view where) const;
};

/// Everything that is built in.
Catalog built_in_catalog();

}  // namespace fracbench
