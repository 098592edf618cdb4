#include "reports/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/table.h"

namespace fracbench {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::string shown(const std::optional<double>& value) { return value ? short_number(*value) : "-"; }

std::string gate_name(const GateResult& result) {
  const std::string& other = result.gate.relative_to;
  std::string name = fmt::format("{}{}/{} ({})", result.method,
                                 other.empty() ? "" : fmt::format(" over {}", other),
                                 result.gate.metric, to_string(result.gate.test));
  if (!result.gate.shape.empty()) name = result.gate.shape + "/" + name;
  return name;
}

std::string kind_of_change(const GateResult& result) {
  if (result.gate.relative) return "ratio";
  return result.gate.test == GateTest::mean ? "difference" : "distance";
}

/// "ratio 1.21 [1.1, 1.3] (limit 1.1, noise 1.05, found with 95 %: 1.2; p 0.001, corrected 0.01)".
std::string numbers_of(const GateResult& result) {
  if (!result.change) return "";
  std::string text = fmt::format("{} {}", kind_of_change(result), shown(result.change));
  if (result.change_low && result.change_high) {
    text += fmt::format(" [{}, {}]", shown(result.change_low), shown(result.change_high));
  }
  text += fmt::format(" over {} collisions (limit {}", result.collisions,
                      short_number(result.gate.limit));
  if (result.noise) text += fmt::format(", noise {}", shown(result.noise));
  if (result.detectable) text += fmt::format(", found with 95 %: {}", shown(result.detectable));
  if (result.p_corrected) {
    text += fmt::format(", p {}, corrected {}", shown(result.p), shown(result.p_corrected));
  }
  return text + ")";
}

std::string line_of(const GateResult& result) {
  const std::string numbers = numbers_of(result);
  return fmt::format("{:<12} {}: {}{}{}", to_string(result.outcome), gate_name(result), numbers,
                     numbers.empty() || result.reason.empty() ? "" : "; ", result.reason);
}

std::vector<const GateResult*> worst_first(const Comparison& comparison) {
  const auto rank = [](const GateResult* result) {
    switch (result->outcome) {
      case GateOutcome::regression:
        return 0;
      case GateOutcome::refused:
        return 1;
      case GateOutcome::not_measured:
        return 2;
      case GateOutcome::pass:
        return 3;
      case GateOutcome::reported:
        return 4;
    }
    return 5;
  };
  std::vector<const GateResult*> list;
  for (const GateResult& result : comparison.gates) list.push_back(&result);
  std::ranges::stable_sort(list, {}, rank);
  return list;
}

std::string verdict_line(const Comparison& comparison) {
  return fmt::format("{} ({} cells compared, exit code {})", comparison.verdict,
                     comparison.compared, static_cast<int>(comparison.exit_code));
}

/// Text in a Markdown table or list.
std::string plain(std::string text) {
  std::string safe;
  for (const char c : text) {
    if (c == '|' || c == '<' || c == '*' || c == '`') safe += '\\';
    safe += c == '\n' || c == '\r' ? ' ' : c;
  }
  return safe;
}

/// Text in XML; control characters, which XML 1.0 does not have, become question marks.
std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else if (c == '\n') {
      safe += "&#10;";
    } else {
      safe += static_cast<unsigned char>(c) < 0x20 && c != '\t' ? '?' : c;
    }
  }
  return safe;
}

struct TestCase {
  std::string name;
  const char* kind;  ///< "failure", "error", "skipped"; null: passed
  std::string message;
};

std::vector<TestCase> test_cases(const Comparison& comparison) {
  const auto joined = [](const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
      text += fmt::format("{}{}", text.empty() ? "" : "\n", line);
    return text;
  };
  std::vector<TestCase> cases = {
      {"cells", comparison.problems.empty() && comparison.compared > 0 ? nullptr : "error",
       joined(comparison.problems)},
      {"status", comparison.status_regressions.empty() ? nullptr : "failure",
       joined(comparison.status_regressions)}};
  for (const GateResult& result : comparison.gates) {
    const char* kind = nullptr;
    if (result.outcome == GateOutcome::regression) kind = "failure";
    if (result.outcome == GateOutcome::refused) kind = "error";
    if (result.outcome == GateOutcome::not_measured) kind = "error";
    if (result.outcome == GateOutcome::reported) kind = "skipped";
    cases.push_back({gate_name(result), kind, line_of(result)});
  }
  return cases;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string text;
  for (const std::string& line : comparison.problems) text += line + "\n";
  for (const std::string& line : comparison.status_regressions) {
    text += fmt::format("{:<12} {}\n", "regression", line);
  }
  for (const GateResult* result : worst_first(comparison)) text += line_of(*result) + "\n";
  for (const std::string& line : comparison.notes) text += fmt::format("note: {}\n", line);
  return text + verdict_line(comparison) + "\n";
}

std::string comparison_markdown(const Comparison& comparison) {
  std::string text = fmt::format("## fracbench compare {}{}{}\n\n", plain(comparison.suite),
                                 comparison.suite.empty() ? "" : ": ", comparison.verdict);
  text += verdict_line(comparison) + ".\n";
  const auto list = [&](const char* title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    text += fmt::format("\n### {}\n\n", title);
    for (const std::string& line : lines) text += fmt::format("- {}\n", plain(line));
  };
  list("Not compared", comparison.problems);
  list("Cells that became worse", comparison.status_regressions);
  if (!comparison.gates.empty()) {
    Table table{.name = "gates", .title = "Gates"};
    for (const char* name : {"outcome", "gate", "collisions", "baseline", "candidate", "change",
                             "limit", "noise", "found with 95 %", "p corrected", "why"}) {
      table.columns.push_back({name});
    }
    for (const GateResult* result : worst_first(comparison)) {
      TableCell change = number_or_nothing(result->change);
      if (result->change && result->change_low && result->change_high) {
        change = Estimate{*result->change, *result->change_low, *result->change_high};
      }
      table.rows.push_back({std::string(to_string(result->outcome)), gate_name(*result),
                            static_cast<std::int64_t>(result->collisions),
                            number_or_nothing(result->baseline),
                            number_or_nothing(result->candidate), change, result->gate.limit,
                            number_or_nothing(result->noise), number_or_nothing(result->detectable),
                            number_or_nothing(result->p_corrected), result->reason});
    }
    text += "\n### Gates\n\n" + to_markdown(table);
  }
  list("Notes", comparison.notes);
  return text;
}

Json comparison_json(const Comparison& comparison) {
  Json gates = Json::array();
  for (const GateResult& result : comparison.gates) {
    const Gate& gate = result.gate;
    const char* direction = gate.direction == Tail::both    ? "both"
                            : gate.direction == Tail::upper ? "higher"
                                                            : "lower";
    gates.push_back({{"metric", gate.metric},
                     {"test", to_string(gate.test)},
                     {"method", result.method},
                     {"shape", gate.shape.empty() ? Json(nullptr) : Json(gate.shape)},
                     {"outcome", to_string(result.outcome)},
                     {"reason", result.reason},
                     {"collisions", result.collisions},
                     {"baseline", number(result.baseline)},
                     {"candidate", number(result.candidate)},
                     {"kind", kind_of_change(result)},
                     {"direction", direction},
                     {"change", number(result.change)},
                     {"change_low", number(result.change_low)},
                     {"change_high", number(result.change_high)},
                     {"limit", gate.limit},
                     {"noise", number(result.noise)},
                     {"detectable", number(result.detectable)},
                     {"significance", gate.significance},
                     {"p", number(result.p)},
                     {"p_corrected", number(result.p_corrected)}});
  }
  return {{"verdict", comparison.verdict},   {"exit_code", static_cast<int>(comparison.exit_code)},
          {"suite", comparison.suite},       {"compared", comparison.compared},
          {"gates", std::move(gates)},       {"status_regressions", comparison.status_regressions},
          {"problems", comparison.problems}, {"notes", comparison.notes}};
}

std::string comparison_junit(const Comparison& comparison) {
  const std::vector<TestCase> cases = test_cases(comparison);
  const auto count = [&](std::string_view kind) {
    return std::ranges::count_if(cases,
                                 [&](const TestCase& c) { return c.kind && c.kind == kind; });
  };
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"fracbench compare {}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" "
      "skipped=\"{}\">\n",
      escaped(comparison.suite), cases.size(), count("failure"), count("error"), count("skipped"));
  for (const TestCase& c : cases) {
    text += fmt::format("    <testcase classname=\"compare\" name=\"{}\"", escaped(c.name));
    text += c.kind ? fmt::format(">\n      <{} message=\"{}\"/>\n    </testcase>\n", c.kind,
                                 escaped(c.message))
                   : std::string("/>\n");
  }
  return text + "  </testsuite>\n</testsuites>\n";
}

}  // namespace fracbench
