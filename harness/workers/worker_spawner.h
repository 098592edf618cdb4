#pragma once

#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "harness/workers/worker_process.h"

namespace fracbench {

/// Starts workers from a thread of its own, which must outlive them: the system ends a worker when
/// the thread that started it ends.
class WorkerSpawner {
 public:
  explicit WorkerSpawner(std::vector<std::string> command);
  ~WorkerSpawner();
  WorkerSpawner(const WorkerSpawner&) = delete;
  WorkerSpawner& operator=(const WorkerSpawner&) = delete;

  /// Throws std::system_error. From any thread.
  std::unique_ptr<WorkerProcess> start();

 private:
  struct Request {
    std::unique_ptr<WorkerProcess> worker;
    std::exception_ptr error;
    bool done = false;
  };

  void serve();

  const std::vector<std::string> command_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Request*> requests_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace fracbench
