#include "harness/machine_load.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <thread>

namespace fracbench {

namespace {

/// Clock ticks of all processors since the machine was started, without those in which they idled
/// or waited for a disk.
double busy_ticks() {
  std::ifstream statistics("/proc/stat");
  std::string name;
  double user = 0, nice = 0, system = 0, idle = 0, wait = 0, interrupts = 0, soft = 0, stolen = 0;
  statistics >> name >> user >> nice >> system >> idle >> wait >> interrupts >> soft >> stolen;
  return user + nice + system + interrupts + soft + stolen;
}

}  // namespace

std::string MachineLoad::describe() const {
  return fmt::format("{} processors, {:.2f} of them at work, load average {:.2f}", processors, busy,
                     load);
}

MachineLoad measure_load(std::chrono::milliseconds time) {
  const double before = busy_ticks();
  const auto start = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(time);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  MachineLoad load;
  const auto ticks = static_cast<double>(::sysconf(_SC_CLK_TCK));
  load.busy = (busy_ticks() - before) / ticks / seconds.count();
  load.processors = static_cast<int>(std::thread::hardware_concurrency());
  std::ifstream("/proc/loadavg") >> load.load;
  return load;
}

}  // namespace fracbench
