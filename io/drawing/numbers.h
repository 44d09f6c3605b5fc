#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace etude {

/// The sign in the place of a value that does not exist, never a zero.
inline constexpr std::string_view kNoValue = "—";

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
/// Returns the number of digits behind the point that shows about three significant digits of `value`.
int DecimalsFor(double value);
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
