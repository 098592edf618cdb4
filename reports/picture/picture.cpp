#include "reports/picture/picture.h"

#include <png.h>

#include <algorithm>
#include <stdexcept>

namespace fracbench {

void paste(const Picture& from, int x, int y, Picture& to) {
  const int columns = std::min(from.width, to.width - x);
  for (int row = 0; row < std::min(from.height, to.height - y); ++row) {
    const auto begin = from.rgb.begin() + std::ptrdiff_t{3} * row * from.width;
    std::copy(begin, begin + std::ptrdiff_t{3} * columns,
              to.rgb.begin() + std::ptrdiff_t{3} * ((y + row) * to.width + x));
  }
}

std::string png_bytes(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  if (!png_image_write_to_memory(&image, nullptr, &size, 0, picture.rgb.data(), 0, nullptr)) {
    throw std::runtime_error(image.message);
  }
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr)) {
    throw std::runtime_error(image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace fracbench
