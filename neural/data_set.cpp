#include "neural/data_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/array_file.h"
#include "core/digest.h"
#include "core/error.h"

namespace fracbench::neural {

namespace {

constexpr ArrayFileKind kKind{.format = "fracbench data set", .version = 1, .packed = true};

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
  DataSet data{.shape = text("shape"),
               .shape_digest = text("shape_digest"),
               .provenance = text("provenance"),
               .features = 0,
               .scaling = {},
               .patterns = {}};
  const std::vector<double>& s = file.reals["scaling"];
  require(s.size() == 5 && std::ranges::all_of(s, [](double v) { return std::isfinite(v); }) &&
              s[3] > 0 && s[4] > 0,
          "scaling");
  data.scaling = {.centre = {s[0], s[1], s[2]}, .half_side = s[3], .max_impulse = s[4]};
  const std::vector<double>& unit = file.reals["field_unit"];
  require(unit.size() == 1 && std::isfinite(unit[0]) && unit[0] > 0, "field_unit");
  data.field_unit = unit[0];
  for (const std::string& name :
       nlohmann::json::parse(text("names")).get<std::vector<std::string>>()) {
    data.patterns.push_back({.name = name, .impulses = {}, .fields = {}});
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
  arrays.texts = {
      {"shape", data.shape}, {"shape_digest", data.shape_digest}, {"provenance", data.provenance}};
  const Vec3& c = data.scaling.centre;
  arrays.reals["scaling"] = {c.x(), c.y(), c.z(), data.scaling.half_side, data.scaling.max_impulse};
  arrays.reals["field_unit"] = {data.field_unit};
  auto names = nlohmann::json::array();
  for (std::size_t k = 0; k < data.patterns.size(); ++k) {
    const Pattern& pattern = data.patterns[k];
    names.push_back(pattern.name);
    arrays.floats[pattern_name(k, "impulses")] = pattern.impulses;
    for (const auto& [r, field] : pattern.fields) {
      arrays.floats[pattern_name(k, std::to_string(r))] = field;
    }
  }
  arrays.texts["names"] = names.dump();
  write_array_file(file, arrays, kKind);
}

DataSet read_data_set(const std::filesystem::path& file) {
  ArrayFile arrays = read_array_file(file, kKind);
  try {
    return data_set_of(arrays);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("cannot read '{}': {}", file.string(), error.what()));
  } catch (const InputError& error) {
    throw InputError(fmt::format("cannot read '{}': {}", file.string(), error.what()));
  }
}

std::string digest_of(const DataSet& data) {
  Digest digest;
  digest.add(data.shape_digest);
  digest.add(data.provenance);
  for (const double v : {data.scaling.centre.x(), data.scaling.centre.y(), data.scaling.centre.z(),
                         data.scaling.half_side, data.scaling.max_impulse, data.field_unit}) {
    digest.add(v);
  }
  for (const Pattern& pattern : data.patterns) {
    digest.add(pattern.name);
    digest.add(std::as_bytes(std::span(pattern.impulses)));
    for (const auto& [r, field] : pattern.fields) {
      digest.add(static_cast<std::uint64_t>(r));
      digest.add(std::as_bytes(std::span(field)));
    }
  }
  return digest.hex();
}

}  // namespace fracbench::neural
