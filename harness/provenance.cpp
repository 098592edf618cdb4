#include "harness/provenance.h"

#include <CGAL/version.h>
#include <LinearMath/btScalar.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gmp.h>
#include <hdf5.h>
#include <mpfr.h>
#include <openssl/crypto.h>
#include <sys/utsname.h>
#include <tbb/version.h>
#include <toml++/toml.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <chrono>
#include <fstream>
#include <thread>

#include "harness/build_info.h"
#include "neural/blas_kernels.h"

namespace fracbench {

namespace {

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

std::string system_name() {
  ::utsname name{};
  if (::uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

}  // namespace

std::map<std::string, std::string> collect_provenance() {
  const BuildInfo& build = build_info();
  return {{"program_version", build.version},
          {"revision", build.revision},
          {"revision_dirty", build.dirty ? "true" : "false"},
          {"compiler", build.compiler},
          {"build_type", build.build_type},
          {"cpu", cpu_name()},
          {"blas", neural::blas_kernels()},
          {"cpu_threads", std::to_string(std::thread::hardware_concurrency())},
          {"system", system_name()},
          {"library_boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000,
                                        BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
          {"library_bullet", fmt::format("{}.{}", btGetVersion() / 100, btGetVersion() % 100)},
          {"library_cgal", CGAL_VERSION_STR},
          {"library_eigen",
           fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
          {"library_fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100,
                                      FMT_VERSION % 100)},
          {"library_gmp", gmp_version},
          {"library_hdf5", fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE)},
          {"library_mpfr", mpfr_get_version()},
          {"library_openssl", OpenSSL_version(OPENSSL_VERSION_STRING)},
          {"library_tbb", TBB_runtime_version()},
          {"library_tomlplusplus",
           fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)}};
}

std::string utc_now() {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

}  // namespace fracbench
