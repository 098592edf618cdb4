#include "harness/workers/worker_spawner.h"

#include <utility>

namespace fracbench {

WorkerSpawner::WorkerSpawner(std::vector<std::string> command)
    : command_(std::move(command)), thread_([this] { serve(); }) {}

WorkerSpawner::~WorkerSpawner() {
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::unique_ptr<WorkerProcess> WorkerSpawner::start() {
  Request request;
  std::unique_lock lock(mutex_);
  requests_.push_back(&request);
  changed_.notify_all();
  changed_.wait(lock, [&] { return request.done; });
  if (request.error) std::rethrow_exception(request.error);
  return std::move(request.worker);
}

void WorkerSpawner::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !requests_.empty(); });
    if (ending_) return;
    for (Request* request : std::exchange(requests_, {})) {
      try {
        request->worker = std::make_unique<WorkerProcess>(command_);
      } catch (...) {
        request->error = std::current_exception();
      }
      request->done = true;
    }
    changed_.notify_all();
  }
}

}  // namespace fracbench
