#include "io/drawing/panel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/drawing/escape.h"

namespace etude {
namespace {

constexpr double kLogarithmicFrom = 100;
constexpr double kAxisMargin = 0.04;  // share of the range that is added at each end, so that no mark at an end is cut
constexpr double kMaxTicks = 6;

double RoundStep(double range) {
  const double step = std::pow(10, std::floor(std::log10(range / kMaxTicks)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (range / (factor * step) <= kMaxTicks) return factor * step;
  }
  return 10 * step;
}

Axis WithMargin(double low, double high) {
  // For a single value, make the axis wider than zero.
  const double width = high > low ? high - low : std::max(std::abs(high), 1.0);
  return {.low = low - kAxisMargin * width, .high = high + kAxisMargin * width};
}

/// Cuts a text to at most `max_characters` characters, including the ellipsis; never within a character.
std::string Cut(std::string_view text, std::size_t max_characters) {
  std::size_t characters = 0, end = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    if (begins && characters++ + 1 == max_characters) end = i;
  }
  return characters <= max_characters ? std::string(text) : std::string(text.substr(0, end)) + "…";
}

}  // namespace

double Axis::At(double value) const {
  const double share = is_logarithmic
                           ? (std::log10(std::max(value, low)) - std::log10(low)) / (std::log10(high) - std::log10(low))
                           : (value - low) / (high - low);
  return from + (to - from) * std::clamp(share, 0.0, 1.0);
}

std::vector<double> Axis::Ticks() const {
  std::vector<double> ticks;
  if (is_logarithmic) {
    const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    const int step = std::max(1, (last - first + 5) / 6);
    for (int decade = first; decade <= last; decade += step) ticks.push_back(std::pow(10.0, decade));
    return ticks;
  }
  const double step = RoundStep(high - low);
  for (double tick = std::ceil(low / step); tick * step <= high; ++tick) ticks.push_back(tick * step);
  return ticks;
}

Axis AxisOf(const std::vector<double>& values, double floor) {
  if (values.empty()) return {};
  const auto [low, high] = std::ranges::minmax(values);
  double least = high;  // the least value above 0
  for (const double value : values) least = value > 0 ? std::min(least, value) : least;
  const double lowest = std::max(least, floor), highest = std::max(high, floor);
  if (!(floor > 0 && low >= 0 && highest / lowest > kLogarithmicFrom)) return WithMargin(low, high);
  int first = static_cast<int>(std::floor(std::log10(lowest) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(highest) - 1e-9));
  std::string low_label;
  if (least < std::pow(10, first)) {
    low_label = "≤" + DecadeText(first);
  } else if (low == 0) {
    --first;
    low_label = "0";
  }
  return {.low = std::pow(10, first), .high = std::pow(10, last), .is_logarithmic = true, .low_label = low_label};
}

Axis DecadeAxis(const std::vector<double>& values) {
  constexpr int kMaxDecades = 8;
  double low = INFINITY, high = 0;
  for (const double value : values) {
    high = std::max(high, value);
    if (value > 0) low = std::min(low, value);
  }
  int first = 0, last = 1;
  if (high > 0) {
    // For a single value, make the axis one decade long.
    first = static_cast<int>(std::floor(std::log10(low)));
    last = std::max(static_cast<int>(std::ceil(std::log10(high))), first + 1);
    first = std::max(first, last - kMaxDecades);
  }
  return {.low = std::pow(10.0, first), .high = std::pow(10.0, last), .is_logarithmic = true};
}

Axis AxisAroundZero(const std::vector<double>& values) {
  double low = 0, high = 0;
  for (const double value : values) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return WithMargin(low, high);
}

std::string Axis::TickText(double value) const {
  if (value <= low && !low_label.empty()) return low_label;
  return is_logarithmic ? DecadeText(static_cast<int>(std::lround(std::log10(value)))) : etude::TickText(value);
}

std::string DecadeText(int decade) {
  if (decade < -2 || decade > 8) return fmt::format("1e{}", decade);
  if (decade < 3) return fmt::format("{:g}", std::pow(10.0, decade));
  return fmt::format("{:g}{}", std::pow(10.0, decade % 3), decade < 6 ? 'k' : 'M');
}

std::string TickText(double value) {
  const double size = std::abs(value);
  if (size != 0 && (size < 0.001 || size >= 1e6)) return fmt::format("{}{:.0e}", value < 0 ? "−" : "", size);
  std::string text = fmt::format("{:.6g}", size < 1e-12 ? 0 : value);
  if (text.starts_with('-')) text.replace(0, 1, "−");
  return text;
}

std::string BeginPanel(double height, std::string_view words, double width, std::string_view style) {
  return fmt::format("<svg class=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", style, width, height,
                     EscapeMarkup(words));
}

std::string VerticalAxisGrid(const Axis& axis, double left, double right) {
  std::string svg;
  for (const double tick : axis.Ticks()) {
    svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/>", left, axis.At(tick), right) +
           PanelText(left - 5, axis.At(tick) + 4, axis.TickText(tick), "end");
  }
  return svg;
}

std::string HorizontalAxisGrid(const Axis& axis, double top, double bottom) {
  std::string svg;
  for (const double tick : axis.Ticks()) {
    svg += fmt::format("<path d=\"M{:.1f} {}V{}\"/>", axis.At(tick), top, bottom) +
           PanelText(axis.At(tick), bottom + 13, axis.TickText(tick), "middle");
  }
  return svg;
}

std::string PanelText(double x, double y, std::string_view text, std::string_view anchor, std::size_t max_characters) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     EscapeMarkup(Cut(text, max_characters)));
}

}  // namespace etude
