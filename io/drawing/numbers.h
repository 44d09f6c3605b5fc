#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace etude {

/// The sign for a missing value; a missing value is never written as zero.
inline constexpr std::string_view kNoValue = "—";

/// Writes a number: "12.3", "1,284", "0.0021", "3.1e-06"; kNoValue when not finite.
std::string FormatNumber(double value);
/// Writes the shortest text from which the same number is read; "" for nullopt.
std::string ExactText(std::optional<double> value);
/// Writes a number with a fixed number of decimals, for figures in a column.
std::string FormatFixed(double value, int decimals);
/// Writes a count: "1,284".
std::string FormatCount(long long count);
/// Writes a share: "98 %". "100 %" and "0 %" are written only if the share is exactly 1 or 0.
std::string FormatShare(long long part, long long whole);
/// Returns the number of digits behind the point that shows about three significant digits of `value`.
int DecimalsFor(double value);
/// Writes a p value: "0.42", "0.013", "< 0.001"; kNoValue if there is none.
std::string FormatP(std::optional<double> p);
/// Writes a count of things: "1 world", "3 worlds".
std::string Plural(long long count, std::string_view singular);

/// The maximum number of list entries and table rows that a page shows, because browsers cannot scroll a page with
/// hundreds of methods and conditions. The files beside the page hold all entries and rows.
constexpr std::size_t kMaxListed = 40;
constexpr std::size_t kMaxTableRows = 400;

/// Says how many entries are left out: "60 more reasons are left out here; cells.jsonl has all."; "" if `total` does
/// not exceed `shown`.
std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);
/// Returns the text of LeftOutWords as an HTML paragraph.
std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);

}  // namespace etude
