#include "reports/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/palette.h"
#include "reports/table.h"

namespace fracbench {

namespace {

constexpr double kFont = 12;
constexpr double kCharacter = 6.6;  // mean width of one at that size
constexpr double kLegendLine = 20;

/// Where a value lies on the page.
class Scale {
 public:
  Scale(const FigureAxis& axis, double least, double most, double from, double to)
      : logarithmic_(axis.logarithmic), from_(from), to_(to) {
    low_ = transformed(least);
    high_ = transformed(most);
    if (!axis.categories.empty()) {
      low_ = -0.5;
      high_ = static_cast<double>(axis.categories.size()) - 0.5;
    } else if (const double size = std::max(std::abs(low_), std::abs(high_));
               high_ - low_ <= 1e-9 * size) {  // equal, but for rounding
      const double margin = std::max(0.5, 0.1 * size);
      low_ -= margin;
      high_ += margin;
    } else {
      const double margin = 0.04 * (high_ - low_);
      // A number that cannot be negative gets no room for it.
      low_ = !logarithmic_ && least >= 0 && low_ - margin < 0.25 * high_ ? std::min(low_, 0.0)
                                                                         : low_ - margin;
      high_ += margin;
    }
  }

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic_ || value > 0); }
  double at(double value) const {
    return from_ + (transformed(value) - low_) / (high_ - low_) * (to_ - from_);
  }

  /// Round values with their labels.
  std::vector<std::pair<double, std::string>> ticks() const {
    return logarithmic_ ? logarithmic_ticks() : linear_ticks();
  }

 private:
  double transformed(double value) const { return logarithmic_ ? std::log10(value) : value; }

  std::vector<std::pair<double, std::string>> linear_ticks() const {
    const double raw = (high_ - low_) / 5;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    double step = 10 * power;
    for (const double factor : {1.0, 2.0, 5.0}) {
      if (factor * power >= raw) {
        step = factor * power;
        break;
      }
    }
    std::vector<std::pair<double, std::string>> result;
    for (double n = std::ceil(low_ / step); n * step <= high_ + 1e-9 * step; ++n) {
      result.emplace_back(n * step, short_number(n * step + 0.0));
    }
    return result;
  }

  std::vector<std::pair<double, std::string>> logarithmic_ticks() const {
    const bool few = high_ - low_ < 2;
    std::vector<std::pair<double, std::string>> result;
    const int stride = std::max(1, static_cast<int>((high_ - low_) / 6));
    for (int power = static_cast<int>(std::floor(low_)); power <= std::ceil(high_); ++power) {
      if (!few && power % stride != 0) continue;
      for (const double factor : {1.0, 2.0, 5.0}) {
        if (!few && factor > 1) continue;
        const double value = factor * std::pow(10, power);
        const double place = std::log10(value);
        if (place < low_ || place > high_) continue;
        result.emplace_back(value, short_number(value));
      }
    }
    return result;
  }

  bool logarithmic_;
  double low_ = 0, high_ = 0, from_, to_;
};

std::string colour_of(const FigureSeries& series) {
  const Vec3 colour = 255 * fragment_color(series.colour);
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(colour.x()), std::lround(colour.y()),
                     std::lround(colour.z()));
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value, const FigureAxis& axis) {
    if (!std::isfinite(value) || (axis.logarithmic && value <= 0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
};

class Drawing {
 public:
  Drawing(const Figure& figure, const SvgOptions& options, Range x, Range y)
      : figure_(figure),
        options_(options),
        left_(left_margin()),
        right_(options.width - 12),
        top_(12),
        bottom_(options.height - (turned() ? 96 : 44)),
        x_(figure.x, x.low, x.high, left_, right_),
        y_(figure.y, y.low, y.high, bottom_, top_) {}

  std::string draw() {
    grid();
    for (const bool faint : {true, false}) {
      for (const FigureSeries& series : figure_.series) {
        if (series.faint == faint) marks(series);
      }
    }
    const double height = options_.height + legend();
    const std::string size =
        fmt::format("viewBox=\"0 0 {:g} {:g}\" font-family=\"sans-serif\" font-size=\"{:g}\"",
                    options_.width, height, kFont);
    const std::string label = escape_markup(figure_.title);
    if (!options_.stand_alone) {
      return fmt::format(
          "<svg {} role=\"img\" aria-label=\"{}\" color=\"currentColor\">\n{}</svg>\n", size, label,
          body_);
    }
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:g}\" height=\"{:g}\" {} "
        "color=\"#222\">\n"
        "<title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{}</svg>\n",
        options_.width, height, size, label, body_);
  }

 private:
  /// Category names that would run into each other are set at a slant.
  bool turned() const {
    const auto& names = figure_.x.categories;
    std::size_t longest = 0;
    for (const std::string& name : names) longest = std::max(longest, name.size());
    return static_cast<double>(longest * names.size()) * kCharacter > options_.width - 90;
  }

  double left_margin() const {
    std::size_t longest = 7;
    for (const std::string& name : figure_.y.categories) longest = std::max(longest, name.size());
    return 24 + static_cast<double>(longest) * kCharacter;
  }

  void text(double x, double y, std::string_view anchor, std::string_view words,
            std::string_view more = "") {
    body_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" fill=\"currentColor\"{}>{}</text>\n", x,
        y, anchor, more, escape_markup(words));
  }

  void grid_line(double x1, double y1, double x2, double y2) {
    body_ += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"currentColor\" "
        "stroke-opacity=\"0.15\"/>\n",
        x1, y1, x2, y2);
  }

  void grid() {
    const auto x_ticks = ticks(figure_.x, x_);
    for (const auto& [value, name] : x_ticks) {
      const double x = x_.at(value);
      grid_line(x, top_, x, bottom_);
      if (turned()) {
        text(x, bottom_ + 14, "end", name,
             fmt::format(" transform=\"rotate(-30 {:.1f} {:.1f})\"", x, bottom_ + 14));
      } else {
        text(x, bottom_ + 16, "middle", name);
      }
    }
    for (const auto& [value, name] : ticks(figure_.y, y_)) {
      const double y = y_.at(value);
      grid_line(left_, y, right_, y);
      text(left_ - 6, y + 4, "end", name);
    }
    text((left_ + right_) / 2, options_.height - 6, "middle", figure_.x.label);
    text(14, (top_ + bottom_) / 2, "middle", figure_.y.label,
         fmt::format(" transform=\"rotate(-90 14 {:.1f})\"", (top_ + bottom_) / 2));
  }

  static std::vector<std::pair<double, std::string>> ticks(const FigureAxis& axis,
                                                           const Scale& scale) {
    if (axis.categories.empty()) return scale.ticks();
    std::vector<std::pair<double, std::string>> result;
    for (const std::string& name : axis.categories) {
      result.emplace_back(static_cast<double>(result.size()), name);
    }
    return result;
  }

  void marks(const FigureSeries& series) {
    const std::string colour = colour_of(series);
    const std::string opacity = series.faint ? " opacity=\"0.35\"" : "";
    if (series.mark == Mark::line) {
      std::string path;
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) continue;
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : " L", x_.at(series.x[i]),
                            y_.at(series.y[i]));
      }
      if (path.empty()) return;
      body_ += fmt::format(
          "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
          "stroke-linejoin=\"round\"{}{}>"
          "<title>{}</title></path>\n",
          path, colour, series.dashed ? " stroke-dasharray=\"6 4\"" : "", opacity,
          escape_markup(series.name));
      return;
    }
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) continue;
      const double x = x_.at(series.x[i]);
      const double y = y_.at(series.y[i]);
      std::string value = short_number(series.y[i]);
      if (series.mark == Mark::intervals && y_.shows(series.low[i]) && y_.shows(series.high[i])) {
        body_ += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" "
            "stroke-width=\"2\"/>\n",
            x, y_.at(series.low[i]), y_.at(series.high[i]), colour);
        value +=
            fmt::format(" [{}, {}]", short_number(series.low[i]), short_number(series.high[i]));
      }
      body_ += fmt::format(
          "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"{}><title>{}: "
          "{}</title></circle>\n",
          x, y, series.faint ? 2.5 : 4, colour, opacity, escape_markup(series.name), value);
    }
  }

  /// Below the figure; returns how high it is.
  double legend() {
    double x = left_;
    double y = options_.height + 14;
    std::vector<std::string> shown;
    for (const FigureSeries& series : figure_.series) {
      if (series.name.empty() || std::ranges::find(shown, series.name) != shown.end()) continue;
      shown.push_back(series.name);
      const double width = 34 + static_cast<double>(series.name.size()) * kCharacter;
      if (x > left_ && x + width > right_) {
        x = left_;
        y += kLegendLine;
      }
      body_ += fmt::format(
          "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
          "stroke-width=\"{}\"{}/>\n",
          x, y - 4, x + 18, y - 4, colour_of(series), series.mark == Mark::line ? 2 : 6,
          series.dashed ? " stroke-dasharray=\"6 4\"" : "");
      text(x + 24, y, "start", series.name);
      x += width + 8;
    }
    return shown.empty() ? 0 : y + 8 - options_.height;
  }

  const Figure& figure_;
  const SvgOptions& options_;
  double left_, right_, top_, bottom_;
  Scale x_, y_;
  std::string body_;
};

}  // namespace

std::string to_svg(const Figure& figure, const SvgOptions& options) {
  Range x;
  Range y;
  for (const FigureSeries& series : figure.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      Range at;
      at.add(series.x[i], figure.x);
      Range value;
      value.add(series.y[i], figure.y);
      if (at.empty() || value.empty()) continue;
      x.add(series.x[i], figure.x);
      y.add(series.y[i], figure.y);
      if (series.mark == Mark::intervals) {
        y.add(series.low[i], figure.y);
        y.add(series.high[i], figure.y);
      }
    }
  }
  if (x.empty() || y.empty()) return "";
  return Drawing(figure, options, x, y).draw();
}

std::string file_name_part(std::string text) {
  for (char& c : text) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '+' || c == '-';
    if (!plain) c = '_';
  }
  return text;
}

std::string escape_markup(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        // Control characters have no place in XML.
        result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? ' ' : c;
    }
  }
  return result;
}

}  // namespace fracbench
