#include "harness/prepared_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "core/atomic_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "harness/claim.h"

namespace fracbench {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// Version of what an entry is; part of every key.
constexpr std::uint64_t kStoreVersion = 1;
constexpr const char* kManifest = "manifest.json";
constexpr auto kWaitInterval = std::chrono::milliseconds(100);

std::string digest_of(const fs::path& file) {
  Digest digest;
  digest.add_file(file);
  return digest.hex();
}

/// Files of an entry but for its manifest, by name.
Json describe_files(const fs::path& folder) {
  std::map<std::string, Json> files;
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    if (!file.is_regular_file()) continue;
    const std::string name = file.path().lexically_relative(folder).generic_string();
    if (name == kManifest) continue;
    files[name] = {{"bytes", file.file_size()}, {"sha256", digest_of(file.path())}};
  }
  return files;
}

Json read_manifest(const fs::path& folder) {
  try {
    std::ifstream stream(folder / kManifest);
    if (!stream) {
      throw InputError(fmt::format("'{}' cannot be read", (folder / kManifest).string()));
    }
    Json manifest = Json::parse(stream);
    manifest.at("method").get<std::string>();
    manifest.at("shape").get<std::string>();
    manifest.at("seconds").get<double>();
    for (const auto& [name, file] : manifest.at("files").items()) {
      file.at("bytes").get<std::uintmax_t>();
      file.at("sha256").get<std::string>();
    }
    return manifest;
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("'{}': {}", (folder / kManifest).string(), error.what()));
  }
}

/// What is wrong with the files of an entry; empty: nothing.
std::string complaint(const fs::path& folder, const Json& manifest, bool digests) {
  for (const auto& [name, file] : manifest["files"].items()) {
    std::error_code error;
    if (fs::file_size(folder / name, error) != file["bytes"].get<std::uintmax_t>() || error) {
      return fmt::format("'{}' is missing or cut short", name);
    }
    if (digests && digest_of(folder / name) != file["sha256"].get<std::string>()) {
      return fmt::format("'{}' is damaged", name);
    }
  }
  return "";
}

PreparedBody make(const PreparedRequest& request, Context& context) {
  const auto start = Clock::now();
  const LearningData learning = request.learning ? request.learning() : LearningData();
  PreparedBody made;
  made.body = request.method.prepare(request.target, learning, request.options, context);
  made.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return made;
}

/// Writes the entry beside its place and gives it its name.
void keep(const PreparedBody& made, const PreparedRequest& request, const fs::path& entry) {
  const fs::path part = entry.string() + ".part";
  fs::remove_all(part);
  fs::create_directories(part);
  made.body->save(part);
  const Json manifest{{"version", kStoreVersion},
                      {"method", request.method.info().name},
                      {"options", request.options.to_json()},
                      {"shape", request.target.name},
                      {"seconds", made.seconds},
                      {"files", describe_files(part)}};
  write_file_atomically(part / kManifest, manifest.dump(2) + "\n");
  fs::rename(part, entry);
}

/// The body of an entry that is there; null where it is not, or is damaged (and then moved away).
PreparedBody read(const PreparedRequest& request, const fs::path& entry) {
  if (!fs::exists(entry)) return {};
  std::string why;
  try {
    const Json manifest = read_manifest(entry);
    why = complaint(entry, manifest, true);
    if (why.empty()) {
      PreparedBody found{.body = request.method.load(entry, request.target, request.options),
                         .seconds = manifest["seconds"]};
      std::error_code ignored;  // a cache that cannot be written can be read all the same
      fs::last_write_time(entry / kManifest, fs::file_time_type::clock::now(), ignored);
      return found;
    }
  } catch (const InputError& error) {
    why = error.what();
  } catch (const fs::filesystem_error& error) {
    why = error.what();
  }
  warn_of_cache(fmt::format("the entry {} for {} is made anew: {}", entry.filename().string(),
                            request.target.name, why));
  const fs::path aside = entry.string() + ".damaged";
  std::error_code ignored;
  fs::remove_all(aside, ignored);
  fs::rename(entry, aside, ignored);
  return {};
}

}  // namespace

std::string digest_of_files(const Method& method, const Options& options) {
  const std::vector<fs::path> files = method.files(options);
  if (files.empty()) return "";
  Digest digest;
  for (const fs::path& file : files) digest.add_file(file);
  return digest.hex();
}

std::string prepared_key(const PreparedRequest& request, const Context& context) {
  const MethodInfo info = request.method.info();
  Digest digest;
  digest.add(kStoreVersion);
  digest.add(info.name);
  digest.add(info.source_digest);
  digest.add(request.options.to_json().dump());
  if (request.further_digests.empty()) digest.add(request.target.mesh);
  const Material& m = request.target.material;
  for (const double value : {m.young_modulus, m.poisson_ratio, m.density, m.strength, m.toughness,
                             m.compressive_factor, m.friction, m.restitution}) {
    digest.add(value);
  }
  std::vector<std::string> learned = request.further_digests;
  learned.push_back(request.learning_digest);
  std::ranges::sort(learned);
  for (const std::string& one : learned) digest.add(one);
  digest.add(digest_of_files(request.method, request.options));
  digest.add(info.random ? context.random.seed() : 0);
  digest.add(static_cast<std::uint64_t>(context.threads));
  if (context.device != kProcessor) digest.add(context.device);
  return digest.hex();
}

std::optional<PreparedStore> PreparedStore::of_user() {
  const auto folder = user_cache_folder();
  if (!folder) return std::nullopt;
  return PreparedStore(*folder);
}

fs::path PreparedStore::entry(const std::string& key) const { return folder_ / "prepared" / key; }

PreparedBody PreparedStore::get(const PreparedRequest& request, Context& context) const {
  const fs::path path = entry(prepared_key(request, context));
  const fs::path work = path.string() + ".work";
  try {
    fs::create_directories(path.parent_path());
    PreparedBody found;
    const std::optional<Claim> claim = [&]() -> std::optional<Claim> {
      while (true) {
        found = read(request, path);
        if (found.body) return std::nullopt;
        if (auto taken = Claim::try_take(path.string() + ".lock")) return taken;
        context.progress.update("waiting for another process that prepares this body", 0);
        context.stop_if_asked();
        std::this_thread::sleep_for(kWaitInterval);
      }
    }();
    // It may have been finished between our look and our claim.
    if (!found.body) found = read(request, path);
    if (found.body) return found;
    fs::create_directories(work);
    Context with_checkpoints = context;
    with_checkpoints.checkpoints = work;
    PreparedBody made = make(request, with_checkpoints);
    try {
      keep(made, request, path);
      fs::remove_all(work);
    } catch (const std::exception& error) {
      warn_of_cache(fmt::format("{} for {} is not kept: {}", request.method.info().name,
                                request.target.name, error.what()));
    }
    return made;
  } catch (const fs::filesystem_error& error) {
    warn_of_cache(fmt::format("'{}' cannot be used: {}; name another folder in FRACBENCH_CACHE",
                              folder_.string(), error.code().message()));
    return make(request, context);
  }
}

std::vector<CacheEntry> PreparedStore::list(bool verify) const {
  std::vector<CacheEntry> bodies;
  std::error_code error;
  for (const auto& folder : fs::directory_iterator(folder_ / "prepared", error)) {
    if (!folder.is_directory() || folder.path().has_extension()) continue;
    CacheEntry body{.key = folder.path().filename().string(),
                    .method = "?",
                    .shape = "?",
                    .used = last_written(folder.path() / kManifest)};
    try {
      const Json manifest = read_manifest(folder.path());
      body.method = manifest["method"];
      body.shape = manifest["shape"];
      body.seconds = manifest["seconds"].get<double>();
      for (const auto& [name, file] : manifest["files"].items()) {
        body.bytes += file["bytes"].get<std::uintmax_t>();
      }
      body.complaint = complaint(folder.path(), manifest, verify);
    } catch (const InputError& bad) {
      body.complaint = bad.what();
    }
    bodies.push_back(std::move(body));
  }
  std::ranges::sort(bodies, {}, &CacheEntry::key);
  return bodies;
}

bool PreparedStore::remove(const std::string& key) const { return remove_cache_entry(entry(key)); }

PreparedBody prepare_body(const PreparedRequest& request, Context& context) {
  if (!request.method.info().quick_to_prepare) {
    if (const auto store = PreparedStore::of_user()) return store->get(request, context);
  }
  return make(request, context);
}

}  // namespace fracbench
