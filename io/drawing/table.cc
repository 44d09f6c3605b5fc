#include "io/drawing/table.h"

#include <fmt/core.h>

#include <algorithm>

#include "engine/base/csv.h"
#include "io/drawing/escape.h"
#include "io/drawing/numbers.h"

namespace etude {
namespace {

/// Neighbouring columns under one common heading.
struct Span {
  std::string head;
  std::size_t first = 0, columns = 0;
};

/// Returns the upper headings; empty if no column has an upper heading.
std::vector<Span> SpansOf(const Table& table) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::string& over = table.columns[i].over;
    if (spans.empty() || spans.back().head != over) spans.push_back({over, i, 0});
    ++spans.back().columns;
  }
  const bool has_heads = std::ranges::any_of(spans, [](const Span& span) { return !span.head.empty(); });
  return has_heads ? spans : std::vector<Span>();
}

std::string_view ClassOf(bool is_number, bool is_detail) {
  if (is_number) return is_detail ? " class=\"n more\"" : " class=\"n\"";
  return is_detail ? " class=\"more\"" : "";
}

std::string HeadHtml(const TableColumn& column) {
  if (column.head.empty()) return "<td></td>";
  const std::string title = column.title.empty() ? "" : fmt::format(" title=\"{}\"", EscapeMarkup(column.title));
  return fmt::format("<th scope=\"col\"{}{}>{}{}</th>", ClassOf(column.is_number, column.is_detail), title,
                     EscapeMarkup(column.head), column.sign);
}

std::string CellHtml(const TableCell& cell, const TableColumn& column) {
  const std::string content = cell.html.empty() ? EscapeMarkup(cell.text) : cell.html;
  if (column.is_row_head) return fmt::format("<th scope=\"row\">{}</th>", content);
  const std::string sorted = column.is_sortable ? fmt::format(" data-v=\"{}\"", ExactText(cell.number)) : "";
  return fmt::format("<td{}{}>{}</td>", ClassOf(column.is_number && !content.empty(), column.is_detail), sorted,
                     content);
}

std::string RowHtml(const TableRow& row, const Table& table) {
  if (!row.mark.empty()) return row.mark;
  if (!row.group.empty()) {
    return fmt::format("<tbody{}><tr class=\"group\"><th scope=\"rowgroup\" colspan=\"{}\">{}</th></tr>",
                       row.attributes, table.columns.size(), EscapeMarkup(row.group));
  }
  std::string html = fmt::format("<tr{}>", row.attributes);
  for (std::size_t i = 0; i < row.cells.size(); ++i) html += CellHtml(row.cells[i], table.columns[i]);
  return html + "</tr>";
}

}  // namespace

std::string TableHtml(const Table& table) {
  std::string html = table.style.empty() ? "<table>" : fmt::format("<table class=\"{}\">", table.style);
  if (!table.caption.empty()) html += fmt::format("<caption>{}</caption>", EscapeMarkup(table.caption));

  html += "<thead>";
  std::string over;
  for (const Span& span : SpansOf(table)) {
    over += span.head.empty()
                ? "<td></td>"
                : fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", span.columns, EscapeMarkup(span.head));
  }
  if (!over.empty()) html += fmt::format("<tr>{}</tr>", over);
  html += "<tr>";
  for (const TableColumn& column : table.columns) html += HeadHtml(column);
  html += "</tr></thead>";

  // Each group of rows becomes a <tbody> of its own.
  bool is_open = table.rows.empty() || table.rows.front().group.empty();
  if (is_open) html += "<tbody>";
  for (const TableRow& row : table.rows) {
    if (!row.group.empty() && is_open) html += "</tbody>";
    html += RowHtml(row, table);
    is_open = true;
  }
  html += "</tbody></table>";
  if (table.label.empty()) return html;
  return fmt::format("<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\">{}</div>",
                     EscapeMarkup(table.label), html);
}

std::string TableMarkdown(const Table& table) {
  std::string text = table.caption.empty() ? "\n|" : fmt::format("\n{}\n\n|", EscapeMarkdown(table.caption));
  std::string rule = "|";
  for (const TableColumn& column : table.columns) {
    const std::string head = column.over.empty() ? column.head : column.over + " " + column.head;
    text += head.empty() ? " |" : fmt::format(" {} |", EscapeMarkdown(head));
    rule += column.is_number ? "--:|" : "---|";
  }
  text += fmt::format("\n{}\n", rule);
  for (const TableRow& row : table.rows) {
    if (!row.group.empty() || !row.mark.empty()) continue;
    text += "|";
    for (const TableCell& cell : row.cells) {
      const std::string words = EscapeMarkdown(cell.text);
      text += cell.is_strong ? fmt::format(" **{}** |", words) : fmt::format(" {} |", words);
    }
    text += '\n';
  }
  return text;
}

std::string TableLatex(const Table& table) {
  const auto append = [](std::string& line, const std::string& cell, bool is_first) {
    line += is_first ? cell : cell.empty() ? " &" : " & " + cell;
  };
  // Collect the alignments, the headings, and the headings over several columns with the lines below them.
  std::string places, heads, over, rules;
  for (const TableColumn& column : table.columns) {
    places += column.is_number ? 'r' : 'l';
    append(heads, column.latex.empty() ? EscapeLatex(column.head) : column.latex, &column == &table.columns.front());
  }
  for (const Span& span : SpansOf(table)) {
    const bool is_head = !span.head.empty();
    append(over, is_head ? fmt::format("\\multicolumn{{{}}}{{c}}{{{}}}", span.columns, EscapeLatex(span.head)) : "",
           span.first == 0);
    if (is_head) rules += fmt::format("\\cmidrule(lr){{{}-{}}}", span.first + 1, span.first + span.columns);
  }

  // Write the caption and the heads.
  std::string text = table.caption.empty() ? "" : EscapeLatex(table.caption) + "\\\\[2pt]\n";
  text += fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n", places);
  if (!over.empty()) text += fmt::format("{} \\\\\n{}\n", over, rules);
  text += heads + " \\\\\n";
  if (table.rows.empty() || table.rows.front().group.empty()) text += "\\midrule\n";
  // Write the rows; each group begins with a rule and the group's name.
  for (const TableRow& row : table.rows) {
    if (!row.mark.empty()) continue;
    if (!row.group.empty()) {
      text += fmt::format("\\midrule\n\\multicolumn{{{}}}{{l}}{{\\emph{{{}}}}} \\\\\n", table.columns.size(),
                          EscapeLatex(row.group));
      continue;
    }
    std::string line;
    for (const TableCell& cell : row.cells) {
      append(line, EscapeLatex(cell.text) + std::string(cell.latex_sign), &cell == &row.cells.front());
    }
    text += line + " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string TableCsv(const Table& table) {
  std::string csv;
  for (const TableColumn& column : table.columns) csv += (csv.empty() ? "" : ",") + CsvText(column.head);
  csv += '\n';
  for (const TableRow& row : table.rows) {
    if (!row.group.empty() || !row.mark.empty()) continue;
    std::string line;
    for (const TableCell& cell : row.cells) {
      if (&cell != &row.cells.front()) line += ',';
      line += cell.number ? ExactText(cell.number) : CsvText(cell.text);
    }
    csv += line + '\n';
  }
  return csv;
}

}  // namespace etude
