#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/array_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "methods/modes/model.h"

namespace fracbench::modes {
namespace {

constexpr const char* kFileName = "model.fracbench";
constexpr ArrayFileKind kModelKind{.format = "fracbench modes", .version = 1};

ArrayFile read_model_file(const std::filesystem::path& file) {
  try {
    return read_array_file(file, kModelKind);
  } catch (const InputError& error) {
    throw InputError(fmt::format("modes: {}; prepare the model again", error.what()));
  }
}

std::string digest_of(const TriangleMesh& mesh) {
  Digest digest;
  digest.add(mesh);
  return digest.hex();
}

std::vector<double> coordinates(const std::vector<Vec3>& points) {
  std::vector<double> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points) values.insert(values.end(), {p.x(), p.y(), p.z()});
  return values;
}

/// Reads named arrays; what is missing or out of range is an InputError.
class Reader {
 public:
  explicit Reader(const ArrayFile& arrays) : arrays_(arrays) {}

  const std::vector<double>& reals(const std::string& name) const {
    return find(arrays_.reals, name);
  }
  const std::string& text(const std::string& name) const { return find(arrays_.texts, name); }

  /// Numbers from `low` to below `high`, a multiple of `columns` of them.
  const std::vector<std::int32_t>& indices(const std::string& name, std::int64_t low,
                                           std::int64_t high, std::size_t columns = 1) const {
    const auto& values = find(arrays_.integers, name);
    require(values.size() % columns == 0, name);
    for (const std::int32_t value : values) require(value >= low && value < high, name);
    return values;
  }

  std::vector<Vec3> points(const std::string& name) const {
    const auto& values = reals(name);
    require(values.size() % 3 == 0, name);
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < values.size(); n += 3) {
      points.emplace_back(values[n], values[n + 1], values[n + 2]);
    }
    return points;
  }

  static void require(bool holds, const std::string& name) {
    if (!holds) {
      throw InputError(
          fmt::format("modes: the prepared model's array '{}' does not fit the others; prepare it "
                      "again",
                      name));
    }
  }

 private:
  template <typename Map>
  static const typename Map::mapped_type& find(const Map& map, const std::string& name) {
    const auto at = map.find(name);
    if (at == map.end()) {
      throw InputError(
          fmt::format("modes: the prepared model has no array '{}'; prepare it again", name));
    }
    return at->second;
  }

  const ArrayFile& arrays_;
};

void store(const CutBody& cut, ArrayFile& file) {
  file.reals["cut/vertices"] = coordinates(cut.vertices);
  file.integers["cut/may_pinch"] = {cut.may_pinch.begin(), cut.may_pinch.end()};
  auto& surface = file.integers["cut/surface"];  // corners, cell, source
  for (const auto& [c, cell, source] : cut.surface) {
    surface.insert(surface.end(), {c[0], c[1], c[2], cell, source});
  }
  auto& interfaces = file.integers["cut/interfaces"];  // corners, cells
  for (const auto& [c, cells] : cut.interfaces) {
    interfaces.insert(interfaces.end(), {c[0], c[1], c[2], cells[0], cells[1]});
  }
  for (const auto& [region, volume] : cut.cells) {
    file.integers["cut/region"].push_back(region);
    file.reals["cut/volume"].push_back(volume);
  }
}

CutBody cut_from(const Reader& read, std::size_t body_faces) {
  CutBody cut;
  cut.vertices = read.points("cut/vertices");
  const auto vertex_count = std::ssize(cut.vertices);
  const auto& pinch = read.indices("cut/may_pinch", 0, 2);
  Reader::require(pinch.size() == cut.vertices.size(), "cut/may_pinch");
  cut.may_pinch.assign(pinch.begin(), pinch.end());
  const auto& volumes = read.reals("cut/volume");
  const auto& regions = read.indices("cut/region", 0, std::int64_t{1} << 31);
  Reader::require(regions.size() == volumes.size() && !volumes.empty(), "cut/region");
  for (std::size_t c = 0; c < volumes.size(); ++c) cut.cells.push_back({regions[c], volumes[c]});
  const auto within = [](std::int32_t value, std::int64_t count, const char* name) {
    Reader::require(value >= 0 && value < count, name);
    return value;
  };
  const auto corners = [&](const std::int32_t* at, const char* name) {
    for (int k = 0; k < 3; ++k) within(at[k], vertex_count, name);
    return Face{at[0], at[1], at[2]};
  };
  const auto& surface = read.indices("cut/surface", 0, std::int64_t{1} << 31, 5);
  for (std::size_t n = 0; n < surface.size(); n += 5) {
    cut.surface.push_back(
        {corners(&surface[n], "cut/surface"),
         within(surface[n + 3], std::ssize(cut.cells), "cut/surface"),
         within(surface[n + 4], static_cast<std::int64_t>(body_faces), "cut/surface")});
  }
  const auto& interfaces = read.indices("cut/interfaces", 0, std::int64_t{1} << 31, 5);
  for (std::size_t n = 0; n < interfaces.size(); n += 5) {
    CutBody::InterfacePart part{corners(&interfaces[n], "cut/interfaces"), {}};
    for (int side = 0; side < 2; ++side) {
      part.cells[side] = within(interfaces[n + 3 + side], std::ssize(cut.cells), "cut/interfaces");
    }
    cut.interfaces.push_back(part);
  }
  return cut;
}

void store(const ImpactProjection& projection, ArrayFile& file) {
  const Vec3& c = projection.frame.center;
  file.reals["projection/frame"] = {c.x(), c.y(), c.z(), projection.frame.size};
  file.reals["projection/vertices"] = coordinates(projection.vertices);
  const auto& w = projection.response;
  file.reals["projection/response"] = {w.data(), w.data() + w.size()};  // a column after the other
  file.integers["projection/piece_begin"] = projection.piece_begin;
  file.integers["projection/piece_at"] = projection.piece_at;
  auto& pieces = file.integers["projection/bond_pieces"];
  auto& areas = file.reals["projection/bond_area"];
  for (const auto& bond : projection.bonds) {
    pieces.insert(pieces.end(), bond.pieces.begin(), bond.pieces.end());
    areas.push_back(bond.area);
  }
}

ImpactProjection projection_from(const Reader& read, std::size_t pieces) {
  ImpactProjection projection;
  const auto& frame = read.reals("projection/frame");
  Reader::require(frame.size() == 4 && frame[3] > 0, "projection/frame");
  projection.frame = {Vec3(frame[0], frame[1], frame[2]), frame[3]};
  projection.vertices = read.points("projection/vertices");
  const std::size_t vertices = projection.vertices.size();
  const auto& response = read.reals("projection/response");
  Reader::require(response.size() == vertices * pieces, "projection/response");
  projection.response = Eigen::Map<const Eigen::MatrixXd>(
      response.data(), static_cast<Eigen::Index>(vertices), static_cast<Eigen::Index>(pieces));
  const auto count = static_cast<std::int64_t>(pieces);
  projection.piece_at = read.indices("projection/piece_at", 0, count);
  projection.piece_begin =
      read.indices("projection/piece_begin", 0, std::ssize(projection.piece_at) + 1);
  Reader::require(projection.piece_begin.size() == vertices + 1 &&
                      std::ranges::is_sorted(projection.piece_begin),
                  "projection/piece_begin");
  const auto& bonds = read.indices("projection/bond_pieces", 0, count, 2);
  const auto& areas = read.reals("projection/bond_area");
  Reader::require(bonds.size() == 2 * areas.size(), "projection/bond_area");
  for (std::size_t n = 0; n < areas.size(); ++n) {
    projection.bonds.push_back({{bonds[2 * n], bonds[2 * n + 1]}, areas[n]});
  }
  return projection;
}

}  // namespace

void save_model(const std::filesystem::path& folder, const Model& model) {
  const ModelData& data = model.data();
  ArrayFile file;
  file.texts["body"] = digest_of(model.body());
  file.texts["settings"] = data.settings;
  store(data.cut, file);
  store(data.projection, file);
  file.reals["typical_jump"] = {data.typical_jump};
  file.reals["mode_energies"] = data.mode_energies;
  file.integers["mode_pieces"] = data.mode_pieces;
  write_array_file(folder / kFileName, file, kModelKind);
}

ModelData load_model(const std::filesystem::path& folder, const Target& target,
                     const std::string& settings) {
  const ArrayFile file = read_model_file(folder / kFileName);
  const Reader read(file);
  if (read.text("body") != digest_of(target.mesh)) {
    throw InputError(
        fmt::format("modes: the prepared model in '{}' is not of the body '{}'; prepare "
                    "it again",
                    folder.string(), target.name));
  }
  if (read.text("settings") != settings) {
    throw InputError(
        fmt::format("modes: the prepared model in '{}' was made with the settings {}, wanted are "
                    "{}; prepare it again",
                    folder.string(), read.text("settings"), settings));
  }
  ModelData data;
  data.settings = settings;
  data.cut = cut_from(read, target.mesh.faces.size());
  data.projection = projection_from(read, data.cut.cells.size());
  const auto& jump = read.reals("typical_jump");
  Reader::require(jump.size() == 1, "typical_jump");
  data.typical_jump = jump[0];
  data.mode_energies = read.reals("mode_energies");
  data.mode_pieces = read.indices("mode_pieces", 0, std::int64_t{1} << 31);
  return data;
}

}  // namespace fracbench::modes
