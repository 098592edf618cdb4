#include "harness/conformance/confined.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/temporary_folder.h"
#include "harness/conformance/elsewhere.h"
#include "harness/conformance/write_watch.h"

namespace fracbench::conformance {

CheckResult check_confined(const Bench& bench) {
  const CheckSubject& subject = bench.subject();
  const TemporaryWorkFolder folder("check");
  const std::filesystem::path saved = folder.path() / "saved";
  std::filesystem::create_directories(saved);
  const WatchedWork watched = watch_writes(folder.path(), [&] {
    // Options may name files relative to the current folder: blows alone go elsewhere.
    const auto body = bench.prepare();
    body->save(saved);
    const auto loaded = subject.method.load(saved, subject.target, subject.options);
    const Elsewhere elsewhere(folder.path());
    for (int n = 0; n < 2; ++n) bench.blow(*body, bench.impact(n));
    bench.blow(*loaded, bench.impact(0));
  });
  // A method that failed may have failed for what it did.
  if (const std::size_t count = watched.changes.size(); count > 0) {
    const std::string first = "it " + watched.changes.front();
    return failed(count == 1 ? first : fmt::format("{}, and {} more", first, count - 1));
  }
  if (!watched.failure.empty()) return failed(watched.failure);
  if (!watched.unseen.empty()) {
    return skipped(fmt::format("what it writes cannot be seen here: {}", watched.unseen));
  }
  return passed();
}

}  // namespace fracbench::conformance
