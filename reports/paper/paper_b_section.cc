#include "reports/paper/paper_b_section.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/paper/effector_curves.h"
#include "reports/paper/paper_b_figures.h"
#include "reports/paper/paper_b_tables.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

// So many tables of one kind fit a page of A4.
constexpr std::size_t kErrorTablesPerFloat = 6;
constexpr std::size_t kAngleTablesPerFloat = 3;

std::string Under(const PaperBCondition& condition) {
  return condition.condition.empty() ? "" : ", " + ConditionLabel(condition.condition);
}

// Table 5.2 has what 5.1 has, and the hidden angles.
std::string_view TableName(const PaperBSet& set) { return set.angles.empty() ? "table 5.1" : "table 5.2"; }

std::string Note(const PaperBSet& set) {
  return set.angle_note.empty() ? set.error_note : set.error_note + " " + set.angle_note;
}

std::string TablesHtml(const std::vector<PaperTable>& tables, std::string_view shape) {
  if (tables.empty()) return "";
  std::string html = fmt::format("<div class=\"tables {}\">", shape);
  for (const PaperTable& table : tables) html += PaperTableHtml(table);
  return html + "</div>";
}

std::string SetHtml(const PaperBCondition& condition, const PaperBSet& set, bool open) {
  std::string html = fmt::format("<details{}><summary>Paper B’s {}: {}{}</summary>", open ? " open" : "",
                                 TableName(set), EscapeMarkup(set.title), EscapeMarkup(Under(condition)));
  html += fmt::format("<p class=\"quiet legend\">{}", EscapeMarkup(Note(set)));
  if (!set.replay.empty()) {
    html += fmt::format(" The trial again: <code>{}</code>", EscapeMarkup(set.replay));
  }
  html += "</p>" + TablesHtml(set.errors, "wide") + "<ul class=\"reasons\">";
  for (const std::string& outcome : set.outcomes) html += fmt::format("<li>{}</li>", EscapeMarkup(outcome));
  return html + "</ul>" + TablesHtml(set.angles, "narrow") + "</details>";
}

constexpr std::string_view kPrinted =
    "What paper B prints of its one simulated pose, which it does not give: compare sizes, not figures. As printed, "
    "the elbow and the wrist of the right arm share a value in 5.2 (d).";

std::string PrintedHtml(bool with_angles) {
  std::string html = fmt::format(
      "<details><summary>Tables 5.1 and 5.2 as printed in the paper</summary><p class=\"quiet legend\">{}</p>",
      kPrinted);
  html += TablesHtml(PaperBPrintedErrors(), "wide");
  if (with_angles) html += TablesHtml(PaperBPrintedAngles(), "narrow");
  return html + "</details>";
}

/// Floats of at most `most` tables each, the note beneath the first.
std::string FloatsLatex(const std::vector<PaperTable>& tables, std::size_t most, const std::string& caption,
                        const std::string& note) {
  std::string text;
  for (std::size_t begin = 0; begin < tables.size(); begin += most) {
    text += fmt::format("\n\\begin{{table}}[!htbp]\n\\centering\\small\n\\caption{{{}{}}}\n", EscapeLatex(caption),
                        begin == 0 ? ". " + EscapeLatex(note) : " (continued)");
    for (std::size_t i = begin; i < std::min(begin + most, tables.size()); ++i) {
      text += "\\par\\medskip\n" + PaperTableLatex(tables[i]);
    }
    text += "\\end{table}\n";
  }
  return text;
}

}  // namespace

bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario) {
  return HasPaperBTables(run, scenario) || HasEffectorCurves(run, scenario);
}

std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html = EffectorCurvesHtml(run, scenario);
  bool open = true, with_angles = false;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      html += SetHtml(condition, set, open);
      open = false;
      with_angles = with_angles || !set.angles.empty();
    }
  }
  // No trial left a distance to close, so there are no tables to compare with the paper's.
  return open ? html : html + PrintedHtml(with_angles);
}

std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario) {
  std::string text;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      text += fmt::format("\n<details><summary>Paper B's {}: {}{}</summary>\n\n{}\n", TableName(set),
                          EscapeMarkup(set.title), EscapeMarkup(Under(condition)), EscapeMarkdown(Note(set)));
      if (!set.replay.empty()) text += fmt::format("\nThe trial again: {}\n", EscapeMarkdown(set.replay));
      for (const PaperTable& table : set.errors) text += PaperTableMarkdown(table);
      text += '\n';
      for (const std::string& outcome : set.outcomes) text += fmt::format("- {}\n", EscapeMarkdown(outcome));
      for (const PaperTable& table : set.angles) text += PaperTableMarkdown(table);
      text += "\n</details>\n";
    }
  }
  return text;
}

std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario) {
  std::string text;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      const std::string caption = fmt::format("{}: {}{}", scenario.name, set.title, Under(condition));
      std::string note = set.error_note;
      for (const std::string& outcome : set.outcomes) note += fmt::format(" {}.", outcome);
      text += FloatsLatex(set.errors, kErrorTablesPerFloat, caption, note);
      text += FloatsLatex(set.angles, kAngleTablesPerFloat, caption + ", hidden angles", set.angle_note);
    }
  }
  return text;
}

std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario) {
  std::string csv;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      const std::string prefix = fmt::format("{},{},{},", EscapeCsv(scenario.name),
                                             EscapeCsv(ConditionLabel(condition.condition)), EscapeCsv(set.title));
      for (const PaperTable& table : set.errors) csv += PaperTableCsv(table, prefix);
      for (const PaperTable& table : set.angles) csv += PaperTableCsv(table, prefix);
    }
  }
  return csv.empty() ? "" : "scenario,condition,trials,table,row,quantity,axis,value\n" + csv;
}

}  // namespace etude
