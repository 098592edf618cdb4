#include "toy_catalog.h"

#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>

#include "core/error.h"
#include "harness/suite_reader.h"
#include "hostile_method.h"

namespace fracbench {

TriangleMesh box_mesh(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                               k & 4 ? high.z() : low.z());
  }
  mesh.faces = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

namespace {

double box_volume(const TriangleMesh& mesh) {
  return (mesh.vertices.back() - mesh.vertices.front()).prod();
}

class HalvesBody : public Breakable {
 public:
  HalvesBody(Target target, Options options)
      : target_(std::move(target)), options_(std::move(options)) {}

  std::vector<Piece> fracture(const Impact&, Context& context) const override {
    const auto stage = context.timer.stage("cut");
    const std::string& trouble = options_.text("trouble");
    if (trouble == "failure") throw MethodFailure("the plane misses the box");
    if (trouble == "memory") throw std::bad_alloc();
    if (trouble == "error") throw std::logic_error("a mistake in the method");
    if (context.device != kProcessor) context.note("computed on " + context.device);
    wait(context);
    const Vec3 low = target_.mesh.vertices.front();
    const Vec3 high = target_.mesh.vertices.back();
    const double margin = options_.number("margin");
    double x = context.random.uniform(low.x() + margin, high.x() - margin);
    std::vector<Piece> pieces;
    pieces.push_back(piece(low, {x, high.y(), high.z()}, 2, 1));
    if (trouble == "leak") x += margin / 2;
    pieces.push_back(piece({x, low.y(), low.z()}, high, 0, 0));
    if (trouble == "garbage") pieces.back().mesh.faces[3] = {0, 1, 999};
    if (trouble == "input") throw InputError("this impact is not for me");
    return pieces;
  }

  void save(const std::filesystem::path&) const override {}

 private:
  void wait(Context& context) const {
    const auto end =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(options_.number("wait"));
    while (std::chrono::steady_clock::now() < end) {
      context.stop_if_asked();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  static Piece piece(const Vec3& low, const Vec3& high, std::size_t cut, std::int32_t other) {
    Piece result{.mesh = box_mesh(low, high), .faces = {}, .next = nullptr};
    for (std::size_t f = 0; f < 12; ++f) {
      const bool fracture = f == cut || f == cut + 1;
      result.faces.push_back({fracture ? -1 : static_cast<std::int32_t>(f), fracture ? other : -1});
    }
    return result;
  }

  Target target_;
  Options options_;
};

class Halves : public Method {
 public:
  MethodInfo info() const override {
    return {.name = "halves",
            .summary = "cuts a box in two",
            .publications = {},
            .shape_type = "planar",
            .random = true,
            .quick_to_prepare = true,
            .source_digest = "1"};
  }
  OptionsSchema options() const override {
    return {{.name = "margin",
             .fallback = 0.1,
             .unit = "m",
             .summary = "between the cut and the ends",
             .minimum = 0,
             .maximum = 0.2},
            {.name = "pieces",
             .fallback = std::int64_t{2},
             .unit = "",
             .summary = "always two",
             .minimum = 2,
             .maximum = 2},
            {.name = "wait", .fallback = 0.0, .unit = "s", .summary = "", .minimum = 0},
            {.name = "trouble",
             .fallback = std::string("none"),
             .unit = "",
             .summary = "what goes wrong",
             .choices = {"none", "failure", "memory", "error", "leak", "prepare", "garbage",
                         "input", "options"}}};
  }
  std::unique_ptr<Breakable> prepare(const Target& target, const LearningData&,
                                     const Options& options, Context&) const override {
    if (options.text("trouble") == "options") throw InputError("these options cannot be met");
    if (options.text("trouble") == "prepare") throw MethodFailure("cannot work on this box");
    return std::make_unique<HalvesBody>(target, options);
  }
  std::unique_ptr<Breakable> load(const std::filesystem::path&, const Target& target,
                                  const Options& options) const override {
    return std::make_unique<HalvesBody>(target, options);
  }
};

class Shove : public ScenarioFamily {
 public:
  FamilyInfo info() const override { return {"shove", "an impact that is made up"}; }
  OptionsSchema options() const override {
    return {{.name = "count",
             .fallback = std::int64_t{3},
             .unit = "",
             .summary = "how many",
             .minimum = 1},
            {.name = "speed",
             .fallback = 50.0,
             .unit = "m/s",
             .summary = "of the ball",
             .minimum = 1,
             .maximum = 100}};
  }
  std::vector<Scenario> scenes(const Options& options, std::string_view,
                               std::uint64_t seed) const override {
    std::vector<Scenario> result;
    for (int k = 0; k < options.integer("count"); ++k) {
      Scenario scenario;
      scenario.name = std::to_string(k);
      scenario.family = "shove";
      Random random = Random(seed).fork(scenario.name);
      scenario.balls.push_back({.position = 3 * random.unit_vector(),
                                .velocity = options.number("speed") * random.unit_vector()});
      result.push_back(scenario);
    }
    return result;
  }
};

Shape load_toy_shape(const ShapeRequest& request) {
  const double half = request.longest_side / 2;
  if (request.name == "box") {
    return {"box", box_mesh(Vec3::Constant(-half), Vec3::Constant(half)), {}};
  }
  if (request.name == "slab") {
    const Vec3 corner(half, half / 2, half / 4);
    return {"slab", box_mesh(-corner, corner), {"turned upright"}};
  }
  throw InputError("there is no shape '" + request.name + "'");
}

Impact make_impact(const Scenario& scenario) {
  const Ball& ball = scenario.balls.front();
  Impact impact;
  impact.impulses.push_back({.point = ball.position / 3,
                             .direction = -ball.position / 3,
                             .magnitude = 1000 * ball.velocity.norm(),
                             .face = 4,
                             .normal = Vec3::UnitY(),
                             .face_area = 0.5});
  impact.strikers.push_back({.mass = 2386, .radius = ball.radius, .velocity = ball.velocity});
  impact.time = 0.05;
  impact.time_step = scenario.time_step;
  impact.break_test.total_impulse = impact.impulses[0].magnitude;
  return impact;
}

SceneResult run_toy_scene(const Scenario& scenario, const Target& target,
                          std::shared_ptr<const Breakable> breakable, Context& context) {
  const auto stage = context.timer.stage("rigid_body");
  SceneResult result;
  result.trajectory.frame_seconds = scenario.time_step;
  result.trajectory.tracks.push_back({Track::Kind::target, 0, 0, std::vector<Pose>(3)});
  const Impact impact = make_impact(scenario);
  if (scenario.balls.front().velocity.norm() < 10) {
    result.unbroken = impact;
    result.fragments.push_back({.mesh = target.mesh, .faces = {}});
    for (std::int32_t f = 0; f < 12; ++f) result.fragments[0].faces.push_back({f, -1});
    return result;
  }
  std::vector<Piece> pieces = breakable->fracture(impact, context);
  result.impacts.push_back(impact);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const auto number = static_cast<std::int32_t>(p);
    Fragment fragment{.mesh = std::move(pieces[p].mesh), .faces = {}, .piece = number};
    for (const PieceFace& face : pieces[p].faces) {
      fragment.faces.push_back({face.parent_face, face.is_fracture() ? 0 : -1});
    }
    result.fragments.push_back(std::move(fragment));
    result.trajectory.tracks.push_back({Track::Kind::piece, number, 3, std::vector<Pose>(5)});
    result.trajectory.tracks.back().poses[1].position = context.random.unit_vector();
  }
  result.replacements.push_back({.time = impact.time, .momentum_error = 1e-12});
  return result;
}

class Size : public Metric {
 public:
  MetricInfo info() const override { return {"size", "count and volumes", false}; }
  Measurement measure(const CellResult& cell) const override {
    Measurement result;
    MetricSeries volumes{.name = "volumes", .values = {}, .unit = "m^3"};
    double sum = 0;
    for (const Fragment& fragment : cell.fragments) {
      volumes.values.push_back(box_volume(fragment.mesh));
      sum += volumes.values.back();
    }
    result.values = {{"fragment_count", static_cast<double>(cell.fragments.size()), ""},
                     {"volume_ratio", sum / box_volume(cell.body), ""}};
    result.series = {volumes, {.name = "empty", .values = {}, .unit = ""}};
    return result;
  }
};

class Clock : public Metric {
 public:
  MetricInfo info() const override { return {"clock", "the time it took", true}; }
  Measurement measure(const CellResult& cell) const override {
    return {{{"total_time", cell.total_seconds, "s"}, {"peak", cell.peak_memory, "B"}}, {}};
  }
};

}  // namespace

ToyWorld::ToyWorld() {
  methods_.push_back(std::make_unique<Halves>());
  methods_.push_back(make_hostile_method());
  families_.push_back(std::make_unique<Shove>());
  metrics_.push_back(std::make_unique<Size>());
  metrics_.push_back(std::make_unique<Clock>());
}

Catalog ToyWorld::catalog() const {
  return {methods_, families_, metrics_, load_toy_shape, run_toy_scene};
}

std::string toy_suite_text() {
  return R"(
summary = "toys"
seed = 5
shapes = ["box"]

[[shape]]
name = "slab"
longest_side = 1.5

[[scenario]]
family = "shove"
speed = 40

[[method]]
name = "halves"

[[method]]
name = "halves"
label = "halves-wide"
margin = 0.2
)";
}

Suite toy_suite(const Catalog& catalog) {
  return parse_suite(toy_suite_text(), "toy.toml", catalog);
}

}  // namespace fracbench
