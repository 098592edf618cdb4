#include "reports/published.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>

#include "core/error.h"

namespace fracbench {

namespace {

/// A table of one of the files, which knows where it stands.
class Entry {
 public:
  Entry(const toml::table& table, std::string file) : table_(table), file_(std::move(file)) {}

  std::string text(const char* key) const {
    const auto value = table_[key].value<std::string>();
    if (!value) fail(key, "a text");
    return *value;
  }
  std::string text_or_none(const char* key) const { return table_[key].value_or(std::string()); }
  double number(const char* key) const {
    const auto value = table_[key].value<double>();
    if (!value) fail(key, "a number");
    return *value;
  }
  int integer_or_zero(const char* key) const { return table_[key].value_or(0); }
  bool boolean(const char* key) const {
    const auto value = table_[key].value<bool>();
    if (!value) fail(key, "true or false");
    return *value;
  }
  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> result;
    const toml::array* list = table_[key].as_array();
    if (!list) fail(key, "a list");
    for (const toml::node& item : *list) {
      if (const auto value = item.value<std::string>()) result.push_back(*value);
    }
    return result;
  }
  Entry part(const char* key) const {
    const toml::table* table = table_[key].as_table();
    if (!table) fail(key, "a table");
    return {*table, file_};
  }

 private:
  [[noreturn]] void fail(const char* key, const char* wanted) const {
    throw InputError(
        fmt::format("{}:{}: '{}' must be {}", file_, table_.source().begin.line, key, wanted));
  }

  const toml::table& table_;
  std::string file_;
};

/// One file, and the entries of one kind in it.
class File {
 public:
  explicit File(const char* name)
      : path_((std::filesystem::path(FRACBENCH_PUBLISHED_FOLDER) / name).string()) {
    try {
      root_ = toml::parse_file(path_);
    } catch (const toml::parse_error& error) {
      throw InputError(fmt::format("{}:{}: {}; published values belong to the program", path_,
                                   error.source().begin.line, error.description()));
    }
  }

  Entry root() const { return {root_, path_}; }

  template <typename Read>
  auto each(const char* kind, const Read& read) const {
    std::vector<decltype(read(root()))> result;
    const toml::array* list = root_[kind].as_array();
    if (!list) throw InputError(fmt::format("{}: has no [[{}]]", path_, kind));
    for (const toml::node& node : *list) {
      const toml::table* table = node.as_table();
      if (!table) throw InputError(fmt::format("{}: {} must be tables", path_, kind));
      result.push_back(read(Entry(*table, path_)));
    }
    return result;
  }

 private:
  std::string path_;
  toml::table root_;
};

PublishedStage stage_in(const Entry& entry) {
  return {.method = entry.text("method"),
          .stage = entry.text("stage"),
          .resolution = entry.integer_or_zero("resolution")};
}

}  // namespace

std::vector<PublishedTime> published_times() {
  return File("table-2.toml").each("time", [](const Entry& e) {
    return PublishedTime{.row = e.text("row"),
                         .column = e.text("column"),
                         .shape = e.text("shape"),
                         .stage = stage_in(e),
                         .printed = e.text("printed"),
                         .seconds = e.number("value"),
                         .erratum = e.text_or_none("erratum")};
  });
}

std::vector<PublishedRatio> published_ratios() {
  return File("table-2.toml").each("ratio", [](const Entry& e) {
    return PublishedRatio{.name = e.text("name"),
                          .over = stage_in(e.part("over")),
                          .under = stage_in(e.part("under")),
                          .erratum = e.text_or_none("erratum")};
  });
}

std::vector<PublishedMethod> published_methods() {
  return File("table-1.toml").each("method", [](const Entry& e) {
    return PublishedMethod{.row = e.text("row"),
                           .method = e.text_or_none("method"),
                           .run_time = e.text("run_time"),
                           .training = e.text_or_none("training"),
                           .shape_type = e.text("shape_type"),
                           .retains_surface = e.boolean("retains_surface"),
                           .refracture = e.boolean("refracture"),
                           .erratum = e.text_or_none("erratum")};
  });
}

Claims published_claims() {
  const File file("claims.toml");
  return {.list = file.each("claim",
                            [](const Entry& e) {
                              return Claim{.name = e.text("name"),
                                           .place = e.text("place"),
                                           .says = e.text("says"),
                                           .statistic = e.text("statistic"),
                                           .metric = e.text_or_none("metric"),
                                           .subject = e.text("subject"),
                                           .others = e.texts("others"),
                                           .erratum = e.text_or_none("erratum")};
                            }),
          .baselines = file.root().texts("baselines")};
}

std::vector<Erratum> published_errata() {
  return File("errata.toml").each("erratum", [](const Entry& e) {
    return Erratum{.name = e.text("name"),
                   .place = e.text("place"),
                   .finding = e.text("finding"),
                   .consequence = e.text("consequence")};
  });
}

std::optional<double> published_value(const PublishedRatio& ratio, const std::string& shape,
                                      const std::vector<PublishedTime>& times) {
  std::optional<double> over;
  std::optional<double> under;
  for (const PublishedTime& time : times) {
    if (time.shape != shape) continue;
    if (time.stage == ratio.over) over = time.seconds;
    if (time.stage == ratio.under) under = time.seconds;
  }
  if (!over || !under || !(*under > 0)) return std::nullopt;
  return *over / *under;
}

}  // namespace fracbench
