#pragma once

#include <memory>
#include <vector>

#include "toy_catalog.h"

namespace fracbench {

/// The toy world with scenes that break the target in some directions only, and with a method that
/// learns, several shapes at once, too: "pupil" breaks as "halves" does and fails where it was
/// given no examples.
class LearningWorld {
 public:
  LearningWorld();
  Catalog catalog() const;

 private:
  ToyWorld toys_;
  std::vector<std::unique_ptr<Method>> methods_;
};

/// What the pupils of this process were given last.
struct Lesson {
  std::size_t examples = 0;
  double max_impulse = 0;
  std::vector<FurtherLearning> further = {};
};
Lesson last_lesson();

/// Two boxes, 30 collisions each, 12 to train and 4 to test, made by "halves"; and a suite whose
/// methods are "halves" and, with `pupil`, that one.
std::string learning_suite_text(bool pupil = false);

}  // namespace fracbench
