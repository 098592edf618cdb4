#include "harness/conformance/memory.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>

namespace fracbench::conformance {

namespace {

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

}  // namespace

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

}  // namespace fracbench::conformance
