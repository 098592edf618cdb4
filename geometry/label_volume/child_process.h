#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

namespace fracbench {

/// The end of a pipe between two processes, in which bytes are written or read whole.
class Pipe {
 public:
  explicit Pipe(int descriptor) : descriptor_(descriptor) {}
  ~Pipe();
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  /// False where the other end is gone.
  bool write(const void* bytes, std::size_t count) const;
  bool read(void* bytes, std::size_t count) const;

 private:
  int descriptor_;
};

/// Runs `work` in a child process, for libraries that damaged files can bring down, while `collect`
/// takes in this process what it writes. True where the child ended by itself and `collect`
/// returned true. What the child prints is thrown away.
/// Throws std::system_error where no process can be started.
bool run_in_child(const std::function<void(const Pipe&)>& work,
                  const std::function<bool(const Pipe&)>& collect);

}  // namespace fracbench
