#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/app/program.h"

namespace fracbench {
namespace {

/// What `fracbench doctor` says of the kernels of OpenBLAS.
std::string kernels() {
  const TemporaryFolder folder;
  for (const auto& finding : call("doctor --json", folder.path()).json()) {
    if (finding["name"] == "blas") return finding["detail"];
  }
  return "nothing";
}

TEST(BlasKernels, AreNotTheOldestWhereTheProcessorCanDoMore) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "needs a processor with AVX2";
  if (std::getenv("OPENBLAS_CORETYPE")) GTEST_SKIP() << "OPENBLAS_CORETYPE is set";
  EXPECT_NE(kernels(), "Prescott");
  EXPECT_NE(kernels(), "nothing");
}

TEST(BlasKernels, AreThoseThatTheUserNames) {
  if (std::getenv("OPENBLAS_CORETYPE")) GTEST_SKIP() << "OPENBLAS_CORETYPE is set";
  ::setenv("OPENBLAS_CORETYPE", "NEHALEM", 1);
  const std::string chosen = kernels();
  ::unsetenv("OPENBLAS_CORETYPE");
  EXPECT_EQ(chosen, "Nehalem");
}

}  // namespace
}  // namespace fracbench
