#include "harness/conformance/tidy.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "core/temporary_folder.h"
#include "harness/conformance/elsewhere.h"

namespace fracbench::conformance {

namespace {

namespace fs = std::filesystem;

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

}  // namespace

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

}  // namespace fracbench::conformance
