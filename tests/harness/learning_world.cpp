#include "learning_world.h"

#include "core/error.h"

namespace fracbench {

namespace {

Lesson lesson;

class Pupil : public Method {
 public:
  explicit Pupil(const Method& teacher) : teacher_(teacher) {}
  MethodInfo info() const override {
    MethodInfo info = teacher_.info();
    info.name = "pupil";
    info.learns = true;
    info.learns_several = true;
    return info;
  }
  OptionsSchema options() const override { return teacher_.options(); }
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                     const Options& options, Context& context) const override {
    if (learning.examples.empty()) throw MethodFailure("nothing to learn from");
    lesson = {.examples = learning.examples.size(),
              .max_impulse = learning.max_impulse,
              .further = learning.further};
    return teacher_.prepare(target, learning, options, context);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                  const Options& options) const override {
    return teacher_.load(folder, target, options);
  }

 private:
  const Method& teacher_;
};

/// A quarter of the directions leaves the target whole, a few are too much for the method.
SceneResult run_scene(const Catalog& toys, Scenario scenario, const Target& target,
                      std::shared_ptr<const Breakable> breakable, Context& context) {
  Vec3& velocity = scenario.balls.front().velocity;
  const double height = velocity.normalized().z();
  if (height > 0.85) throw MethodFailure("struck from below");
  if (height < -0.5) velocity *= 0.1;
  return toys.run_scene(scenario, target, std::move(breakable), context);
}

}  // namespace

LearningWorld::LearningWorld() {
  const Catalog toys = toys_.catalog();
  class Forward : public Method {
   public:
    explicit Forward(const Method& method) : method_(method) {}
    MethodInfo info() const override { return method_.info(); }
    OptionsSchema options() const override { return method_.options(); }
    std::unique_ptr<Breakable> prepare(const Target& target, const LearningData& learning,
                                       const Options& options, Context& context) const override {
      return method_.prepare(target, learning, options, context);
    }
    std::unique_ptr<Breakable> load(const std::filesystem::path& folder, const Target& target,
                                    const Options& options) const override {
      return method_.load(folder, target, options);
    }

   private:
    const Method& method_;
  };
  methods_.push_back(std::make_unique<Forward>(*toys.methods.front()));
  methods_.push_back(std::make_unique<Pupil>(*toys.methods.front()));
}

Catalog LearningWorld::catalog() const {
  const Catalog toys = toys_.catalog();
  Catalog catalog = toys;
  catalog.methods = methods_;
  catalog.run_scene = [toys](const Scenario& scenario, const Target& target,
                             std::shared_ptr<const Breakable> breakable, Context& context) {
    return run_scene(toys, scenario, target, std::move(breakable), context);
  };
  return catalog;
}

Lesson last_lesson() { return lesson; }

std::string learning_suite_text(bool pupil) {
  const std::string text = R"(
seed = 5
shapes = ["box", "slab"]

[learning]
method = "halves"
family = "shove"
count = 30
train = 12
test = 4

[learning.options]
margin = 0.15

[learning.scenario]
speed = 40
)";
  if (!pupil) return text;
  return text + R"(
[[scenario]]
family = "shove"
speed = 50

[[method]]
name = "halves"

[[method]]
name = "pupil"
)";
}

}  // namespace fracbench
