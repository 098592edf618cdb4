#include "harness/accept_baseline.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "core/error.h"
#include "harness/label_agreement.h"
#include "harness/provenance.h"
#include "harness/summaries.h"
#include "harness/summary_file.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kNotes = "accepted.json";

[[noreturn]] void fail(const fs::path& path, std::string_view what) {
  throw InputError(fmt::format("{}: {}; the baseline is as it was", path.string(), what));
}

void sync(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 || ::fsync(file) != 0) {
    const std::string why = std::strerror(errno);
    if (file >= 0) ::close(file);
    fail(path, "cannot be written to the disk: " + why);
  }
  ::close(file);
}

/// Removed at the end, whatever it then is.
class TemporaryCopy {
 public:
  explicit TemporaryCopy(const fs::path& baseline) {
    fs::path whole = fs::absolute(baseline).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();
    fs::create_directories(whole.parent_path());
    std::string name = whole.string() + ".accepting-XXXXXX";
    if (!::mkdtemp(name.data()))
      fail(name, fmt::format("cannot be made: {}", std::strerror(errno)));
    path_ = name;
    // Like any other folder of results, not for its maker alone.
    fs::permissions(path_, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                               fs::perms::others_read | fs::perms::others_exec);
    target_ = whole;
  }
  ~TemporaryCopy() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryCopy(const TemporaryCopy&) = delete;
  TemporaryCopy& operator=(const TemporaryCopy&) = delete;

  const fs::path& path() const { return path_; }

  /// Changes places with the target, or takes its place where there is none.
  void take_place() {
    const bool replaces = fs::exists(target_);
    const unsigned flags = replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE;
    if (::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), flags) != 0) {
      fail(target_, fmt::format("cannot be replaced: {}", std::strerror(errno)));
    }
    sync(target_.parent_path());
  }

 private:
  fs::path path_;
  fs::path target_;
};

/// What a results folder is made of, without claims and records that were set aside.
void copy_results(const fs::path& from, const fs::path& to) {
  fs::copy_file(from / "suite.json", to / "suite.json");
  sync(to / "suite.json");
  for (const char* kind : {"records", "shapes"}) {
    if (!fs::is_directory(from / kind)) continue;
    fs::create_directory(to / kind);
    for (const auto& file : fs::directory_iterator(from / kind)) {
      if (file.path().extension() != ".h5" || !file.is_regular_file()) continue;
      fs::copy_file(file.path(), to / kind / file.path().filename());
      sync(to / kind / file.path().filename());
    }
    sync(to / kind);
  }
}

/// Throws InputError where a cell of its suite has no good record.
Results read_complete(const fs::path& folder) {
  Results results = read_results(folder);
  if (!results.unreadable.empty()) fail(folder, "holds a damaged record: " + results.unreadable[0]);
  if (results.cells.size() != results.suite.cells || results.cells.empty()) {
    fail(folder, fmt::format("cannot become a baseline: it has {} of the suite's {} cells; run the "
                             "suite to its end first",
                             results.cells.size(), results.suite.cells));
  }
  return results;
}

std::string notes_text(const std::vector<Acceptance>& notes) {
  Json list = Json::array();
  for (const Acceptance& note : notes) list.push_back(to_json(note));
  return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// The note with what there is to say of these results.
Acceptance note_on(const Results& results, Acceptance note) {
  note.when = utc_now();
  note.suite = results.suite.name;
  note.cells = results.cells.size();
  return note;
}

Acceptance accept_summary(const fs::path& baseline, const fs::path& candidate, Results results,
                          const Acceptance& note) {
  std::vector<Acceptance> notes = read_acceptances(baseline);
  add_label_agreement(candidate, results);
  notes.push_back(note_on(results, note));
  write_summary_file(baseline, results, notes);
  return notes.back();
}

}  // namespace

std::vector<Acceptance> read_acceptances(const fs::path& folder) {
  if (names_summary_file(folder)) {
    return fs::exists(folder) ? read_summary_file(folder).accepted : std::vector<Acceptance>();
  }
  std::vector<Acceptance> notes;
  std::ifstream stream(folder / kNotes);
  if (!stream) return notes;
  try {
    for (const Json& note : Json::parse(stream)) notes.push_back(acceptance_from_json(note));
  } catch (const nlohmann::json::exception&) {
    throw InputError(fmt::format("{}: is damaged; restore it, or remove it to start a new history",
                                 (folder / kNotes).string()));
  }
  return notes;
}

Acceptance accept_baseline(const fs::path& baseline, const fs::path& candidate,
                           const Acceptance& note) {
  if (note.why.empty() || note.who.empty()) {
    throw InputError(
        "--accept needs a note of why: --why TEXT (and of who, where the system does "
        "not know: --who TEXT)");
  }
  Results results = read_complete(candidate);
  if (names_summary_file(baseline)) {
    return accept_summary(baseline, candidate, std::move(results), note);
  }
  if (fs::exists(baseline)) {
    if (fs::equivalent(baseline, candidate)) fail(candidate, "is the baseline itself");
    if (fs::is_symlink(baseline) || !fs::is_directory(baseline) ||
        (!fs::is_empty(baseline) && !fs::exists(baseline / "suite.json"))) {
      fail(baseline, "is no results folder, and is not overwritten; name another path");
    }
  }
  std::vector<Acceptance> notes = read_acceptances(baseline);
  try {
    TemporaryCopy copy(baseline);
    copy_results(candidate, copy.path());
    // Read anew: the candidate may have changed meanwhile.
    notes.push_back(note_on(read_complete(copy.path()), note));
    write_file_atomically(copy.path() / kNotes, notes_text(notes));
    sync(copy.path());
    copy.take_place();
  } catch (const fs::filesystem_error& error) {
    fail(baseline, error.what());
  }
  return notes.back();
}

}  // namespace fracbench
