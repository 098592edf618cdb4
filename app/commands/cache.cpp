#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "core/error.h"
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

PreparedStore store_of_user() {
  const auto store = PreparedStore::of_user();
  if (!store) {
    throw InputError("there is no cache: FRACBENCH_CACHE is empty; set it to a folder");
  }
  return *store;
}

double days_since(std::chrono::system_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::system_clock::now() - time).count() / 86400;
}

Json to_json(const StoredBody& body) {
  Json json{{"key", body.key},
            {"method", body.method},
            {"shape", body.shape},
            {"seconds", body.seconds},
            {"megabytes", static_cast<double>(body.bytes) / kMegabyte},
            {"days_unused", days_since(body.used)}};
  if (!body.complaint.empty()) json["complaint"] = body.complaint;
  return json;
}

void print(const std::vector<StoredBody>& bodies, const CacheArguments& a) {
  if (a.as_json) {
    Json list = Json::array();
    for (const StoredBody& body : bodies) list.push_back(to_json(body));
    print_json(list);
    return;
  }
  std::uintmax_t bytes = 0;
  for (const StoredBody& body : bodies) {
    fmt::print("{:.12}  {:<14} {:<14} {:>9.1f} MB  made in {:>8.1f} s, unused for {:.1f} days{}\n",
               body.key, body.method, body.shape, static_cast<double>(body.bytes) / kMegabyte,
               body.seconds, days_since(body.used),
               body.complaint.empty() ? "" : "; " + body.complaint);
    bytes += body.bytes;
  }
  fmt::print("{} bodies, {:.1f} MB\n", bodies.size(), static_cast<double>(bytes) / kMegabyte);
}

ExitCode list(const CacheArguments& a, bool verify) {
  const std::vector<StoredBody> bodies = store_of_user().list(verify);
  print(bodies, a);
  const bool good =
      std::ranges::all_of(bodies, [](const StoredBody& body) { return body.complaint.empty(); });
  return good || !verify ? ExitCode::good : ExitCode::bad_input;
}

/// What goes: damaged entries, those that were not used for too long, and of the rest the ones that
/// were unused longest, until the size is met.
ExitCode prune(const CacheArguments& a) {
  if (a.keep_mb < 0 && a.keep_days < 0 && !a.damaged) {
    throw InputError("say what to remove: --keep-mb SIZE, --keep-days DAYS or --damaged");
  }
  const PreparedStore store = store_of_user();
  std::vector<StoredBody> bodies = store.list(a.damaged);
  std::ranges::sort(bodies, std::ranges::greater(), &StoredBody::used);
  std::vector<StoredBody> removed;
  double kept = 0;
  for (const StoredBody& body : bodies) {
    const double size = static_cast<double>(body.bytes) / kMegabyte;
    const bool goes = (a.damaged && !body.complaint.empty()) ||
                      (a.keep_days >= 0 && days_since(body.used) > a.keep_days) ||
                      (a.keep_mb >= 0 && kept + size > a.keep_mb);
    if (goes && store.remove(body.key)) {
      removed.push_back(body);
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
  auto* command = app.add_subcommand("cache", "Prepared bodies on the disk (docs/cache.md)");
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
      print_json({{"path", store_of_user().folder().string()}});
    } else {
      fmt::print("{}\n", store_of_user().folder().string());
    }
    return ExitCode::good;
  });
}

}  // namespace fracbench
