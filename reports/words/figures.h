#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"

namespace etude {

/// The sign in the place of a value that does not exist, never a zero.
inline constexpr std::string_view kNoValue = "—";

/// The words of a metric, from the catalogue, or its id when it is not listed there. Shares and scores are shown in per
/// cent, and their differences in percentage points.
struct MetricWords {
  std::string label;              ///< "orientation error"; "share “solved”", "mean F1"
  std::string suffix;             ///< put behind a value: "°", " cm", " %", ""
  std::string difference_suffix;  ///< the same, but " percentage points" where values are in per cent
  double scale = 1;               ///< what values are multiplied by before they are shown
  bool is_share = false;          ///< 0…1, shown in per cent
  bool by_mean = false;           ///< the mean stands for all cells, not the median
  Direction direction = Direction::kNeither;
  std::string plain_label = {};  ///< "orientation error", "solved", "F1": where mean or share is said already
};
MetricWords WordsFor(const std::string& metric_id);
/// Gives the suffix as a caption has it, without its blank: "cm", "".
std::string UnitOf(const MetricWords& words);

/// Gives the one number that stands for all cells, the metric's own aggregate, median or mean, in the metric's unit.
std::optional<double> TypicalValue(const MetricSummary& summary, const MetricWords& words);
/// Writes a value: "12.3°", "98 %"; kNoValue without one.
std::string FormatValue(std::optional<double> value, const MetricWords& words);

/// Writes a number: "12.3", "1,284", "0.0021", "3.1e-06"; kNoValue when not finite.
std::string FormatNumber(double value);
/// Writes the shortest text that reads back as the same number; empty when there is none.
std::string ExactText(std::optional<double> value);
/// Writes a number with the given digits behind the point, for figures that stand beside each other.
std::string FormatFixed(double value, int decimals);
/// Writes a count: "1,284".
std::string FormatCount(long long count);
/// Writes a share: "98 %"; never rounded up to 100 % or down to 0 % when something is missing from it.
std::string FormatShare(long long part, long long whole);
/// Writes an interval: "10.1–14.0", both ends with the same digits, or "−1.2 to 0.4"; kNoValue without one.
std::string FormatInterval(std::optional<double> low, std::optional<double> high, const MetricWords& words);
/// Writes a p value: "0.42", "0.013", "< 0.001"; kNoValue without one.
std::string FormatP(std::optional<double> p);
/// Writes a count of things: "1 world", "3 worlds".
std::string Plural(long long count, std::string_view singular);

/// The most entries of a list, and rows of a table, that are shown: hundreds of methods and conditions would make a
/// page that no browser scrolls. The files beside it hold all.
constexpr std::size_t kMostListed = 40;
constexpr std::size_t kMostTableRows = 400;

/// Says what is left out: "60 more reasons are left out here; cells.jsonl has all."; "" when `total` does not exceed
/// `shown`.
std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);
/// Writes the same as a paragraph of the page.
std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);

}  // namespace etude
