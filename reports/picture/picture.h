#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace fracbench {

/// Pixels from the upper left corner, row by row, red, green and blue.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Picture() = default;
  /// White.
  Picture(int w, int h) : width(w), height(h), rgb(3 * static_cast<std::size_t>(w) * h, 255) {}
};

/// Copies one picture into another, with its corner at (x, y); what does not fit is cut off.
void paste(const Picture& from, int x, int y, Picture& to);

/// The bytes of a PNG file; the same picture gives the same bytes with one version of libpng.
std::string png_bytes(const Picture& picture);

}  // namespace fracbench
