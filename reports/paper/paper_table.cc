#include "reports/paper/paper_table.h"

#include <fmt/core.h>

#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr int kDecimals = 6;  // as paper B prints

std::string Figure(const std::optional<double>& value) {
  return value ? FormatFixed(*value, kDecimals) : std::string(kNoValue);
}

std::size_t ColumnCount(const PaperTable& table) {
  std::size_t count = 0;
  for (const PaperColumns& group : table.columns) count += group.names.size();
  return count;
}

}  // namespace

std::string PaperLetter(std::size_t index) {
  return index < 26 ? fmt::format("({})", static_cast<char>('a' + index)) : fmt::format("({})", index + 1);
}

std::string PaperTableHtml(const PaperTable& table) {
  std::string heads, names;
  for (const PaperColumns& group : table.columns) {
    heads += fmt::format("<th scope=\"colgroup\" colspan=\"{}\">{}</th>", group.names.size(), EscapeMarkup(group.head));
    for (const std::string& name : group.names) {
      names += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", EscapeMarkup(name));
    }
  }
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{}\"><table class=\"printed\"><caption>{}"
      "</caption><thead><tr><td></td>{}</tr><tr><td></td>{}</tr></thead><tbody>",
      EscapeMarkup(table.caption), EscapeMarkup(table.caption), heads, names);
  for (const PaperRow& row : table.rows) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", EscapeMarkup(row.label));
    for (const auto& value : row.values) html += fmt::format("<td class=\"n\">{}</td>", Figure(value));
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

std::string PaperTableMarkdown(const PaperTable& table) {
  std::string heads = "| |", rule = "|---|";
  for (const PaperColumns& group : table.columns) {
    for (const std::string& name : group.names) {
      heads += fmt::format(" {} {} |", EscapeMarkdown(group.head), EscapeMarkdown(name));
      rule += "---:|";
    }
  }
  std::string text = fmt::format("\n{}\n\n{}\n{}\n", EscapeMarkdown(table.caption), heads, rule);
  for (const PaperRow& row : table.rows) {
    text += fmt::format("| {} |", EscapeMarkdown(row.label));
    for (const auto& value : row.values) text += fmt::format(" {} |", Figure(value));
    text += '\n';
  }
  return text;
}

std::string PaperTableLatex(const PaperTable& table) {
  std::string heads, rules, names;
  std::size_t column = 2;
  for (const PaperColumns& group : table.columns) {
    const std::size_t last = column + group.names.size() - 1;
    heads += fmt::format(" & \\multicolumn{{{}}}{{c}}{{{}}}", group.names.size(), EscapeLatex(group.head));
    rules += fmt::format("\\cmidrule(lr){{{}-{}}}", column, last);
    for (const std::string& name : group.names) names += " & " + EscapeLatex(name);
    column = last + 1;
  }
  std::string text = fmt::format("{}\\\\[2pt]\n\\begin{{tabular}}{{l{}}}\n\\toprule\n{} \\\\\n{}\n{} \\\\\n\\midrule\n",
                                 EscapeLatex(table.caption), std::string(ColumnCount(table), 'r'), heads, rules, names);
  for (const PaperRow& row : table.rows) {
    text += EscapeLatex(row.label);
    for (const auto& value : row.values) text += " & " + EscapeLatex(Figure(value));
    text += " \\\\\n";
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

std::string PaperTableCsv(const PaperTable& table, const std::string& prefix) {
  std::string csv;
  for (const PaperRow& row : table.rows) {
    std::size_t i = 0;
    for (const PaperColumns& group : table.columns) {
      for (const std::string& name : group.names) {
        const std::optional<double>& value = row.values[i++];
        csv += fmt::format("{}{},{},{},{},{}\n", prefix, EscapeCsv(table.caption), EscapeCsv(row.label),
                           EscapeCsv(group.head), EscapeCsv(name),
                           ExactText(value));
      }
    }
  }
  return csv;
}

}  // namespace etude
