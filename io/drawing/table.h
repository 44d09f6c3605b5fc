#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

struct TableColumn {
  std::string head = {};
  bool is_number = false;    ///< true: cells are numbers, aligned to the right
  bool is_row_head = false;  ///< true: the column's cells are headings, each for its own row
  bool is_detail = false;    ///< true: the column is for experts, and the page shows it on request
  bool is_sortable = false;  ///< the page can sort the rows by the numbers in this column's cells
  std::string latex = {};    ///< the heading in LaTeX, if it differs from the heading on the page
  std::string over = {};     ///< a second heading above this one, shared with neighbouring columns
  std::string title = {};    ///< the tooltip of the heading on the page
  std::string sign = {};     ///< markup after the heading on the page
};

struct TableCell {
  TableCell() = default;
  /// `markup`, if not "", replaces the text on the page.
  template <std::convertible_to<std::string_view> Text>
  TableCell(const Text& words, std::optional<double> value = {}, std::string markup = {})
      : text(std::string_view(words)), number(value), html(std::move(markup)) {}
  /// Makes a cell that shows a number with all its digits, or an empty cell for nullopt.
  TableCell(std::optional<double> value) : number(value) {}
  TableCell(double value) : number(value) {}
  TableCell(int value) : number(value) {}

  std::string text;              ///< plain text: each writer escapes it
  std::optional<double> number;  ///< the number that CSV holds instead of the text, and by which the page sorts rows
  std::string html;              ///< markup that the page shows instead of the text, unless ""
  std::string_view latex_sign;   ///< LaTeX code that follows the text
  bool is_strong = false;        ///< true: the cell is bold in Markdown
};

struct TableRow {
  std::vector<TableCell> cells = {};  ///< one cell per column; none in a row that begins a group
  /// The heading of the rows that follow, across all columns; "" in rows with cells.
  std::string group = {};
  /// An HTML comment that the page holds instead of the row; other writers leave it out.
  std::string mark = {};
  std::string attributes = {};  ///< HTML attributes of the row, or of the group: " class=\"taken\""
};

/// The content of a table. All four writers (page, Markdown, LaTeX, CSV) escape the table's texts.
struct Table {
  /// The table's name for screen readers, if the page may scroll the table sideways; "" = the table does not scroll.
  std::string label = {};
  std::string style = {};    ///< CSS class of the table on the page
  std::string caption = {};  ///< caption above the table; "" = none
  std::vector<TableColumn> columns = {};
  std::vector<TableRow> rows = {};
};

std::string TableHtml(const Table& table);
/// Writes a table of GitHub's Markdown, with the caption as a paragraph before the table. Headings of groups are left
/// out.
std::string TableMarkdown(const Table& table);
/// Writes a `tabular` of the package booktabs, without a float, with the caption as a line before the table.
std::string TableLatex(const Table& table);
/// Writes CSV (RFC 4180): the headings, then one line for each row, in which numbers have all their digits. Captions
/// and group headings are left out.
std::string TableCsv(const Table& table);

}  // namespace etude
