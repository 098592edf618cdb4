#include "geometry/label_volume/hdf5_volume.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "geometry/label_volume/checked_grid.h"
#include "geometry/label_volume/child_process.h"

namespace fracbench {
namespace {

/// Closes an identifier when it goes out of scope.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  Close close_;
};

/// Used in a child process only: damaged files can bring the library down.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file)
      : name_(file.string()), file_(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (!file_.valid()) fail("is an HDF5 file that cannot be opened: it is damaged or cut short");
  }

  VoxelGrid<std::int32_t> read() const {
    if (H5Lexists(file_, "labels", H5P_DEFAULT) <= 0) {
      fail(
          "has no dataset 'labels' at its top; write the labels there, as integers of shape "
          "(nz, ny, nx)");
    }
    const Handle dataset(H5Dopen2(file_, "labels", H5P_DEFAULT), H5Dclose);
    if (!dataset.valid()) fail("'labels' is no dataset, or is damaged");
    const Handle type(H5Dget_type(dataset), H5Tclose);
    if (!type.valid() || H5Tget_class(type) != H5T_INTEGER) {
      fail("dataset 'labels' does not hold integers; store labels as integers, e.g. int32");
    }
    const Vec3 origin = read_origin(dataset);
    const double spacing = read_spacing(dataset);

    const Handle space(H5Dget_space(dataset), H5Sclose);
    const int rank = space.valid() ? H5Sget_simple_extent_ndims(space) : -1;
    if (rank != 3) {
      fail(fmt::format("dataset 'labels' has {} dimensions; it needs 3: (nz, ny, nx)", rank));
    }
    hsize_t shape[3] = {0, 0, 0};
    H5Sget_simple_extent_dims(space, shape, nullptr);

    // Wider types are read as such, so that no label is cut to 32 bits unseen. The labels are there
    // twice, in this process and in that which asked for them.
    const std::size_t bytes = H5Tget_size(type);
    const bool is_signed = H5Tget_sign(type) != H5T_SGN_NONE;
    const bool fits = bytes < 4 || (bytes == 4 && is_signed);
    const auto size = checked_size({shape[2], shape[1], shape[0]}, fits ? 8 : 16, name_);
    VoxelGrid<std::int32_t> labels(size, origin, spacing);
    if (fits) {
      read_values(dataset, H5T_NATIVE_INT32, labels.values.data());
    } else if (is_signed) {
      read_wide<std::int64_t>(dataset, H5T_NATIVE_INT64, labels);
    } else {
      read_wide<std::uint64_t>(dataset, H5T_NATIVE_UINT64, labels);
    }
    return labels;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", name_, what));
  }

  void read_values(hid_t dataset, hid_t type, void* values) const {
    if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) {
      fail("dataset 'labels' cannot be read: the file is damaged or cut short");
    }
  }

  template <typename Wide>
  void read_wide(hid_t dataset, hid_t type, VoxelGrid<std::int32_t>& labels) const {
    std::vector<Wide> wide(labels.values.size());
    read_values(dataset, type, wide.data());
    for (std::size_t v = 0; v < wide.size(); ++v) {
      if (!std::in_range<std::int32_t>(wide[v])) {
        fail(
            fmt::format("dataset 'labels' holds {} (value {} in file order); labels are 32-bit "
                        "integers: renumber them",
                        wide[v], v));
      }
      labels.values[v] = static_cast<std::int32_t>(wide[v]);
    }
  }

  /// One or three finite numbers.
  std::vector<double> read_attribute(hid_t dataset, const char* name) const {
    if (H5Aexists(dataset, name) <= 0) {
      fail(
          fmt::format("dataset 'labels' has no attribute '{}', so the place of its voxels is not "
                      "known; set 'origin' to the centre of the first voxel (3 numbers) and "
                      "'spacing' to the distance between voxels",
                      name));
    }
    const Handle attribute(H5Aopen(dataset, name, H5P_DEFAULT), H5Aclose);
    const Handle type(attribute.valid() ? H5Aget_type(attribute) : -1, H5Tclose);
    const Handle space(attribute.valid() ? H5Aget_space(attribute) : -1, H5Sclose);
    const H5T_class_t kind = type.valid() ? H5Tget_class(type) : H5T_NO_CLASS;
    const hssize_t count = space.valid() ? H5Sget_simple_extent_npoints(space) : -1;
    if ((kind != H5T_FLOAT && kind != H5T_INTEGER) || (count != 1 && count != 3)) {
      fail(fmt::format("attribute '{}' of 'labels' does not hold one or three numbers", name));
    }
    std::vector<double> values(static_cast<std::size_t>(count));
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0) {
      fail(fmt::format("attribute '{}' of 'labels' cannot be read: the file is damaged", name));
    }
    for (const double value : values) {
      if (!std::isfinite(value)) fail(fmt::format("attribute '{}' holds {}", name, value));
    }
    return values;
  }

  Vec3 read_origin(hid_t dataset) const {
    const std::vector<double> values = read_attribute(dataset, "origin");
    if (values.size() != 3) fail("attribute 'origin' of 'labels' has one number; it needs 3");
    return {values[0], values[1], values[2]};
  }

  double read_spacing(hid_t dataset) const {
    std::vector<double> values = read_attribute(dataset, "spacing");
    values.resize(3, values[0]);
    return checked_spacing({values[0], values[1], values[2]}, "attribute 'spacing'", name_);
  }

  std::string name_;
  Handle file_;
};

/// What goes through the pipe before the labels, or before a message of `bytes` characters.
struct Announcement {
  bool is_message = false;
  std::uint64_t bytes = 0;
  std::array<std::int32_t, 3> size{};
  std::array<double, 3> origin{};
  double spacing = 0;
};

void send_message(const Pipe& out, std::string_view message) {
  const Announcement announcement{.is_message = true, .bytes = message.size()};
  out.write(&announcement, sizeof(announcement));
  out.write(message.data(), message.size());
}

void send_volume(const Pipe& out, const std::filesystem::path& file) {
  try {
    const VoxelGrid<std::int32_t> labels = Reader(file).read();
    const Announcement announcement{
        .bytes = labels.values.size() * sizeof(std::int32_t),
        .size = labels.size,
        .origin = {labels.origin.x(), labels.origin.y(), labels.origin.z()},
        .spacing = labels.spacing};
    out.write(&announcement, sizeof(announcement));
    out.write(labels.values.data(), announcement.bytes);
  } catch (const InputError& error) {
    send_message(out, error.what());
  }
}

}  // namespace

bool is_hdf5(const std::filesystem::path& file) {
  // The signature stands at 0, or at 512 or a doubling of it behind a block of the user's own.
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::ifstream input(file, std::ios::binary);
  std::array<char, signature.size()> bytes{};
  for (std::streamoff at = 0; input.seekg(at) && input.read(bytes.data(), bytes.size());
       at = at == 0 ? 512 : 2 * at) {
    if (std::string_view(bytes.data(), bytes.size()) == signature) return true;
  }
  return false;
}

VoxelGrid<std::int32_t> read_hdf5_volume(const std::filesystem::path& file) {
  VoxelGrid<std::int32_t> labels;
  std::string message;
  const bool arrived = run_in_child(
      [&](const Pipe& out) { send_volume(out, file); },
      [&](const Pipe& in) {
        Announcement announcement;
        if (!in.read(&announcement, sizeof(announcement))) return false;
        if (announcement.is_message) {
          message.resize(announcement.bytes);
          return in.read(message.data(), message.size());
        }
        const auto& origin = announcement.origin;
        labels = VoxelGrid<std::int32_t>(announcement.size, {origin[0], origin[1], origin[2]},
                                         announcement.spacing);
        return in.read(labels.values.data(), labels.values.size() * sizeof(std::int32_t));
      });
  if (!arrived) {
    throw InputError(fmt::format(
        "{}: the HDF5 library fails on it: the file is damaged, or memory ran out", file.string()));
  }
  if (!message.empty()) throw InputError(message);
  return labels;
}

}  // namespace fracbench
