#include "geometry/label_volume/gzip_stream.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <new>

#include "core/error.h"

namespace fracbench {

struct GzipStream::State {
  z_stream zlib{};
  std::array<char, 1 << 16> waiting;
  bool ended = false;
};

GzipStream::GzipStream(std::istream& input, std::string_view file)
    : input_(input), file_(file), state_(std::make_unique<State>()) {
  constexpr int any_header = 32;  // gzip or zlib
  if (inflateInit2(&state_->zlib, MAX_WBITS + any_header) != Z_OK) throw std::bad_alloc();
}

GzipStream::~GzipStream() { inflateEnd(&state_->zlib); }

std::size_t GzipStream::read(char* to, std::size_t bytes) {
  z_stream& zlib = state_->zlib;
  zlib.next_out = reinterpret_cast<Bytef*>(to);
  zlib.avail_out = static_cast<uInt>(bytes);  // callers ask for one chunk at a time
  while (zlib.avail_out > 0 && !state_->ended) {
    if (zlib.avail_in == 0) {
      input_.read(state_->waiting.data(), static_cast<std::streamsize>(state_->waiting.size()));
      zlib.next_in = reinterpret_cast<Bytef*>(state_->waiting.data());
      zlib.avail_in = static_cast<uInt>(input_.gcount());
      if (zlib.avail_in == 0) {
        throw InputError(fmt::format("{}: is cut short: the gzipped data end too early", file_));
      }
    }
    const int status = inflate(&zlib, Z_NO_FLUSH);
    if (status == Z_STREAM_END) {
      state_->ended = true;
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(fmt::format("{}: the gzipped data are damaged ({})", file_,
                                   zlib.msg != nullptr ? zlib.msg : "zlib's checks fail"));
    }
  }
  return bytes - zlib.avail_out;
}

}  // namespace fracbench
