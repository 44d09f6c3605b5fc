#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"

namespace etude {

/// What stands in the place of a value that does not exist. Never a zero.
inline constexpr std::string_view kNoValue = "—";

/// How people read a metric: its words from the catalogue, or its id when it is not listed there. Shares and scores are
/// shown in per cent, and their differences in percentage points.
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

/// The one number that stands for all cells, the metric's own aggregate: median or mean. In the metric's unit.
std::optional<double> TypicalValue(const MetricSummary& summary, const MetricWords& words);
/// "12.3°", "98 %"; kNoValue without a value.
std::string FormatValue(std::optional<double> value, const MetricWords& words);

/// Digits behind the point that show about three significant digits of `value`.
int DecimalsFor(double value);
/// "12.3", "1,284", "0.0021", "3.1e-06"; kNoValue when not finite.
std::string FormatNumber(double value);
/// With the given digits behind the point, for figures that stand beside each other.
std::string FormatFixed(double value, int decimals);
/// "1,284"
std::string FormatCount(long long count);
/// "98 %"; never rounded up to 100 % or down to 0 % when something is missing from it.
std::string FormatShare(long long part, long long whole);
/// "10.1–14.0", both ends with the same digits, or "−1.2 to 0.4"; kNoValue without an interval.
std::string FormatInterval(std::optional<double> low, std::optional<double> high, const MetricWords& words);
/// "0.42", "0.013", "< 0.001"; kNoValue without a p.
std::string FormatP(std::optional<double> p);
/// "1 world", "3 worlds"
std::string Plural(long long count, std::string_view singular);

/// As many entries of a list, and rows of a table, as a reader may want to see: hundreds of methods and conditions
/// would make a page that no browser scrolls. The files beside it hold all.
constexpr std::size_t kMostListed = 40;
constexpr std::size_t kMostTableRows = 400;

/// "60 more reasons are left out here; cells.jsonl has all." "" when `total` does not exceed `shown`.
std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);
/// The same as a paragraph of the page.
std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);

}  // namespace etude
