#pragma once

#include <optional>
#include <string>
#include <vector>

namespace etude {

/// Neighbouring columns under one head.
struct PaperColumns {
  std::string head;  ///< with the unit: "position error (cm)"
  std::vector<std::string> names;
};

/// One row of figures, as many as the table has columns. Nothing where a value cannot exist or is missing.
struct PaperRow {
  std::string label;
  std::vector<std::optional<double>> values;
};

/// A table of figures in the layout of a printed one: six decimals, values of one row beside each other.
struct PaperTable {
  std::string caption;
  std::vector<PaperColumns> columns;
  std::vector<PaperRow> rows;
};

/// Gives "(a)", "(b)", …, "(z)", "(27)", …
std::string PaperLetter(std::size_t index);

std::string PaperTableHtml(const PaperTable& table);

std::string PaperTableMarkdown(const PaperTable& table);

/// Writes a caption line and a tabular of the package booktabs, without a float around them.
std::string PaperTableLatex(const PaperTable& table);

/// Writes a line per figure, full precision: caption, row, columns' head, column, value. No header line; `prefix`
/// stands before each line.
std::string PaperTableCsv(const PaperTable& table, const std::string& prefix);

}  // namespace etude
