#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <string>
#include <string_view>

namespace fracbench {

/// Reads gzipped (or zlib) data from a stream.
class GzipStream {
 public:
  /// `file` is its name in messages. The stream must outlive this object.
  GzipStream(std::istream& input, std::string_view file);
  ~GzipStream();
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  /// The number of bytes read; fewer than asked for at the end of the data only. Throws InputError
  /// where the data are damaged or the stream ends before they do.
  std::size_t read(char* to, std::size_t bytes);

 private:
  struct State;

  std::istream& input_;
  std::string file_;
  std::unique_ptr<State> state_;
};

}  // namespace fracbench
