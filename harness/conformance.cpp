#include "harness/conformance.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "core/digest.h"
#include "core/error.h"
#include "core/temporary_folder.h"
#include "core/text.h"
#include "geometry/measures.h"
#include "metrics/surface_retention.h"
#include "metrics/validity.h"
#include "scenarios/fragments_of_pieces.h"
#include "scenarios/given_impact.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 1;
constexpr double kStopSeconds = 1;  // within which work has to end when it is asked to

CheckResult passed(std::string detail = {}) { return {Conformity::passed, std::move(detail)}; }
CheckResult failed(std::string detail) { return {Conformity::failed, std::move(detail)}; }
CheckResult skipped(std::string detail) { return {Conformity::skipped, std::move(detail)}; }

/// A method at work on its subject.
class Bench {
 public:
  explicit Bench(const CheckSubject& subject) : subject_(subject) {}

  std::unique_ptr<Breakable> prepare(const std::stop_token& stop = {}) const {
    Random random(kSeed);
    StageTimer timer;
    Progress progress;
    Context context = context_of(random, timer, progress, stop);
    return subject_.method.prepare(subject_.target, {}, subject_.options, context);
  }

  std::vector<Piece> blow(const Breakable& body, const Impact& impact, std::uint64_t seed = kSeed,
                          const std::stop_token& stop = {}) const {
    Random random(derive_seed(seed, {"check"}));
    StageTimer timer;
    Progress progress;
    Context context = context_of(random, timer, progress, stop);
    return body.fracture(impact, context);
  }

  /// A blow along the inward normal at the middle of a face: the n-th of a few that are spread over
  /// the surface.
  Impact impact(int n, double factor = 1) const {
    const TriangleMesh& mesh = subject_.target.mesh;
    const std::size_t face =
        (mesh.faces.size() / 7 * static_cast<std::size_t>(3 * n + 1) + 1) % mesh.faces.size();
    const Vec3 point = (mesh.corner(face, 0) + mesh.corner(face, 1) + mesh.corner(face, 2)) / 3;
    return impact_at(subject_.target, point, -area_vector2(mesh, face), factor * subject_.impulse);
  }

  const CheckSubject& subject() const { return subject_; }

 private:
  Context context_of(Random& random, StageTimer& timer, Progress& progress,
                     const std::stop_token& stop) const {
    return {.random = random,
            .timer = timer,
            .progress = progress,
            .stop = stop,
            .threads = subject_.threads};
  }

  const CheckSubject& subject_;
};

std::string digest_of(const std::vector<Piece>& pieces) {
  Digest digest;
  for (const Piece& piece : pieces) {
    digest.add(piece.mesh);
    for (const PieceFace& face : piece.faces) {
      digest.add(static_cast<std::uint64_t>(face.parent_face));
      digest.add(static_cast<std::uint64_t>(face.neighbour));
    }
  }
  return digest.hex();
}

/// The pieces of a blow that broke the body; says so where none of a few did.
std::vector<Piece> broken(const Bench& bench) {
  const auto body = bench.prepare();
  std::vector<Piece> pieces;
  for (int n = 0; n < 4 && pieces.size() < 2; ++n) pieces = bench.blow(*body, bench.impact(n));
  return pieces;
}

CheckResult unbroken_note() {
  return skipped("four blows left the body whole; a larger --impulse helps");
}

ValidityReport report_of(const Bench& bench, const std::vector<Piece>& pieces) {
  const TriangleMesh& mesh = bench.subject().target.mesh;
  return check_fragments(mesh, fragments_of(mesh, pieces));
}

CheckResult check_tags(const Bench& bench) {
  const std::vector<Piece> pieces = broken(bench);
  const auto faces = static_cast<std::int32_t>(bench.subject().target.mesh.faces.size());
  const auto count = static_cast<std::int32_t>(pieces.size());
  for (std::int32_t p = 0; p < count; ++p) {
    const Piece& piece = pieces[static_cast<std::size_t>(p)];
    if (piece.faces.size() != piece.mesh.faces.size()) {
      return failed(fmt::format("piece {}: {} tags for {} faces", p, piece.faces.size(),
                                piece.mesh.faces.size()));
    }
    for (const PieceFace& tag : piece.faces) {
      if (tag.parent_face >= faces || tag.parent_face < -1 || tag.neighbour >= count ||
          tag.neighbour < -1 || tag.neighbour == p) {
        return failed(
            fmt::format("piece {}: parent face {} and neighbour {} of {} faces and {} "
                        "pieces",
                        p, tag.parent_face, tag.neighbour, faces, count));
      }
    }
    for (const Vec3& v : piece.mesh.vertices) {
      if (!v.allFinite()) return failed(fmt::format("piece {}: a vertex is no number", p));
    }
  }
  return pieces.empty() ? failed("no piece at all; a body that stays whole is one")
                        : passed(fmt::format("{} pieces", count));
}

CheckResult check_closed(const Bench& bench) {
  const std::vector<Piece> pieces = broken(bench);
  const ValidityReport report = report_of(bench, pieces);
  for (std::size_t n = 0; n < report.fragments.size(); ++n) {
    const FragmentValidity& f = report.fragments[n];
    if (f.valid()) continue;
    return failed(fmt::format("fragment {} is {}", n,
                              !f.well_formed ? "no mesh"
                              : !f.closed    ? "open"
                              : !f.oriented  ? "turned inside out in part"
                                             : "meeting itself"));
  }
  return pieces.empty() ? failed("there is no fragment") : passed();
}

CheckResult check_disjoint(const Bench& bench) {
  const ValidityReport report = report_of(bench, broken(bench));
  return report.disjoint ? passed() : failed(report.describe());
}

CheckResult check_volume(const Bench& bench) {
  const double ratio = report_of(bench, broken(bench)).volume_ratio;
  const double tolerance = bench.subject().method.info().volume_tolerance;
  const std::string text = fmt::format("|{:.10g} - 1|, allowed {:g}", ratio, tolerance);
  return std::abs(ratio - 1) <= tolerance ? passed(text) : failed(text);
}

CheckResult check_surface(const Bench& bench) {
  if (!bench.subject().method.info().retains_surface) {
    return skipped("the method does not say that it keeps the surface");
  }
  const TriangleMesh& mesh = bench.subject().target.mesh;
  const Fragments fragments = fragments_of(mesh, broken(bench));
  const Measurement measured = SurfaceRetention().measure(
      {.body = mesh, .fragments = fragments, .impacts = {}, .stages = {}});
  for (const MetricValue& value : measured.values) {
    if (value.name != "surface_retention") continue;
    constexpr double enough = 0.999;
    const std::string text = fmt::format("{:.6g} of the area, wanted {:g}", value.value, enough);
    return value.value >= enough ? passed(text) : failed(text);
  }
  return failed("it cannot be measured");
}

CheckResult check_same_seed(const Bench& bench) {
  const auto run = [&] { return digest_of(bench.blow(*bench.prepare(), bench.impact(0))); };
  return run() == run() ? passed() : failed("prepared and broken twice: other bytes");
}

CheckResult check_const_use(const Bench& bench) {
  const auto body = bench.prepare();
  const std::string first = digest_of(bench.blow(*body, bench.impact(0)));
  return digest_of(bench.blow(*body, bench.impact(0))) == first
             ? passed()
             : failed("one body broken twice by the same blow: other bytes");
}

CheckResult check_other_impact(const Bench& bench) {
  const auto used = bench.prepare();
  const std::string before = digest_of(bench.blow(*used, bench.impact(0)));
  const std::string after = digest_of(bench.blow(*used, bench.impact(1)));
  const std::string fresh = digest_of(bench.blow(*bench.prepare(), bench.impact(1)));
  if (after != fresh) {
    return failed("what a blow does depends on the blow before" +
                  std::string(after == before ? ": it is that one's answer again" : ""));
  }
  return passed();
}

CheckResult check_other_seed(const Bench& bench) {
  const auto body = bench.prepare();
  const std::string first = digest_of(bench.blow(*body, bench.impact(0)));
  bool differs = false;
  for (std::uint64_t seed = 2; seed < 6; ++seed) {
    differs = differs || digest_of(bench.blow(*body, bench.impact(0), seed)) != first;
  }
  const bool random = bench.subject().method.info().random;
  if (differs == random) return passed(random ? "random" : "not random");
  return failed(random ? "says that it is random, but five seeds give the same bytes"
                       : "does not say that it is random, but another seed gives other bytes");
}

CheckResult check_save_load(const Bench& bench) {
  const auto body = bench.prepare();
  const TemporaryWorkFolder folder("check");
  body->save(folder.path());
  const CheckSubject& subject = bench.subject();
  const auto loaded = subject.method.load(folder.path(), subject.target, subject.options);
  return digest_of(bench.blow(*loaded, bench.impact(0))) ==
                 digest_of(bench.blow(*body, bench.impact(0)))
             ? passed()
             : failed("a body that was saved and loaded breaks into other bytes");
}

CheckResult check_weak_blow(const Bench& bench) {
  const auto body = bench.prepare();
  try {
    const std::vector<Piece> pieces = bench.blow(*body, bench.impact(0, 1e-9));
    if (pieces.empty()) return failed("no piece at all; a body that stays whole is one");
    return report_of(bench, pieces).valid() ? passed(fmt::format("{} piece(s)", pieces.size()))
                                            : failed("the pieces are not valid");
  } catch (const MethodFailure& failure) {
    return passed(fmt::format("refused: {}", failure.what()));
  }
}

/// Runs the work and asks it to stop shortly after; how long it took from then, nothing where it
/// had ended before.
std::optional<double> seconds_to_stop(const std::function<void(std::stop_token)>& work) {
  using Clock = std::chrono::steady_clock;
  std::stop_source source;
  Clock::time_point asked;
  bool ended = false;
  {
    std::jthread asking([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      asked = Clock::now();
      source.request_stop();
    });
    try {
      work(source.get_token());
      ended = !source.stop_requested();
    } catch (const Cancelled&) {
    }
    if (ended) return std::nullopt;
  }
  return std::chrono::duration<double>(Clock::now() - asked).count();
}

CheckResult check_cancel(const Bench& bench) {
  std::string text;
  const auto judge = [&](const char* what, std::optional<double> seconds) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", what,
                        seconds ? fmt::format("{:.2g} s", *seconds) : "done before");
    return !seconds || *seconds <= kStopSeconds;
  };
  const bool preparing = judge(
      "preparing", seconds_to_stop([&](const std::stop_token& stop) { bench.prepare(stop); }));
  const auto body = bench.prepare();
  const bool breaking = judge("breaking", seconds_to_stop([&](const std::stop_token& stop) {
                                bench.blow(*body, bench.impact(0), kSeed, stop);
                              }));
  return preparing && breaking ? passed(text) : failed(text);
}

/// Bytes that are allocated now.
double bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Peak of this process and of the largest one that it has waited for, MiB.
double peak_mb() {
  double peak = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    peak = std::max(peak, static_cast<double>(usage.ru_maxrss) / 1024);
  }
  return peak;
}

CheckResult check_memory(const Bench& bench) {
  constexpr int kFirst = 3, kBlows = 8;  // the first ones fill what is kept on purpose
  constexpr double kLeak = 64 * 1024;    // bytes a blow
  const auto body = bench.prepare();
  double before = 0;
  for (int n = 0; n < kBlows; ++n) {
    if (n == kFirst) before = bytes_in_use();
    bench.blow(*body, bench.impact(0));
  }
  const double growth = (bytes_in_use() - before) / (kBlows - kFirst);
  const double peak = peak_mb();
  const std::string text = fmt::format("{:.0f} MiB at most", peak);
  if (peak > bench.subject().memory_mb) {
    return failed(fmt::format("{}, allowed {:g}", text, bench.subject().memory_mb));
  }
  if (growth > kLeak) {
    return failed(fmt::format("each blow leaves {:.0f} KiB behind", growth / 1024));
  }
  return passed(text);
}

/// What is in a folder: times of change by path.
using Listing = std::map<fs::path, fs::file_time_type>;

Listing listing_of(const fs::path& folder) {
  Listing listing;
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(folder, error);
       !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (!at->is_directory(error)) listing[at->path()] = at->last_write_time(error);
  }
  return listing;
}

/// The current folder, HOME and TMPDIR are elsewhere while it lives.
class Elsewhere {
 public:
  explicit Elsewhere(const fs::path& folder) : before_(fs::current_path()) {
    for (std::size_t n = 0; n < kNames.size(); ++n) {
      if (const char* value = std::getenv(kNames[n])) values_[n] = value;
      fs::create_directories(folder / kNames[n]);
      ::setenv(kNames[n], (folder / kNames[n]).c_str(), 1);
    }
    fs::create_directories(folder / "current");
    fs::current_path(folder / "current");
  }
  ~Elsewhere() {
    std::error_code ignored;
    fs::current_path(before_, ignored);
    for (std::size_t n = 0; n < kNames.size(); ++n) {
      if (values_[n]) {
        ::setenv(kNames[n], values_[n]->c_str(), 1);
      } else {
        ::unsetenv(kNames[n]);
      }
    }
  }
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;

 private:
  static constexpr std::array<const char*, 2> kNames{"HOME", "TMPDIR"};
  fs::path before_;
  std::array<std::optional<std::string>, 2> values_;
};

CheckResult check_tidy(const Bench& bench) {
  const CheckSubject& subject = bench.subject();
  const TemporaryWorkFolder folder("check");
  std::set<fs::path> watched{folder.path()};
  for (const fs::path& file : subject.method.files(subject.options)) {
    watched.insert(fs::absolute(file).parent_path());
  }
  const auto look = [&] {
    Listing listing;
    for (const fs::path& place : watched) listing.merge(listing_of(place));
    return listing;
  };
  // Options may name files relative to the current folder: only what is prepared goes elsewhere.
  const auto body = bench.prepare();
  const Listing before = look();
  {
    const Elsewhere elsewhere(folder.path());
    for (int n = 0; n < 2; ++n) bench.blow(*body, bench.impact(n));
  }
  for (const auto& [path, time] : look()) {
    const auto found = before.find(path);
    if (found != before.end() && found->second == time) continue;
    return failed(fmt::format("it leaves {} in {}", path.filename().string(),
                              path.string().starts_with(folder.path().string())
                                  ? path.parent_path().filename().string()
                                  : path.parent_path().string()));
  }
  return passed();
}

struct Known {
  Check check;
  CheckResult (*make)(const Bench&);
  bool needs_fragments = false;  ///< says nothing where no blow broke the body
};

const std::vector<Known>& known_checks() {
  static const std::vector<Known> all = {
      {{"tags", "every face says where it comes from, every vertex is a number"}, check_tags},
      {{"closed", "fragments are closed, oriented, free of self-intersections"},
       check_closed,
       true},
      {{"disjoint", "fragments do not overlap"}, check_disjoint, true},
      {{"volume", "they fill the body within the tolerance that the method declares"},
       check_volume,
       true},
      {{"surface", "the original surface is kept, where the method says so"}, check_surface, true},
      {{"same-seed", "the same seed gives the same bytes"}, check_same_seed},
      {{"other-seed", "another seed gives other fragments just where the method says so"},
       check_other_seed,
       true},
      {{"const-use", "a prepared body may be used twice"}, check_const_use},
      {{"other-impact", "an answer does not depend on earlier impacts"}, check_other_impact},
      {{"save-load", "a body that was saved and loaded is the same"}, check_save_load},
      {{"weak-blow", "a blow that is too weak to matter has a sound answer, too"}, check_weak_blow},
      {{"memory", "it needs no more memory than allowed, and gives it back after each blow"},
       check_memory},
      {{"tidy", "nothing is left in the current folder, HOME, TMPDIR or beside its own files"},
       check_tidy},
      {{"cancel", "work ends within a second when it is asked to"}, check_cancel}};
  return all;
}

}  // namespace

std::string_view to_string(Conformity conformity) {
  switch (conformity) {
    case Conformity::passed:
      return "passed";
    case Conformity::failed:
      return "failed";
    case Conformity::skipped:
      break;
  }
  return "skipped";
}

const std::vector<Check>& conformance_checks() {
  static const std::vector<Check> all = [] {
    std::vector<Check> list;
    for (const Known& known : known_checks()) list.push_back(known.check);
    return list;
  }();
  return all;
}

CheckResult make_check(const std::string& name, const CheckSubject& subject) {
  const auto& all = known_checks();
  const auto found =
      std::ranges::find_if(all, [&](const Known& known) { return known.check.name == name; });
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const Known& known : all) names.push_back(known.check.name);
    throw InputError(fmt::format("there is no check '{}'{}", name, did_you_mean(name, names)));
  }
  const Bench bench(subject);
  try {
    if (found->needs_fragments && broken(bench).size() < 2) return unbroken_note();
    return found->make(bench);
  } catch (const MethodFailure& failure) {
    return failed(failure.what());
  }
}

}  // namespace fracbench
