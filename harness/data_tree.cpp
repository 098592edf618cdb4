#include "harness/data_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace fracbench {

namespace {

using Type = DataTree::Type;
using Array = DataTree::Array;

template <typename T>
Array make_array(Type type, std::span<const T> values, std::vector<std::uint64_t> shape) {
  const auto bytes = std::as_bytes(values);
  return {type, sizeof(T), std::move(shape), {bytes.begin(), bytes.end()}};
}

template <typename T>
std::vector<std::uint64_t> shape_of(std::span<const T> values, std::size_t columns) {
  if (columns == 0) return {values.size()};
  if (values.size() % columns != 0) throw std::logic_error("rows of unequal length");
  return {values.size() / columns, columns};
}

Array make_text(std::span<const std::string_view> texts, std::vector<std::uint64_t> shape) {
  std::size_t longest = 1;
  for (const std::string_view text : texts) longest = std::max(longest, text.size());
  Array array{Type::text, longest, std::move(shape), {}};
  array.bytes.resize(longest * texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;
    std::memcpy(array.bytes.data() + i * longest, texts[i].data(), texts[i].size());
  }
  return array;
}

const Array& get(const DataTree& tree, std::string_view path, Type type, std::size_t rank) {
  const auto found = tree.arrays().find(path);
  if (found == tree.arrays().end()) throw DataError(fmt::format("'{}' is missing", path));
  if (found->second.type != type || found->second.shape.size() != rank) {
    throw DataError(fmt::format("'{}' has the wrong type or rank", path));
  }
  return found->second;
}

template <typename T>
std::vector<T> values_of(const Array& array) {
  std::vector<T> values(array.bytes.size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
  return values;
}

template <typename T>
std::vector<T> get_list(const DataTree& tree, std::string_view path, Type type,
                        std::size_t columns) {
  const Array& array = get(tree, path, type, columns == 0 ? 1 : 2);
  if (columns != 0 && array.shape[1] != columns) {
    throw DataError(fmt::format("'{}' must have {} columns", path, columns));
  }
  return values_of<T>(array);
}

std::string text_at(const Array& array, std::size_t index) {
  const char* start =
      reinterpret_cast<const char*>(array.bytes.data()) + index * array.element_size;
  return {start, ::strnlen(start, array.element_size)};
}

}  // namespace

void DataTree::put(std::string_view path, double value) {
  put_array(std::string(path), make_array<double>(Type::float64, {&value, 1}, {}));
}

void DataTree::put(std::string_view path, std::int64_t value) {
  put_array(std::string(path), make_array<std::int64_t>(Type::int64, {&value, 1}, {}));
}

void DataTree::put(std::string_view path, std::uint64_t value) {
  put_array(std::string(path), make_array<std::uint64_t>(Type::uint64, {&value, 1}, {}));
}

void DataTree::put(std::string_view path, std::string_view text) {
  put_array(std::string(path), make_text({&text, 1}, {}));
}

void DataTree::put(std::string_view path, std::span<const double> values, std::size_t columns) {
  put_array(std::string(path), make_array(Type::float64, values, shape_of(values, columns)));
}

void DataTree::put(std::string_view path, std::span<const std::int32_t> values,
                   std::size_t columns) {
  put_array(std::string(path), make_array(Type::int32, values, shape_of(values, columns)));
}

void DataTree::put(std::string_view path, std::span<const std::uint64_t> values) {
  put_array(std::string(path), make_array(Type::uint64, values, shape_of(values, 0)));
}

void DataTree::put(std::string_view path, std::span<const std::string> texts) {
  const std::vector<std::string_view> views(texts.begin(), texts.end());
  put_array(std::string(path), make_text(views, {texts.size()}));
}

double DataTree::real(std::string_view path) const {
  return values_of<double>(get(*this, path, Type::float64, 0)).at(0);
}

std::int64_t DataTree::integer(std::string_view path) const {
  return values_of<std::int64_t>(get(*this, path, Type::int64, 0)).at(0);
}

std::uint64_t DataTree::word(std::string_view path) const {
  return values_of<std::uint64_t>(get(*this, path, Type::uint64, 0)).at(0);
}

std::string DataTree::text(std::string_view path) const {
  return text_at(get(*this, path, Type::text, 0), 0);
}

std::vector<double> DataTree::reals(std::string_view path, std::size_t columns) const {
  return get_list<double>(*this, path, Type::float64, columns);
}

std::vector<std::int32_t> DataTree::integers(std::string_view path, std::size_t columns) const {
  return get_list<std::int32_t>(*this, path, Type::int32, columns);
}

std::vector<std::uint64_t> DataTree::words(std::string_view path) const {
  return get_list<std::uint64_t>(*this, path, Type::uint64, 0);
}

std::vector<std::string> DataTree::texts(std::string_view path) const {
  const Array& array = get(*this, path, Type::text, 1);
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < array.shape[0]; ++i) texts.push_back(text_at(array, i));
  return texts;
}

std::string DataTree::digest() const {
  Digest digest;
  for (const auto& [path, array] : arrays_) {
    digest.add(std::string_view(path));
    digest.add(static_cast<std::uint64_t>(array.type));
    digest.add(static_cast<std::uint64_t>(array.element_size));
    digest.add(static_cast<std::uint64_t>(array.shape.size()));
    for (const std::uint64_t extent : array.shape) digest.add(extent);
    digest.add(std::span<const std::byte>(array.bytes));
  }
  return digest.hex();
}

}  // namespace fracbench
