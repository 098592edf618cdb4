#include "harness/data_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "harness/hdf5_handle.h"
#include "harness/superblock.h"

namespace fracbench {

namespace {

using Type = DataTree::Type;
using Array = DataTree::Array;

// Below this an array lies in its object header; the header's limit is 64 KiB.
constexpr std::size_t kCompactBytes = 1024;
// From here on compression saves more than the chunk index costs.
constexpr std::size_t kCompressedBytes = 4096;
// Within the cache of a core, and a power of two below the default chunk cache of HDF5 (1 MiB).
constexpr std::size_t kChunkBytes = 1 << 19;
// Level 1 is three times as fast as the default and the files are 3 % larger.
constexpr unsigned kDeflateLevel = 1;

// What a file may unpack to, so that a small one cannot fill the memory.
constexpr std::uint64_t kMaximumGrowth = 100;
constexpr std::uint64_t kAlwaysAllowed = 64 << 20;
constexpr std::size_t kMaximumObjects = 1000;
constexpr int kMaximumDepth = 8;
constexpr std::size_t kMaximumName = 256;

/// HDF5 keeps global state, which only some builds of it protect.
std::unique_lock<std::mutex> lock_hdf5() {
  static std::mutex mutex;
  std::unique_lock lock(mutex);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are ours to report
  return lock;
}

void check(herr_t status, std::string_view what) {
  if (status < 0) throw DataError(fmt::format("HDF5: {} failed", what));
}

Hdf5Handle text_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "making a text type");
  check(H5Tset_size(type, size), "sizing a text type");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "padding a text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "coding a text type");
  return type;
}

Hdf5Handle file_type(Type type, std::size_t element_size) {
  switch (type) {
    case Type::int32:
      return {H5Tcopy(H5T_STD_I32LE), H5Tclose, "copying a type"};
    case Type::int64:
      return {H5Tcopy(H5T_STD_I64LE), H5Tclose, "copying a type"};
    case Type::uint64:
      return {H5Tcopy(H5T_STD_U64LE), H5Tclose, "copying a type"};
    case Type::float64:
      return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose, "copying a type"};
    case Type::text:
      break;
  }
  return text_type(element_size);
}

Hdf5Handle data_space(const std::vector<std::uint64_t>& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "making a scalar"};
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr), H5Sclose,
          "making an array"};
}

Hdf5Handle untimed(hid_t property_class) {
  Hdf5Handle list(H5Pcreate(property_class), H5Pclose, "making a property list");
  check(H5Pset_obj_track_times(list, false), "leaving out times");
  return list;
}

Hdf5Handle layout(const Array& array, bool packed) {
  Hdf5Handle list = untimed(H5P_DATASET_CREATE);
  const std::size_t size = array.bytes.size();
  if (size > 0 && size <= kCompactBytes) {
    check(H5Pset_layout(list, H5D_COMPACT), "choosing a layout");
  } else if (packed && size >= kCompressedBytes && !array.shape.empty()) {
    std::vector<hsize_t> chunk(array.shape.begin(), array.shape.end());
    const std::size_t row = size / array.shape[0];
    chunk[0] = std::clamp<hsize_t>(kChunkBytes / row, 1, array.shape[0]);
    check(H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()), "choosing chunks");
    check(H5Pset_shuffle(list), "choosing a filter");
    check(H5Pset_deflate(list, kDeflateLevel), "choosing a filter");
  }
  return list;
}

void make_parents(hid_t file, std::string_view path, std::set<std::string>& made) {
  for (std::size_t slash = path.find('/'); slash != std::string_view::npos;
       slash = path.find('/', slash + 1)) {
    const std::string group(path.substr(0, slash));
    if (!made.insert(group).second) continue;
    const Hdf5Handle properties = untimed(H5P_GROUP_CREATE);
    const Hdf5Handle handle(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT),
                            H5Gclose, "making group " + group);
  }
}

void write_array(hid_t file, const std::string& path, const Array& array, bool packed) {
  const Hdf5Handle type = file_type(array.type, array.element_size);
  const Hdf5Handle space = data_space(array.shape);
  const Hdf5Handle properties = layout(array, packed);
  const Hdf5Handle data(
      H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
      "making " + path);
  if (array.bytes.empty()) return;
  check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.bytes.data()), "writing " + path);
}

/// Reads what is below a group of an open file.
class Reader {
 public:
  Reader(const ArrayFilter& filter, std::uint64_t file_size)
      : filter_(filter), budget_(kAlwaysAllowed + kMaximumGrowth * file_size) {}

  void read_group(hid_t group, const std::string& prefix, int depth) {
    H5G_info_t info;
    check(H5Gget_info(group, &info), "listing a group");
    if (depth > kMaximumDepth || info.nlinks > kMaximumObjects) {
      throw DataError("has too many groups or arrays");
    }
    for (hsize_t i = 0; i < info.nlinks; ++i) read_link(group, prefix, i, depth);
  }

  DataTree take() { return std::move(tree_); }

 private:
  void read_link(hid_t group, const std::string& prefix, hsize_t index, int depth) {
    if (++objects_ > kMaximumObjects) throw DataError("has too many groups or arrays");
    char name[kMaximumName + 1];
    const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, index, name,
                                              sizeof name, H5P_DEFAULT);
    if (length <= 0 || length > static_cast<ssize_t>(kMaximumName)) {
      throw DataError("has a name that cannot be read");
    }
    const std::string path = prefix.empty() ? name : prefix + "/" + name;
    H5L_info_t link;
    check(H5Lget_info(group, name, &link, H5P_DEFAULT), "looking at " + path);
    if (link.type != H5L_TYPE_HARD) throw DataError("'" + path + "' is a link to elsewhere");
    H5O_info_t object;
    check(H5Oget_info_by_name2(group, name, &object, H5O_INFO_BASIC, H5P_DEFAULT),
          "looking at " + path);
    if (object.type == H5O_TYPE_GROUP) {
      const Hdf5Handle child(H5Gopen2(group, name, H5P_DEFAULT), H5Gclose, "opening " + path);
      read_group(child, path, depth + 1);
    } else if (object.type == H5O_TYPE_DATASET) {
      if (!filter_ || filter_(path)) tree_.put_array(path, read_array(group, name, path));
    } else {
      throw DataError("'" + path + "' is neither a group nor an array");
    }
  }

  Array read_array(hid_t group, const char* name, const std::string& path) {
    const Hdf5Handle data(H5Dopen2(group, name, H5P_DEFAULT), H5Dclose, "opening " + path);
    const Hdf5Handle type(H5Dget_type(data), H5Tclose, "reading the type of " + path);
    Array array;
    array.type = known_type(type, path);
    array.element_size = H5Tget_size(type);
    array.shape = read_shape(data, path);
    check_layout(data, path);
    std::uint64_t size = array.element_size;
    for (const std::uint64_t extent : array.shape) size = take_product(size, extent, path);
    if (size > budget_) refuse_size(path);
    budget_ -= size;
    array.bytes.resize(size);
    if (size > 0) {
      check(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.bytes.data()),
            "reading " + path);
    }
    return array;
  }

  static Type known_type(hid_t type, const std::string& path) {
    for (const Type known : {Type::int32, Type::int64, Type::uint64, Type::float64}) {
      if (H5Tequal(type, file_type(known, 8)) > 0) return known;
    }
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 && size > 0 &&
        H5Tequal(type, text_type(size)) > 0) {
      return Type::text;
    }
    throw DataError("'" + path + "' has a type that no record has");
  }

  static std::vector<std::uint64_t> read_shape(hid_t data, const std::string& path) {
    const Hdf5Handle space(H5Dget_space(data), H5Sclose, "reading the shape of " + path);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (H5Sis_simple(space) <= 0 || H5Sget_simple_extent_type(space) == H5S_NULL || rank < 0 ||
        rank > 2) {
      throw DataError("'" + path + "' has a shape that no record has");
    }
    hsize_t extents[2] = {0, 0};
    if (rank > 0) {
      check(H5Sget_simple_extent_dims(space, extents, nullptr), "reading the shape of " + path);
    }
    return {extents, extents + rank};
  }

  void check_layout(hid_t data, const std::string& path) const {
    const Hdf5Handle list(H5Dget_create_plist(data), H5Pclose, "reading the layout of " + path);
    const H5D_layout_t kind = H5Pget_layout(list);
    bool good = kind == H5D_COMPACT || kind == H5D_CONTIGUOUS || kind == H5D_CHUNKED;
    good = good && H5Pget_external_count(list) == 0;
    for (int i = 0; good && i < H5Pget_nfilters(list); ++i) {
      unsigned flags = 0;
      std::size_t values = 0;
      const H5Z_filter_t filter = H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &values,
                                                 nullptr, 0, nullptr, nullptr);
      good = filter == H5Z_FILTER_SHUFFLE || filter == H5Z_FILTER_DEFLATE;
    }
    if (!good) throw DataError("'" + path + "' is stored in a way that no record is");
    if (kind == H5D_CHUNKED) check_chunk(data, list, path);
  }

  void check_chunk(hid_t data, hid_t list, const std::string& path) const {
    hsize_t chunk[2] = {1, 1};
    if (H5Pget_chunk(list, 2, chunk) < 1) refuse_size(path);
    const Hdf5Handle type(H5Dget_type(data), H5Tclose, "reading the type of " + path);
    std::uint64_t size = H5Tget_size(type);
    for (const hsize_t extent : chunk) size = take_product(size, extent, path);
    if (size > budget_) refuse_size(path);
  }

  static std::uint64_t take_product(std::uint64_t a, std::uint64_t b, const std::string& path) {
    std::uint64_t product = 0;
    if (__builtin_mul_overflow(a, b, &product)) refuse_size(path);
    return product;
  }

  [[noreturn]] static void refuse_size(const std::string& path) {
    throw DataError("'" + path + "' claims to be far larger than its file");
  }

  const ArrayFilter& filter_;
  std::uint64_t budget_;
  std::size_t objects_ = 0;
  DataTree tree_;
};

}  // namespace

std::string to_hdf5(const DataTree& tree, const ArrayFilter& packed) {
  const auto lock = lock_hdf5();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "making a property list");
  check(H5Pset_fapl_core(access, 1 << 20, false), "writing to memory");
  // Headers with checksums and small groups, readable by every HDF5 since 1.8.
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18), "choosing a format");
  const Hdf5Handle creation = untimed(H5P_FILE_CREATE);
  const Hdf5Handle file(H5Fcreate("record", H5F_ACC_TRUNC, creation, access), H5Fclose,
                        "making a file in memory");
  std::set<std::string> groups;
  for (const auto& [path, array] : tree.arrays()) {
    make_parents(file, path, groups);
    write_array(file, path, array, !packed || packed(path));
  }
  check(H5Fflush(file, H5F_SCOPE_LOCAL), "flushing");
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  check(size < 0 ? -1 : 0, "reading the file's size");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  const ssize_t copied = H5Fget_file_image(file, bytes.data(), bytes.size());
  check(copied == size ? 0 : -1, "reading the file's bytes");
  renew_superblock_checksum(bytes);
  return bytes;
}

DataTree read_hdf5(const std::filesystem::path& file, const ArrayFilter& filter) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error);
  if (error) throw DataError(error.message());
  const auto lock = lock_hdf5();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "making a property list");
  // Records never change, and some shared file systems have no locks.
  check(H5Pset_file_locking(access, false, true), "choosing not to lock");
  const Hdf5Handle handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose,
                          "opening it (cut short or no HDF5 file)");
  const Hdf5Handle root(H5Gopen2(handle, "/", H5P_DEFAULT), H5Gclose, "opening the root");
  Reader reader(filter, size);
  reader.read_group(root, "", 0);
  return reader.take();
}

}  // namespace fracbench
