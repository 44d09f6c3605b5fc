#include "reports/words/figures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// Returns the text of a unit: "°" for degrees, otherwise the unit as the catalogue of metrics writes it.
std::string Suffix(const std::string& unit) {
  if (unit == "deg") return "°";
  return unit.empty() ? "" : " " + unit;
}

/// Returns true if `word` is one of the words of a label.
bool HasWord(const std::string& label, const std::string& word) {
  return (" " + label + " ").find(" " + word + " ") != std::string::npos;
}

std::string LabelOf(const MetricInfo& info) {
  switch (info.reading) {
    case Reading::kYesNo:
      return "share “" + info.label + "”";
    case Reading::kShare:
      // Some labels say themselves that they are a share.
      return (HasWord(info.label, "share") || HasWord(info.label, "ratio") ? "mean " : "mean share of ") + info.label;
    case Reading::kScore:
    case Reading::kAmount:
      break;
  }
  return (info.aggregate == Aggregate::kMean ? "mean " : "") + info.label;
}

}  // namespace

MetricWords WordsFor(const std::string& metric_id) {
  const MetricInfo* info = FindMetric(metric_id);
  if (info == nullptr) return {.label = metric_id, .suffix = "", .difference_suffix = "", .plain_label = metric_id};
  MetricWords words{.label = LabelOf(*info),
                    .suffix = Suffix(info->unit),
                    .difference_suffix = Suffix(info->unit),
                    .by_mean = info->aggregate == Aggregate::kMean,
                    .direction = info->direction,
                    .plain_label = info->label};
  if (info->reading != Reading::kAmount) {
    words.suffix = " %";
    words.difference_suffix = " percentage points";
    words.scale = 100;
    words.is_share = true;
  }
  return words;
}

std::string UnitOf(const MetricWords& words) {
  return words.suffix.starts_with(' ') ? words.suffix.substr(1) : words.suffix;
}

std::optional<double> TypicalValue(const MetricSummary& summary, const MetricWords& words) {
  return words.by_mean ? summary.mean : summary.median;
}

std::string FormatValue(std::optional<double> value, const MetricWords& words) {
  if (!value || !std::isfinite(*value)) return std::string(kNoValue);
  return FormatNumber(*value * words.scale) + words.suffix;
}

std::string ShortDifference(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + (words.is_share ? " pp" : words.difference_suffix);
}

std::string FormatInterval(std::optional<double> low, std::optional<double> high, const MetricWords& words) {
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high)) return std::string(kNoValue);
  const double from = *low * words.scale, to = *high * words.scale;
  const double size = std::max(std::abs(from), std::abs(to));
  const std::string_view dash = from < 0 || to < 0 ? " to " : "–";
  if (size != 0 && size < 0.001) return FormatNumber(from) + std::string(dash) + FormatNumber(to);
  // If an end of the interval would be rounded to 0, write it with more digits, because the sign of this end says
  // whether the interval contains 0.
  const auto end = [decimals = DecimalsFor(size)](double value) {
    std::string text = FormatFixed(value, decimals);
    const std::string own = FormatNumber(value);
    return text.find_first_of("123456789") == std::string::npos && own != "0" ? own : text;
  };
  return end(from) + std::string(dash) + end(to);
}

}  // namespace etude
