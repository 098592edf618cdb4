#include "geometry/write_vtk.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <span>
#include <stdexcept>

#include "core/atomic_file.h"

namespace fracbench {
namespace {

static_assert(std::endian::native == std::endian::little);

/// The arrays of a file: their elements in XML and their bytes, each after its length.
class Appended {
 public:
  template <typename T>
  std::string add(const std::string& name, const char* type, int components,
                  std::span<const T> values) {
    const std::size_t offset = bytes_.size();
    const std::uint64_t size = values.size_bytes();
    bytes_.resize(offset + sizeof size + size);
    std::memcpy(bytes_.data() + offset, &size, sizeof size);
    if (size > 0) std::memcpy(bytes_.data() + offset + sizeof size, values.data(), size);
    return fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, offset);
  }
  std::string add(const VtkArray& array, std::size_t count) {
    if (array.values.size() != count * static_cast<std::size_t>(array.components)) {
      throw std::logic_error("VTK array '" + array.name + "' has the wrong length");
    }
    return add<float>(array.name, "Float32", array.components, array.values);
  }
  void write(const std::filesystem::path& path, const char* type, const std::string& content) {
    std::string file = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n{}<AppendedData "
        "encoding=\"raw\">\n_",
        type, content);
    file += bytes_;
    file += "\n</AppendedData>\n</VTKFile>\n";
    write_file_atomically(path, file);
  }

 private:
  std::string bytes_;
};

}  // namespace

void write_vtp(const std::filesystem::path& path, const TriangleMesh& mesh, const VtkData& data) {
  Appended appended;
  std::vector<double> points;
  for (const Vec3& v : mesh.vertices) points.insert(points.end(), {v.x(), v.y(), v.z()});
  std::vector<std::int32_t> corners, ends;
  for (const Face& face : mesh.faces) {
    corners.insert(corners.end(), face.begin(), face.end());
    ends.push_back(static_cast<std::int32_t>(corners.size()));
  }
  std::string xml =
      fmt::format("<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n<PointData>\n",
                  mesh.vertices.size(), mesh.faces.size());
  for (const VtkArray& array : data.on_vertices) xml += appended.add(array, mesh.vertices.size());
  xml += "</PointData>\n<CellData>\n";
  for (const VtkArray& array : data.on_faces) xml += appended.add(array, mesh.faces.size());
  xml += "</CellData>\n<Points>\n";
  xml += appended.add<double>("Points", "Float64", 3, points);
  xml += "</Points>\n<Polys>\n";
  xml += appended.add<std::int32_t>("connectivity", "Int32", 1, corners);
  xml += appended.add<std::int32_t>("offsets", "Int32", 1, ends);
  xml += "</Polys>\n</Piece>\n</PolyData>\n";
  appended.write(path, "PolyData", xml);
}

void write_vti(const std::filesystem::path& path, const VoxelGrid<std::int32_t>& labels) {
  Appended appended;
  const std::string extent =
      fmt::format("0 {} 0 {} 0 {}", labels.size[0] - 1, labels.size[1] - 1, labels.size[2] - 1);
  std::string xml = fmt::format(
      "<ImageData WholeExtent=\"{0}\" Origin=\"{1} {2} {3}\" Spacing=\"{4} {4} {4}\">\n"
      "<Piece Extent=\"{0}\">\n<PointData Scalars=\"label\">\n",
      extent, labels.origin.x(), labels.origin.y(), labels.origin.z(), labels.spacing);
  xml += appended.add<std::int32_t>("label", "Int32", 1, labels.values);
  xml += "</PointData>\n</Piece>\n</ImageData>\n";
  appended.write(path, "ImageData", xml);
}

}  // namespace fracbench
