#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etude {

/// As many entries of a list, and rows of a table, as a reader may want to see: hundreds of methods and conditions
/// would make a page that no browser scrolls. The files beside it hold all.
constexpr std::size_t kMostListed = 40;
constexpr std::size_t kMostTableRows = 400;

/// "60 more reasons are left out here; cells.jsonl has all." "" when `total` does not exceed `shown`.
std::string LeftOutWords(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);
/// The same as a paragraph of the page.
std::string LeftOutHtml(std::size_t total, std::size_t shown, std::string_view things, std::string_view where);

}  // namespace etude
