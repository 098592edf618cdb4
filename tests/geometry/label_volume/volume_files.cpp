#include "volume_files.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fracbench::test {

ScratchFile::ScratchFile(std::string_view extension) {
  static int count = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("fracbench_labels_" + std::to_string(::getpid()) + "_" + std::to_string(count++) +
           std::string(extension));
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void ScratchFile::write(std::string_view bytes) const {
  std::filesystem::remove(path_);  // some disks are slow to cut a file that is there
  std::ofstream output(path_, std::ios::binary);
  output.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string ScratchFile::read() const {
  std::ifstream input(path_, std::ios::binary);
  std::ostringstream bytes;
  bytes << input.rdbuf();
  return bytes.str();
}

std::string gzipped(std::string_view bytes) {
  z_stream zlib{};
  constexpr int gzip = 16;
  if (deflateInit2(&zlib, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + gzip, 9,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("deflateInit2");
  }
  std::string result(deflateBound(&zlib, bytes.size()) + 64, '\0');
  std::string input(bytes);
  zlib.next_in = reinterpret_cast<Bytef*>(input.data());
  zlib.avail_in = static_cast<uInt>(input.size());
  zlib.next_out = reinterpret_cast<Bytef*>(result.data());
  zlib.avail_out = static_cast<uInt>(result.size());
  deflate(&zlib, Z_FINISH);
  result.resize(zlib.total_out);
  deflateEnd(&zlib);
  return result;
}

namespace {

void write_attribute(hid_t dataset, const char* name, const std::vector<double>& values) {
  if (values.empty()) return;
  const hsize_t count = values.size();
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t attribute =
      H5Acreate2(dataset, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
  H5Aclose(attribute);
  H5Sclose(space);
}

}  // namespace

void write_hdf5(const std::filesystem::path& file, const Hdf5Volume& volume) {
  const hid_t id = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(3, volume.shape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  if (volume.compressed || volume.values.empty()) {
    const std::array<hsize_t, 3> chunk{1, std::min<hsize_t>(volume.shape[1], 64),
                                       std::min<hsize_t>(volume.shape[2], 64)};
    H5Pset_chunk(creation, 3, chunk.data());
    if (volume.compressed) H5Pset_deflate(creation, 6);
  }
  const hid_t dataset =
      H5Dcreate2(id, volume.name.c_str(), volume.type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  if (!volume.values.empty()) {
    H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, volume.values.data());
  }
  write_attribute(dataset, "origin", volume.origin);
  write_attribute(dataset, "spacing", volume.spacing);
  H5Dclose(dataset);
  H5Pclose(creation);
  H5Sclose(space);
  H5Fclose(id);
}

}  // namespace fracbench::test
