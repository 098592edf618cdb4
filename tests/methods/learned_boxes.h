#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/context.h"
#include "methods/method.h"

// A made-up world to learn from: a box that breaks in two by a plane through the point of impact.
namespace fracbench::learned_boxes {

/// A box, longest side 1.9 along x.
Target body();

/// A blow from above at x on the box.
Impact impact_at(double x);

/// The box broken at x.
LearningExample example(double x);

/// Examples at `count` places along the box.
LearningData learning_data(int count);

bool same_pieces(const std::vector<Piece>& a, const std::vector<Piece>& b);

/// An empty folder of this test program's own.
std::filesystem::path fresh_folder(const std::string& name);

/// A context that keeps the notes.
class QuietContext {
 public:
  explicit QuietContext(std::uint64_t seed = 11) : random_(seed) {}
  Context& get() { return context_; }
  std::vector<std::string> notes;

 private:
  Random random_;
  StageTimer timer_;
  Progress progress_;
  Context context_{.random = random_, .timer = timer_, .progress = progress_, .notes = &notes};
};

}  // namespace fracbench::learned_boxes
