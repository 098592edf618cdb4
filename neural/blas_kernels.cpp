#include "neural/blas_kernels.h"

#include <cblas.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace fracbench::neural {

namespace {

constexpr const char* kChoice = "OPENBLAS_CORETYPE";

/// What OpenBLAS falls back to.
constexpr const char* kOldest = "Prescott";

/// The kernels for what this processor can do; null: the oldest are the right ones.
const char* fitting_kernels() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return "SKYLAKEX";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "HASWELL";
#endif
  return nullptr;
}

}  // namespace

std::string blas_kernels() { return ::openblas_get_corename(); }

void use_fitting_blas_kernels(char** argv) {
  const char* fitting = fitting_kernels();
  if (fitting == nullptr || std::getenv(kChoice) != nullptr || blas_kernels() != kOldest) return;
  ::setenv(kChoice, fitting, /*overwrite=*/1);
  // By its name: "exe" is what the system would call the program else.
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  ::execv(program.c_str(), argv);
  // Slower is better than not at all.
}

}  // namespace fracbench::neural
