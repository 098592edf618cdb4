#include "neural/data_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "core/array_file.h"
#include "core/digest.h"
#include "core/error.h"
#include "neural/made_of_file.h"

namespace fracbench::neural {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench data set", .version = 2, .packed = true};

std::string pattern_name(std::size_t k, std::string_view what) {
  return fmt::format("patterns/{:04}/{}", k, what);
}

void require(bool good, std::string_view what) {
  if (!good) throw InputError(fmt::format("its {} do not fit", what));
}

bool all_finite(const std::vector<float>& values) {
  return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

DataSet data_set_of(ArrayFile& file) {
  const auto text = [&](const char* name) {
    const auto found = file.texts.find(name);
    if (found == file.texts.end()) throw InputError(fmt::format("it has no text '{}'", name));
    return found->second;
  };
  DataSet data{
      .shapes = take_shapes(file), .provenance = text("provenance"), .features = 0, .patterns = {}};
  const std::vector<double>& unit = file.reals["field_unit"];
  require(unit.size() == 1 && std::isfinite(unit[0]) && unit[0] > 0, "field_unit");
  data.field_unit = unit[0];
  for (const std::string& name :
       nlohmann::json::parse(text("names")).get<std::vector<std::string>>()) {
    data.patterns.push_back({.name = name, .impulses = {}, .fields = {}});
  }
  const std::vector<std::int32_t>& owners = file.integers["pattern_shape"];
  require(owners.size() == data.patterns.size(), "pattern_shape");
  for (std::size_t k = 0; k < owners.size(); ++k) {
    require(owners[k] >= 0 && static_cast<std::size_t>(owners[k]) < data.shapes.size(),
            "pattern_shape");
    data.patterns[k].shape = owners[k];
  }
  for (auto& [name, values] : file.floats) {
    const std::size_t slash = name.rfind('/');
    std::size_t k = 0;
    const auto [end, error] = std::from_chars(name.data() + std::min<std::size_t>(9, name.size()),
                                              name.data() + name.size(), k);
    require(error == std::errc() && k < data.patterns.size() && slash != std::string::npos &&
                all_finite(values),
            name);
    const std::string what = name.substr(slash + 1);
    require(name == pattern_name(k, what), name);
    if (what == "impulses") {
      data.patterns[k].impulses = std::move(values);
      continue;
    }
    int r = 0;
    std::from_chars(what.data(), what.data() + what.size(), r);
    require(r >= 8 && r <= 1024 && values.size() == static_cast<std::size_t>(r) * r * r, name);
    data.patterns[k].fields[r] = std::move(values);
  }
  for (const Pattern& pattern : data.patterns) {
    const Pattern& first = data.patterns.front();
    require(!pattern.impulses.empty() && pattern.impulses.size() % kImpulseValues == 0 &&
                pattern.impulses.size() == first.impulses.size(),
            "impulses");
    require(!pattern.fields.empty() &&
                std::ranges::equal(pattern.fields, first.fields,
                                   [](auto& a, auto& b) { return a.first == b.first; }),
            "fields");
    data.features = static_cast<int>(first.impulses.size()) / kImpulseValues;
  }
  return data;
}

}  // namespace

void write_data_set(const std::filesystem::path& file, const DataSet& data) {
  ArrayFile arrays;
  put_shapes(arrays, data.shapes);
  arrays.texts["provenance"] = data.provenance;
  arrays.reals["field_unit"] = {data.field_unit};
  auto names = nlohmann::json::array();
  for (const Pattern& pattern : data.patterns) {
    names.push_back(pattern.name);
    arrays.integers["pattern_shape"].push_back(pattern.shape);
  }
  arrays.texts["names"] = names.dump();
  ArrayViews views = arrays;
  for (std::size_t k = 0; k < data.patterns.size(); ++k) {
    const Pattern& pattern = data.patterns[k];
    views.floats[pattern_name(k, "impulses")] = pattern.impulses;
    for (const auto& [r, field] : pattern.fields) {
      views.floats[pattern_name(k, std::to_string(r))] = field;
    }
  }
  write_array_file(file, views, kKind);
}

DataSet read_data_set(const std::filesystem::path& file) {
  return made_of_file(file, kKind, data_set_of);
}

DataSet joined(std::vector<DataSet> sets) {
  if (sets.empty()) throw InputError("there is no data set to learn from");
  DataSet all = std::move(sets.front());
  if (sets.size() == 1) return all;
  auto provenances = nlohmann::json::array({all.provenance});
  for (DataSet& set : std::span(sets).subspan(1)) {
    const std::string names = names_of(set.shapes);
    const auto resolutions = [](const DataSet& data) {
      std::vector<int> list;
      if (data.patterns.empty()) return list;
      for (const auto& [r, field] : data.patterns.front().fields) list.push_back(r);
      return list;
    };
    if (set.features != all.features || set.field_unit != all.field_unit ||
        resolutions(set) != resolutions(all)) {
      throw InputError(
          fmt::format("the data sets of {} and {} cannot be learned together: their impulses, "
                      "resolutions or truncations differ; export them with the same options",
                      names_of(all.shapes), names));
    }
    const auto before = static_cast<int>(all.shapes.size());
    for (LearnedShape& shape : set.shapes) {
      if (find_shape(all.shapes, shape.digest)) {
        throw InputError(fmt::format("'{}' is in two of the data sets", shape.name));
      }
      all.shapes.push_back(std::move(shape));
    }
    for (Pattern& pattern : set.patterns) {
      pattern.shape += before;
      all.patterns.push_back(std::move(pattern));
    }
    provenances.push_back(set.provenance);
  }
  all.provenance = provenances.dump();
  return all;
}

std::string digest_of(const DataSet& data) {
  Digest digest;
  digest.add(data.provenance);
  for (const LearnedShape& shape : data.shapes) {
    digest.add(shape.digest);
    for (const double v : scaling_values(shape.scaling)) digest.add(v);
  }
  digest.add(data.field_unit);
  for (const Pattern& pattern : data.patterns) {
    digest.add(pattern.name);
    digest.add(static_cast<std::uint64_t>(pattern.shape));
    digest.add(std::as_bytes(std::span(pattern.impulses)));
    for (const auto& [r, field] : pattern.fields) {
      digest.add(static_cast<std::uint64_t>(r));
      digest.add(std::as_bytes(std::span(field)));
    }
  }
  return digest.hex();
}

}  // namespace fracbench::neural
