#include "reports/scenario_card.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "bench/files/json.h"
#include "engine/base/base64.h"
#include "reports/badge.h"
#include "reports/charts.h"
#include "reports/comparison_table.h"
#include "reports/number_table.h"
#include "reports/overview_table.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/plots/growth.h"
#include "reports/plots/plot_section.h"
#include "reports/transitions/transition_section.h"
#include "reports/viewer/recorded_worlds.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

std::string DataUri(std::string_view type, const std::string& bytes) {
  return fmt::format("data:{};base64,{}", type, Base64(bytes));
}

/// Writes an <img> with the picture inside the page.
std::string ImageElement(const Picture& picture) {
  return fmt::format("<img width=\"{}\" height=\"{}\" alt=\"{}\" src=\"{}\">", picture.width, picture.height,
                     EscapeMarkup(picture.caption), DataUri("image/png", picture.png));
}

/// Writes a <figure> with the still and its caption.
std::string StillElement(const Still& still) {
  return fmt::format(
      "<figure><img alt=\"{0}\" src=\"data:image/jpeg;base64,{1}\"><figcaption>{0}</figcaption></figure>",
      EscapeMarkup(still.caption), still.jpeg_base64);
}

// The data is embedded as a JSON element beside the canvas, which the browser never runs.
std::string ChartFigure(const Chart& chart, const std::string& id) {
  return fmt::format(
      "<figure class=\"chart{}\"><figcaption>{}</figcaption><div class=\"canvas\">"
      "<canvas data-chart=\"{}\" role=\"img\" aria-label=\"{}\"></canvas></div>"
      "<script type=\"application/json\" id=\"{}\">{}</script></figure>",
      chart.is_wide ? " full" : "", EscapeMarkup(chart.caption), id, EscapeMarkup(chart.description), id,
      EscapeScriptJson(chart.json));
}

std::string Charts(const RunData& run, const ScenarioSummary& scenario, std::size_t index) {
  std::string html = PlotSectionHtml(run, scenario);
  if (const auto chart = CurveChart(run, scenario)) {
    html += fmt::format("<div class=\"charts\">{}</div>", ChartFigure(*chart, fmt::format("chart-{}-curves", index)));
  }
  return html.empty() ? "<p class=\"quiet\">No cell gave a value that could be drawn.</p>" : html;
}

std::string Methods(const ScenarioFindings& findings) {
  // With one alternative the table would only repeat the answer.
  const std::size_t others = findings.methods.size() > 1 ? findings.methods.size() : 0;
  if (others + findings.yardsticks.size() == 0) return "";
  std::string html = "<ul class=\"methods\" aria-label=\"Every method compared with its baseline\">";
  for (std::size_t i = 0; i < std::min(others, kMostListed); ++i) {
    const MethodFinding& method = findings.methods[i];
    html +=
        fmt::format("<li title=\"{}\">{} <span class=\"name\">{}</span> <span class=\"quiet\">against {}</span></li>",
                    EscapeMarkup(method.sentence), VerdictBadges(method), EscapeMarkup(method.method),
                    EscapeMarkup(method.baseline));
  }
  for (const std::string& yardstick : findings.yardsticks) {
    html += fmt::format(
        "<li title=\"Compared with none: what the others are measured by.\"><span class=\"badge same\">"
        "yardstick</span> <span class=\"name\">{}</span></li>",
        EscapeMarkup(yardstick));
  }
  return html + "</ul>" + LeftOutHtml(others, kMostListed, "methods", "the CSV file of comparisons in report/tables");
}

std::string Expectations(const ScenarioSummary& scenario) {
  if (scenario.expectations.empty()) return "";
  std::string html = "<ul class=\"expectations\">", figures;
  for (const ExpectationResult& e : scenario.expectations) {
    const bool met = e.ruling == Ruling::kMet, unmet = e.ruling == Ruling::kUnmet;
    html += fmt::format("<li class=\"{}\"><b>{}</b> <span>{}</span></li>",
                        met     ? "met"
                        : unmet ? "unmet"
                                : "undecided",
                        met     ? "✓ expected and met"
                        : unmet ? "✗ expected, not met"
                                : "? could not be decided",
                        EscapeMarkup(e.text));
    figures += fmt::format("<li><b>{}</b> {}</li>", EscapeMarkup(e.text), EscapeMarkup(e.detail));
  }
  return html + "</ul><details><summary>Figures behind the expectations</summary><ul class=\"reasons\">" + figures +
         "</ul></details>";
}

std::string Failures(const ScenarioFindings& findings) {
  if (findings.reasons.empty()) return "";
  std::string html = "<details><summary>Cells that did not end ok, and why</summary><ul class=\"reasons\">";
  for (const ReasonCount& reason : std::span(findings.reasons).first(std::min(findings.reasons.size(), kMostListed))) {
    html += fmt::format("<li><b>{} × {}</b> in {}: {}</li>", FormatCount(reason.cells), StatusName(reason.status),
                        EscapeMarkup(reason.method), EscapeMarkup(reason.reason));
  }
  return html + "</ul>" + LeftOutHtml(findings.reasons.size(), kMostListed, "reasons", "cells.jsonl") + "</details>";
}

// How the cells ended, as a bar whose widths are shares; the words below it say the same.
std::string StatusBar(const ScenarioFindings& findings) {
  std::string html = "<div class=\"status\"><div class=\"bar\" aria-hidden=\"true\">";
  for (const auto& [status, count] : findings.statuses) {
    html += fmt::format("<i class=\"s-{}\" style=\"flex-grow:{}\"></i>", StatusName(status), count);
  }
  html += fmt::format("</div><p>{}</p>", EscapeMarkup(StatusSentence(findings)));
  for (const SuccessFinding& success : findings.successes) {
    html += fmt::format("<p>{}</p>", EscapeMarkup(SuccessSentence(success)));
  }
  return html + "</div>";
}

/// Lists the cells of a scenario that kept a recording, as JSON for the page's script.
std::string RecordedCells(const RunData& run, const ScenarioSummary& scenario) {
  Json cells = Json::array();
  for (const CellRecording& recorded : run.recordings) {
    if (recorded.cell.starts_with(scenario.name + "/")) cells.push_back(recorded.cell);
  }
  return cells.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Writes the answer in a line, then with its figures: against the baseline, and against the strongest other method.
std::string Answer(const ScenarioFindings& findings) {
  std::string html;
  if (!findings.headline.empty()) html += fmt::format("<p class=\"headline\">{}</p>", EscapeMarkup(findings.headline));
  html += fmt::format("<p class=\"answer\">{} {}</p>", VerdictBadges(findings.answer),
                      EscapeMarkup(findings.answer.sentence));
  if (!findings.rival.is_compared) return html;
  return html + fmt::format("<p class=\"answer\"><b>Against the strongest other method.</b> {} {}</p>",
                            VerdictBadges(findings.rival), EscapeMarkup(findings.rival.sentence));
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
    html += fmt::format("<details open><summary>{}</summary>{}</details>", EscapeMarkup(shown.picture.caption),
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
      "src=\"{}\" aria-label=\"{}\"></video><figcaption>{} <code>video/{}</code></figcaption></figure>",
      plays_at_once ? " autoplay" : "", poster.width, poster.height, DataUri("image/png", poster.png),
      DataUri("video/mp4", film.mp4), caption, caption, EscapeMarkup(film.file));
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
  html += Answer(findings);
  html += Strip(scenario, media);
  html += Plates(scenario, media);
  html += ScenarioFilms(scenario, media);
  html += Charts(run, scenario, index);
  html += WatchHtml(run, index);
  html += Methods(findings);
  html += AcrossTableHtml(scenario);
  html += Expectations(scenario);
  html += StatusBar(findings);
  html += PosePairsHtml(run, scenario);
  html += OverviewTableHtml(scenario);
  html += TransitionsHtml(RecordedRequestsOf(run, scenario));
  html += PaperAHtml(scenario);
  html += PaperBHtml(run, scenario);
  html += GrowthHtml(run, scenario);
  html += Failures(findings);
  if (const std::string table = ComparisonTableHtml(scenario); !table.empty()) {
    html += fmt::format("<details><summary>Every comparison</summary>{}</details>", table);
  }
  html += fmt::format("<details><summary>All numbers</summary>{}</details></article>", NumberTableHtml(run, scenario));
  return html;
}

}  // namespace etude
