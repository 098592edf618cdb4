#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "core/error.h"
#include "harness/collision_store.h"
#include "harness/prepared_store.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMegabyte = 1e6;

struct CacheArguments {
  double keep_mb = -1;
  double keep_days = -1;
  bool damaged = false;
  bool as_json = false;
};

/// All that is kept for a user.
struct Cache {
  explicit Cache(const std::filesystem::path& path)
      : folder(path), bodies(path), collisions(path) {}

  static Cache of_user() {
    const auto path = user_cache_folder();
    if (!path) throw InputError("there is no cache: FRACBENCH_CACHE is empty; set it to a folder");
    return Cache(*path);
  }

  std::vector<CacheEntry> list(bool verify) const {
    std::vector<CacheEntry> entries = bodies.list(verify);
    std::ranges::move(collisions.list(verify), std::back_inserter(entries));
    return entries;
  }
  bool remove(const CacheEntry& entry) const {
    return entry.collisions ? collisions.remove(entry.key) : bodies.remove(entry.key);
  }

  std::filesystem::path folder;
  PreparedStore bodies;
  CollisionStore collisions;
};

double days_since(std::chrono::system_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::system_clock::now() - time).count() / 86400;
}

Json to_json(const CacheEntry& entry) {
  Json json{{"kind", entry.collisions ? "collisions" : "body"},
            {"key", entry.key},
            {"method", entry.method},
            {"shape", entry.shape},
            {"megabytes", static_cast<double>(entry.bytes) / kMegabyte},
            {"days_unused", days_since(entry.used)}};
  if (entry.collisions) json["collisions"] = *entry.collisions;
  if (entry.seconds) json["seconds"] = *entry.seconds;
  if (!entry.complaint.empty()) json["complaint"] = entry.complaint;
  return json;
}

void print(const std::vector<CacheEntry>& entries, const CacheArguments& a) {
  if (a.as_json) {
    Json list = Json::array();
    for (const CacheEntry& entry : entries) list.push_back(to_json(entry));
    print_json(list);
    return;
  }
  std::uintmax_t bytes = 0;
  for (const CacheEntry& entry : entries) {
    const std::string what = entry.collisions
                                 ? fmt::format("{} collisions", *entry.collisions)
                                 : fmt::format("made in {:.1f} s", entry.seconds.value_or(0));
    fmt::print("{:.12}  {:<14} {:<14} {:>9.1f} MB  {:<18} unused for {:.1f} days{}\n", entry.key,
               entry.method, entry.shape, static_cast<double>(entry.bytes) / kMegabyte, what,
               days_since(entry.used), entry.complaint.empty() ? "" : "; " + entry.complaint);
    bytes += entry.bytes;
  }
  fmt::print("{} {}, {:.1f} MB\n", entries.size(), entries.size() == 1 ? "entry" : "entries",
             static_cast<double>(bytes) / kMegabyte);
}

ExitCode list(const CacheArguments& a, bool verify) {
  const std::vector<CacheEntry> entries = Cache::of_user().list(verify);
  print(entries, a);
  const bool good =
      std::ranges::all_of(entries, [](const CacheEntry& entry) { return entry.complaint.empty(); });
  return good || !verify ? ExitCode::good : ExitCode::bad_input;
}

/// What goes: damaged entries (of collisions only the damaged ones), those that were not used for
/// too long, and of the rest the ones that were unused longest, until the size is met.
ExitCode prune(const CacheArguments& a) {
  if (a.keep_mb < 0 && a.keep_days < 0 && !a.damaged) {
    throw InputError("say what to remove: --keep-mb SIZE, --keep-days DAYS or --damaged");
  }
  const Cache cache = Cache::of_user();
  std::vector<CacheEntry> entries = cache.list(a.damaged);
  std::ranges::sort(entries, std::ranges::greater(), &CacheEntry::used);
  std::vector<CacheEntry> removed;
  double kept = 0;
  for (const CacheEntry& entry : entries) {
    const double size = static_cast<double>(entry.bytes) / kMegabyte;
    const bool damaged = a.damaged && !entry.complaint.empty();
    if (damaged && entry.collisions) cache.collisions.remove_damaged(entry.key);
    const bool goes = (damaged && !entry.collisions) ||
                      (a.keep_days >= 0 && days_since(entry.used) > a.keep_days) ||
                      (a.keep_mb >= 0 && kept + size > a.keep_mb);
    if (goes && cache.remove(entry)) {
      removed.push_back(entry);
    } else {
      kept += size;
    }
  }
  if (!a.as_json) fmt::print("removed:\n");
  print(removed, a);
  return ExitCode::good;
}

}  // namespace

void add_cache_command(CLI::App& app, Action& chosen) {
  auto* command =
      app.add_subcommand("cache", "Prepared bodies and learning data on the disk (docs/cache.md)");
  command->require_subcommand(1);
  auto a = std::make_shared<CacheArguments>();
  const auto add = [&](const char* name, const char* what, std::function<ExitCode()> action) {
    auto* sub = command->add_subcommand(name, what);
    sub->callback([&chosen, action] { chosen = [action](std::stop_token) { return action(); }; });
    sub->add_flag("--json", a->as_json, "As one JSON value");
    return sub;
  };
  add("list", "What is there", [a] { return list(*a, false); });
  add("verify", "Check the digests of all files; exit code 2 where one is damaged",
      [a] { return list(*a, true); });
  auto* remove = add("prune", "Remove what is old, too much or damaged", [a] { return prune(*a); });
  remove->add_option("--keep-mb", a->keep_mb, "Keep at most so much, the last used first, MB");
  remove->add_option("--keep-days", a->keep_days, "Keep what was used in the last so many days");
  remove->add_flag("--damaged", a->damaged, "Remove what is damaged");
  add("path", "Print the folder", [a] {
    if (a->as_json) {
      print_json({{"path", Cache::of_user().folder.string()}});
    } else {
      fmt::print("{}\n", Cache::of_user().folder.string());
    }
    return ExitCode::good;
  });
}

}  // namespace fracbench
