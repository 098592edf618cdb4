#include "methods/plugin/plugin.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "geometry/pieces_of_fragments.h"
#include "geometry/tag_surfaces.h"
#include "methods/plugin/library.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

/// One call into a library: collects what it says. No exception leaves its functions, since they
/// are called from code that may not know of any.
class Call {
 public:
  explicit Call(Context& context) : context_(context) {}

  fracbench_host host() {
    return {
        .handle = this,
        .add_fragment =
            [](void* handle, const fracbench_mesh* mesh) {
              self(handle).guarded([&] { self(handle).add(mesh); });
            },
        .fail =
            [](void* handle, const char* why) {
              self(handle).guarded([&] { self(handle).fail(why ? why : "no reason given"); });
            },
        .progress =
            [](void* handle, double share) {
              self(handle).guarded([&] { self(handle).context_.progress.update("plugin", share); });
            },
        .stopped = [](void* handle) -> int {
          return self(handle).context_.stop.stop_requested() ? 1 : 0;
        }};
  }

  /// What was added. Throws Cancelled or MethodFailure.
  std::vector<TriangleMesh> take() {
    context_.stop_if_asked();
    if (!failure_.empty()) throw MethodFailure("plugin: " + failure_);
    return std::move(fragments_);
  }

 private:
  static Call& self(void* handle) { return *static_cast<Call*>(handle); }

  template <typename Work>
  void guarded(const Work& work) noexcept {
    try {
      work();
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  void fail(std::string_view why) noexcept {
    if (failure_.empty()) failure_ = why;
  }

  void add(const fracbench_mesh* mesh) {
    const std::size_t number = fragments_.size();
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    if (mesh == nullptr || mesh->vertex_count < 0 || mesh->face_count < 0 ||
        mesh->vertex_count > kMost || mesh->face_count > kMost ||
        (mesh->vertex_count > 0 && mesh->vertices == nullptr) ||
        (mesh->face_count > 0 && mesh->faces == nullptr)) {
      return fail(fmt::format("fragment {} is no mesh (null pointers or counts)", number));
    }
    TriangleMesh copy;
    copy.vertices.reserve(mesh->vertex_count);
    for (std::int64_t v = 0; v < mesh->vertex_count; ++v) {
      const double* p = mesh->vertices + 3 * v;
      copy.vertices.emplace_back(p[0], p[1], p[2]);
      if (!copy.vertices.back().allFinite()) {
        return fail(fmt::format("vertex {} of fragment {} is no finite number", v, number));
      }
    }
    copy.faces.reserve(mesh->face_count);
    for (std::int64_t f = 0; f < mesh->face_count; ++f) {
      const std::int32_t* face = mesh->faces + 3 * f;
      for (int k = 0; k < 3; ++k) {
        if (face[k] < 0 || face[k] >= mesh->vertex_count) {
          return fail(fmt::format("face {} of fragment {} names vertex {} of {}", f, number,
                                  face[k], mesh->vertex_count));
        }
      }
      copy.faces.push_back({face[0], face[1], face[2]});
    }
    fragments_.push_back(std::move(copy));
  }

  Context& context_;
  std::vector<TriangleMesh> fragments_;
  std::string failure_;
};

void copy_to(double (&to)[3], const Vec3& from) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

class PluginBody : public Breakable {
 public:
  PluginBody(const Target& target, const fs::path& file, const std::string& settings,
             Context& context)
      : body_(target.mesh), library_(file) {
    std::vector<double> vertices;
    for (const Vec3& v : body_.vertices) vertices.insert(vertices.end(), {v.x(), v.y(), v.z()});
    std::vector<std::int32_t> faces;
    for (const auto& face : body_.faces) faces.insert(faces.end(), face.begin(), face.end());
    const fracbench_mesh mesh{.vertex_count = std::ssize(body_.vertices),
                              .vertices = vertices.data(),
                              .face_count = std::ssize(body_.faces),
                              .faces = faces.data()};
    const Material& m = target.material;
    const fracbench_material material{.young_modulus = m.young_modulus,
                                      .poisson_ratio = m.poisson_ratio,
                                      .density = m.density,
                                      .strength = m.strength,
                                      .toughness = m.toughness,
                                      .compressive_factor = m.compressive_factor};
    Call call(context);
    const fracbench_host host = call.host();
    prepared_ = {library_.prepare(&mesh, &material, settings.c_str(), &host), library_.release};
    call.take();
  }

  std::vector<Piece> fracture(const Impact& impact, Context& context) const override {
    std::vector<fracbench_impulse> impulses;
    for (const Impulse& impulse : impact.impulses) {
      fracbench_impulse& to = impulses.emplace_back();
      copy_to(to.point, impulse.point);
      copy_to(to.direction, impulse.direction);
      copy_to(to.normal, impulse.normal);
      to.magnitude = impulse.magnitude;
      to.face_area = impulse.face_area;
      to.face = impulse.face;
    }
    fracbench_impact told{.impulse_count = std::ssize(impulses),
                          .impulses = impulses.data(),
                          .overload = impact.overload,
                          .time_step = impact.time_step,
                          .velocity = {},
                          .angular_velocity = {},
                          .seed = context.random.bits(),
                          .threads = context.threads};
    copy_to(told.velocity, impact.body.velocity);
    copy_to(told.angular_velocity, impact.body.angular_velocity);
    Call call(context);
    const fracbench_host host = call.host();
    {
      const auto stage = context.timer.stage("library");
      library_.fracture(prepared_.get(), &told, &host);
    }
    std::vector<TriangleMesh> fragments = call.take();
    if (fragments.empty()) {
      throw MethodFailure("plugin: the library added no fragment; a body that stays whole is one");
    }
    const auto stage = context.timer.stage("tagging");
    return pieces_of_fragments(
        tag_fragments(body_, std::move(fragments), {.threads = context.threads}));
  }

  void save(const fs::path&) const override {}

 private:
  TriangleMesh body_;
  plugin::Library library_;
  std::shared_ptr<void> prepared_;  // released before its library is unloaded
};

std::unique_ptr<Breakable> body_of(const Target& target, const Options& options, Context& context) {
  const std::string& file = options.text("library");
  if (file.empty()) {
    throw InputError(
        "plugin: which library breaks the body is missing, such as library = \"cutter.so\" "
        "(docs/add-a-method.md)");
  }
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    throw InputError(fmt::format("plugin: there is no library '{}'", file));
  }
  return std::make_unique<PluginBody>(target, file, options.text("settings"), context);
}

}  // namespace

MethodInfo PluginMethod::info() const {
  MethodInfo info;
  info.name = "plugin";
  info.summary = "a shared library of yours, called through a few C functions";
  info.shape_type = "unknown";
  info.random = true;
  info.quick_to_prepare = true;
  info.volume_tolerance = 1e-6;
  return info;
}

OptionsSchema PluginMethod::options() const {
  return {{.name = "library",
           .fallback = std::string(),
           .unit = "",
           .summary = "its file; what is in it is part of what determines a result"},
          {.name = "settings",
           .fallback = std::string(),
           .unit = "",
           .summary = "passed on to the library as it is"}};
}

std::unique_ptr<Breakable> PluginMethod::prepare(const Target& target, const LearningData&,
                                                 const Options& options, Context& context) const {
  return body_of(target, options, context);
}

std::unique_ptr<Breakable> PluginMethod::load(const fs::path&, const Target& target,
                                              const Options& options) const {
  Random random(0);
  StageTimer timer;
  Progress progress;
  Context context{.random = random, .timer = timer, .progress = progress};
  return body_of(target, options, context);
}

std::vector<fs::path> PluginMethod::files(const Options& options) const {
  const std::string& file = options.text("library");
  if (file.empty()) return {};
  return {file};
}

}  // namespace fracbench
