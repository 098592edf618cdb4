#include "harness/workers/tree_bytes.h"

#include <cstring>

namespace fracbench {

namespace {

constexpr std::uint64_t kMaximumRank = 2;

void put_word(std::string& bytes, std::uint64_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Takes bytes from the front of a text, never more than there are.
class Front {
 public:
  explicit Front(std::string_view bytes) : rest_(bytes) {}

  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) throw DataError("is cut short");
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }
  std::uint64_t word() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  bool empty() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  std::uint64_t result = 0;
  if (__builtin_mul_overflow(a, b, &result)) throw DataError("claims a size that is none");
  return result;
}

DataTree::Array take_array(Front& front) {
  DataTree::Array array;
  const std::uint64_t type = front.word();
  if (type > static_cast<std::uint64_t>(DataTree::Type::text)) {
    throw DataError("has an unknown type");
  }
  array.type = static_cast<DataTree::Type>(type);
  array.element_size = front.word();
  const bool fits = array.type == DataTree::Type::text    ? array.element_size > 0
                    : array.type == DataTree::Type::int32 ? array.element_size == 4
                                                          : array.element_size == 8;
  if (!fits) throw DataError("has elements of a wrong size");
  const std::uint64_t rank = front.word();
  if (rank > kMaximumRank) throw DataError("has too many dimensions");
  std::uint64_t size = array.element_size;
  for (std::uint64_t d = 0; d < rank; ++d) {
    array.shape.push_back(front.word());
    size = product(size, array.shape.back());
  }
  const std::string_view bytes = front.take(size);
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  array.bytes.assign(first, first + bytes.size());
  return array;
}

}  // namespace

std::string to_bytes(const DataTree& tree) {
  std::size_t size = 0;
  for (const auto& [path, array] : tree.arrays()) size += path.size() + array.bytes.size() + 64;
  std::string bytes;
  bytes.reserve(size);
  for (const auto& [path, array] : tree.arrays()) {
    put_word(bytes, path.size());
    bytes += path;
    put_word(bytes, static_cast<std::uint64_t>(array.type));
    put_word(bytes, array.element_size);
    put_word(bytes, array.shape.size());
    for (const std::uint64_t extent : array.shape) put_word(bytes, extent);
    bytes.append(reinterpret_cast<const char*>(array.bytes.data()), array.bytes.size());
  }
  return bytes;
}

DataTree tree_from_bytes(std::string_view bytes) {
  Front front(bytes);
  DataTree tree;
  while (!front.empty()) {
    std::string path(front.take(front.word()));
    tree.put_array(std::move(path), take_array(front));
  }
  return tree;
}

}  // namespace fracbench
