#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

struct TableColumn {
  std::string head = {};
  bool is_number = false;    ///< stands at the right
  bool is_row_head = false;  ///< its cells are the heads of their rows
  bool is_detail = false;    ///< for experts: the page shows it when asked
  bool is_sortable = false;  ///< the page sorts its cells by their numbers
  std::string latex = {};    ///< what LaTeX has for the head, where that is not its text
  std::string over = {};     ///< a second head above this one, which neighbours share
  std::string title = {};    ///< what the page tells of the head to a pointer
  std::string sign = {};     ///< markup that follows the head on the page
};

struct TableCell {
  TableCell() = default;
  /// `markup` stands for the text on the page.
  template <std::convertible_to<std::string_view> Text>
  TableCell(const Text& words, std::optional<double> value = {}, std::string markup = {})
      : text(std::string_view(words)), number(value), html(std::move(markup)) {}
  /// A number with all its digits; an empty cell without one.
  TableCell(std::optional<double> value) : number(value) {}
  TableCell(double value) : number(value) {}
  TableCell(int value) : number(value) {}

  std::string text;              ///< plain: each writer escapes it
  std::optional<double> number;  ///< what CSV holds in place of the text, and what the page sorts by
  std::string html;              ///< "" where the page shows the text
  std::string_view latex_sign;   ///< LaTeX that follows the text
  bool is_strong = false;        ///< bold in Markdown
};

struct TableRow {
  std::vector<TableCell> cells = {};  ///< as many as the table has columns; none in a row that heads a group
  std::string group = {};             ///< the head of the rows that follow, across all columns; "" in all other rows
  std::string mark = {};              ///< a comment of the page in the place of a row; other writers leave it out
  std::string attributes = {};        ///< of the row, or of the group, on the page: " class=\"taken\""
};

/// A table as a value. All four writers escape its texts.
struct Table {
  std::string label = {};    ///< its name for screen readers, where the page may scroll it; "": it does not scroll
  std::string style = {};    ///< its class on the page
  std::string caption = {};  ///< "" without one
  std::vector<TableColumn> columns = {};
  std::vector<TableRow> rows = {};
};

std::string TableHtml(const Table& table);
/// Writes a table of GitHub's Markdown, the caption as a paragraph before it. Groups have no heads there.
std::string TableMarkdown(const Table& table);
/// Writes a tabular of the package booktabs, the caption as a line before it, without a float around them.
std::string TableLatex(const Table& table);
/// Writes the heads, then a line per row, numbers with all their digits (RFC 4180). Captions and groups are left out.
std::string TableCsv(const Table& table);

}  // namespace etude
