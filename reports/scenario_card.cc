#include "reports/scenario_card.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "engine/base/base64.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/table.h"
#include "io/files/json.h"
#include "reports/badge.h"
#include "reports/comparison_table.h"
#include "reports/overview_table.h"
#include "reports/page_check.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/plots/pairs.h"
#include "reports/plots/plot_section.h"
#include "reports/transitions/transition_section.h"
#include "reports/viewer/recorded_worlds.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

std::string DataUri(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, Base64(bytes));
}

std::string ImageElement(const Picture& picture) {
  return fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", picture.width, picture.height,
                     EscapeMarkup(picture.caption), DataUri("image/png", picture.png));
}

std::string StillElement(const Still& still) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>",
      EscapeMarkup(still.caption), still.jpeg_base64);
}

/// Returns a collapsed section (<details>) of the card; "" if `html` is empty.
std::string Folded(const std::string& title, const std::string& html, std::string_view style = "") {
  if (html.empty()) return "";
  return fmt::format("<details{}><summary>{}</summary>{}</details>", style, EscapeMarkup(title), html);
}

std::string OtherPictures(const RunData& run, const ScenarioSummary& scenario) {
  const std::string html = PlotSectionHtml(run, scenario) + ErrorCurvesHtml(run, scenario);
  return html.empty() ? "" : "<div class=\"plots\">" + html + "</div>";
}

/// Returns the description of the worlds, and one sentence about each method, as HTML.
std::string WhatIsCompared(const ScenarioSummary& scenario) {
  std::string html;
  if (!scenario.description.empty()) html += fmt::format("<p>{}</p>", EscapeMarkup(scenario.description));
  html += "<dl class=\"compared\">";
  for (std::size_t i = 0; i < std::min(scenario.methods.size(), kMaxListed); ++i) {
    const std::string& method = scenario.methods[i];
    html += fmt::format("<div><dt>{}{}</dt><dd>{}</dd></div>", MarkKeySvg(i, i),
                        EscapeMarkup(MethodLabel(scenario, method)),
                        i < scenario.descriptions.size() ? EscapeMarkup(scenario.descriptions[i]) : "");
  }
  return html + "</dl>" + LeftOutHtml(scenario.methods.size(), kMaxListed, "methods", "manifest.json");
}

std::string Expectations(const ScenarioSummary& scenario) {
  if (scenario.expectations.empty()) return "";
  std::string html = "<ul class=\"expectations\">";
  int met = 0, unmet = 0;
  for (const ExpectationResult& e : scenario.expectations) {
    const bool is_met = e.outcome == ClaimOutcome::kMet, is_unmet = e.outcome == ClaimOutcome::kUnmet;
    met += is_met;
    unmet += is_unmet;
    html += fmt::format("<li class=\"{}\"><b>{}</b> {} <span class=\"quiet\">{}</span></li>",
                        is_met     ? "met"
                        : is_unmet ? "unmet"
                                   : "undecided",
                        is_met     ? "✓ met"
                        : is_unmet ? "✗ not met"
                                   : "? undecided",
                        EscapeMarkup(e.text), EscapeMarkup(e.detail));
  }
  const std::string title = fmt::format("Expectations: {}/{} met{}", met, scenario.expectations.size(),
                                        unmet > 0 ? fmt::format(", {} not", unmet) : "");
  return Folded(title, html + "</ul>", unmet > 0 ? " class=\"unmet\"" : "");
}

/// Returns the ID of the first cell that ended for this reason, so that the reader can run the cell again.
std::string FirstCellOf(const RunData& run, const ScenarioSummary& scenario, const ReasonCount& reason) {
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && row.method == reason.method && row.result.status == reason.status &&
        WithoutDoubts(row.result.reason) == reason.reason) {
      return row.Id();
    }
  }
  return "";
}

/// Returns a collapsed section: how many cells ended in each status, which goals the methods reached, why cells failed,
/// and doubts about files. The section's title, which is always visible, counts the cells that are not ok or doubtful.
std::string Failures(const RunData& run, const ScenarioSummary& scenario, const ScenarioFindings& findings) {
  int others = 0;
  for (const ReasonCount& reason : findings.reasons) others += reason.cells;
  std::string html = "<div class=\"bar\" aria-hidden=\"true\">";
  for (const auto& [status, count] : findings.statuses) {
    html += fmt::format("<i class=\"s-{}\" style=\"flex-grow:{}\"></i>", StatusName(status), count);
  }
  html += fmt::format("</div><p>{}</p>", EscapeMarkup(StatusSentence(findings)));
  for (const SuccessFinding& success : findings.successes) {
    html += fmt::format("<p>{}</p>", EscapeMarkup(SuccessSentence(success)));
  }
  if (!findings.reasons.empty()) {
    html += "<ul class=\"reasons\">";
    for (const ReasonCount& reason : std::span(findings.reasons).first(std::min(findings.reasons.size(), kMaxListed))) {
      html += fmt::format("<li data-ids=\"{}\"><b>{} × {}</b> in {}: {}</li>",
                          EscapeMarkup(FirstCellOf(run, scenario, reason)), FormatCount(reason.cells),
                          StatusName(reason.status), EscapeMarkup(reason.method), EscapeMarkup(reason.Words()));
    }
    html += "</ul>" + LeftOutHtml(findings.reasons.size(), kMaxListed, "reasons", "cells.jsonl");
  }
  if (!findings.doubts.empty()) {
    html += "<ul class=\"reasons\">";
    for (const ReasonCount& doubt : std::span(findings.doubts).first(std::min(findings.doubts.size(), kMaxListed))) {
      html += fmt::format("<li>{}</li>", EscapeMarkup(DescribeCount(doubt)));
    }
    html += "</ul>" + LeftOutHtml(findings.doubts.size(), kMaxListed, "doubts", "cells.jsonl");
  }
  std::string title = others == 0
                          ? fmt::format("{} ok", Plural(findings.cells, "cell"))
                          : fmt::format("Not ok: {} of {}", FormatCount(others), Plural(findings.cells, "cell"));
  if (findings.doubtful > 0) title += fmt::format(", {} doubtful", FormatCount(findings.doubtful));
  return Folded(title, "<div class=\"status\">" + html + "</div>");
}

/// Returns the IDs of those cells of a scenario that kept a recording, as JSON for the page's script.
std::string RecordedCells(const RunData& run, const ScenarioSummary& scenario) {
  Json cells = Json::array();
  for (const CellRecording& recorded : run.recordings) {
    if (recorded.cell.starts_with(scenario.name + "/")) cells.push_back(recorded.cell);
  }
  return cells.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns the sentence of a finding as HTML, preceded by `begin`.
std::string AnswerHtml(const MethodFinding& finding, std::string_view begin) {
  if (finding.sentence.empty()) return "";
  return fmt::format("<p class=\"answer\">{}{}</p>", begin, EscapeMarkup(finding.sentence));
}

/// Returns the verdicts and the sentence about the comparison with the baseline. If the strongest other method is not
/// the baseline, adds a collapsed part with the verdicts and the sentence about the comparison with that method.
std::string AnswerBlock(const ScenarioFindings& findings) {
  const std::string html = AnswerHtml(findings.answer, VerdictBadges(findings.answer) + " ");
  if (!HasOtherRival(findings)) return html;
  return html +
         fmt::format(
             "<details class=\"rival\"><summary>Compared with the strongest other method, {}: {}</summary>{}</details>",
             EscapeMarkup(findings.rival.others), VerdictBadges(findings.rival), AnswerHtml(findings.rival, ""));
}

std::string FiguresHtml(const KeyFigures& figures) {
  if (figures.methods.empty()) return "";
  Table table = FiguresTable(figures, false);
  table.style = "figures";
  return TableHtml(table);
}

std::string Files(const RunData& run, const ScenarioSummary& scenario, std::size_t index) {
  const std::string tables = "tables/" + FileNameOf(scenario.name, index);
  std::string html = "<ul class=\"files\">";
  const auto link = [&](const std::string& path, std::string_view what) {
    html += fmt::format("<li><a href=\"{}\">{}</a> {}</li>", EscapeMarkup(UrlPath(path)), EscapeMarkup(path), what);
  };
  link(tables + ".csv", "all numbers");
  link(tables + "-comparisons.csv", "all comparisons");
  link(tables + ".tex", "numbers and comparisons as LaTeX tables");
  link("../manifest.json", "the text of the scenario, and all data that are needed to repeat the run");
  std::size_t motions = 0;
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (row->scenario != scenario.name || row->task != "capture" || ++motions > kMaxListed) continue;
    link("motions/" + MotionFileOf(recorded->cell), "recovered motion");
  }
  return Folded("Files", html + "</ul>" + LeftOutHtml(motions, kMaxListed, "motions", "report/motions"));
}

std::string ScenarioFilms(const ScenarioSummary& scenario, const Media& media) {
  std::string html;
  for (const ScenarioFilm& shown : media.scenario_films) {
    if (shown.scenario == scenario.name) html += FilmElement(shown.film, false);
  }
  return html;
}

std::string Strip(const ScenarioSummary& scenario, const Media& media) {
  if (media.strip_scenario != scenario.name || media.strip.empty()) return "";
  std::string html = "<div class=\"strip\">";
  for (const Picture& picture : media.strip) {
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>", ImageElement(picture),
                        EscapeMarkup(picture.caption));
  }
  for (const Still& still : media.stills) html += StillElement(still);
  return html + "</div>";
}

std::string Plates(const ScenarioSummary& scenario, const Media& media) {
  std::string html;
  for (const ScenarioPicture& shown : media.plates) {
    if (shown.scenario != scenario.name) continue;
    html += fmt::format("<figure>{1}<figcaption>{0}</figcaption></figure>", EscapeMarkup(shown.picture.caption),
                        ImageElement(shown.picture));
  }
  return html;
}

}  // namespace

std::string FilmElement(const Film& film, bool plays_at_once) {
  const Picture& poster = film.poster;
  if (film.mp4.empty() && poster.png.empty()) {
    return film.why_not.empty() ? "" : fmt::format("<p class=\"quiet\">{}</p>", EscapeMarkup(film.why_not));
  }
  const std::string caption = EscapeMarkup(poster.caption);
  if (film.mp4.empty()) {
    return fmt::format("<figure class=\"film\">{}<figcaption>{} {}</figcaption></figure>", ImageElement(poster),
                       caption, EscapeMarkup(film.why_not));
  }
  return fmt::format(
      "<figure class=\"film\"><video controls loop muted playsinline{} width=\"{}\" height=\"{}\" poster=\"{}\" "
      "src=\"{}\" aria-label=\"{}\"></video><figcaption>{} <a href=\"{}\">video/{}</a></figcaption></figure>",
      plays_at_once ? " autoplay" : "", poster.width, poster.height, DataUri("image/png", poster.png),
      DataUri("video/mp4", film.mp4), caption, caption, EscapeMarkup(UrlPath("../video/" + film.file)),
      EscapeMarkup(film.file));
}

std::string CardAnchor(std::size_t index) { return fmt::format("scenario-{}", index + 1); }

std::string WriteScenarioCard(const RunData& run, std::size_t index, const ScenarioFindings& findings,
                              const Media& media) {
  const ScenarioSummary& scenario = run.scenarios[index];
  const std::string anchor = CardAnchor(index);
  std::string html = fmt::format("<article class=\"card\" id=\"{}\" aria-labelledby=\"{}-title\" data-recorded=\"{}\">",
                                 anchor, anchor, EscapeMarkup(RecordedCells(run, scenario)));
  html += fmt::format("<p class=\"eyebrow\">{}</p><h2 id=\"{}-title\">{}</h2>", EscapeMarkup(scenario.name), anchor,
                      EscapeMarkup(scenario.question.empty() ? scenario.name : scenario.question));
  html += "<div class=\"lead\"><div>" + AnswerBlock(findings) + FiguresHtml(findings.figures) + "</div>";
  const std::string picture = LeadPictureHtml(run, scenario);
  html += picture.empty() ? "<p class=\"quiet\">There is no picture, because no cell has a value.</p></div>"
                          : picture + "</div>";
  html += WatchHtml(run, index);
  const std::string stills = Strip(scenario, media) + Plates(scenario, media);
  html += kMediaBegin;
  html += Folded(stills.empty() ? "Film" : "Film, stills", ScenarioFilms(scenario, media) + stills);
  html += kMediaEnd;
  html += Folded("Methods", WhatIsCompared(scenario));
  html += Folded("Metrics", OverviewTableHtml(run, scenario));
  html += Folded(Plural(static_cast<long long>(CountComparisons(scenario)), "comparison"),
                 ComparisonTableHtml(scenario) + AcrossTableHtml(scenario));
  html += Expectations(scenario);
  html += Failures(run, scenario, findings);
  html += Folded("Pair by pair", PairsHtml(run, scenario));
  html += Folded("Pictures", OtherPictures(run, scenario));
  html += PosePairsHtml(run, scenario);
  html += Folded("Transitions explained", TransitionsHtml(RecordedRequestsOf(run, scenario)));
  html += PaperAHtml(scenario) + PaperBHtml(run, scenario);
  return html + Files(run, scenario, index) + "</article>";
}

}  // namespace etude
