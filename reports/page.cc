#include "reports/page.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/assets/assets.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/table.h"
#include "reports/badge.h"
#include "reports/comparison_table.h"
#include "reports/faulty_clips.h"
#include "reports/overview_table.h"
#include "reports/page_check.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/plots/pairs.h"
#include "reports/scenario_card.h"
#include "reports/transitions/recorded_requests.h"
#include "reports/viewer/recorded_worlds.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"

namespace etude {
namespace {

constexpr const char* kMetric = "mpjpe_mm";

std::string Millimetres(std::optional<double> mm) { return mm ? FormatNumber(*mm) : std::string(kNoValue); }

/// Returns the word for the number that a real take measures: "error", or "agreement" if the reference may come from
/// the same keypoints as the answer and therefore share the answer's errors.
std::string MeasureOf(const RealTake& take) { return take.recovery == "keypoints" ? "agreement" : "error"; }

void AddRealRows(const RealTake& take, Table& table) {
  for (const RealDistance& distance : take.distances) {
    const std::string cameras = distance.cameras == "all" ? fmt::format("all {}", take.films.size()) : distance.cameras;
    table.rows.push_back({{fmt::format("real: {}, {}", take.name, Plural(take.frames, "frame")),
                           fmt::format("{} ({})", take.recovery, MeasureOf(take)), cameras,
                           Millimetres(distance.median_mm), Millimetres(distance.p95_mm)}});
  }
}

/// Adds one row per simulated capture method to the table of real takes. `rows` counts the rows of all scenarios,
/// including those beyond the table's limit.
void AddSimulatedRows(const ScenarioSummary& scenario, std::size_t& rows, Table& table) {
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      const MetricSummary* metric = FindSummary(method, kMetric);
      if (metric == nullptr || !metric->median) continue;
      if (++rows > kMaxTableRows) continue;
      const std::string label = ConditionLabel(condition.condition);
      table.rows.push_back({.cells = {fmt::format("simulated: {}{}{}", scenario.name, label.empty() ? "" : ", ", label),
                                      MethodLabel(scenario, method.method) + " (error)", kNoValue,
                                      Millimetres(metric->median), kNoValue},
                            .attributes = " class=\"quiet\""});
    }
  }
}

// The Content-Security-Policy: the page may load only the motion scripts beside the page. This protects readers even if
// escaping fails.
constexpr std::string_view kPolicy =
    "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'self' file:; img-src data:; media-src "
    "data:";

// Returns the styles that the page uses.
std::string Styles(const RunData& run) {
  const bool shows_curves = std::ranges::any_of(run.scenarios, [&](const ScenarioSummary& scenario) {
    return ShowsPaperA(scenario) || ShowsPaperB(run, scenario) || ShowsPairs(scenario);
  });
  const bool shows_transitions = std::ranges::any_of(
      run.scenarios, [&](const ScenarioSummary& scenario) { return !RecordedRequestsOf(run, scenario).empty(); });
  return std::string(ReportCss()) + MarksCss() + std::string(shows_curves ? PaperCss() : "") +
         std::string(shows_transitions ? TransitionsCss() : "") +
         std::string(run.recordings.empty() ? "" : ViewerCss());
}

std::string Head(const RunData& run) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
      "<meta name=\"color-scheme\" content=\"light dark\"><title>{} · Etude</title><style>{}</style></head>\n",
      kPolicy, EscapeMarkup(run.suite), Styles(run));
}

/// Returns the list of answers: one line per scenario, with the verdicts of the method in question against the baseline
/// and against the strongest other method.
std::string Answers(const RunData& run, const std::vector<ScenarioFindings>& findings) {
  std::string html = "<nav aria-label=\"Answers\"><ol class=\"answers\">";
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) {
    const ScenarioSummary& scenario = run.scenarios[i];
    const std::string& headline = findings[i].headline;
    html += fmt::format("<li><a href=\"#{}\"><b>{}</b><span class=\"badges\">{}{}</span><span>{}</span></a></li>",
                        CardAnchor(i), EscapeMarkup(scenario.name), FindingBadge(findings[i].answer, ""),
                        HasOtherRival(findings[i]) ? FindingBadge(findings[i].rival, "") : "",
                        EscapeMarkup(headline.empty() ? scenario.question : headline));
  }
  return html + "</ol></nav>";
}

constexpr std::string_view kHowToRead =
    R"(<p>A <b>world</b> is one simulated trial whose truth is known. Every method gets the same worlds, so
methods are compared world by world. In pictures, a dot is a world, a thick line is the median (for shares, the mean),
and a box covers the middle half of the worlds. <b>Better</b> and <b>worse</b> mean that the interval of the
difference excludes zero and that the difference matters in practice. <b>No difference</b> means that the interval
contains only differences that do not matter. <b>Undecided</b> means that the data do not settle the question; it does
not mean that there is no difference.</p>
<p>An <b>answer</b> states which of two methods is better. It first compares <b>success</b>: which method solves, finds
or recovers more. A difference of 5 percentage points matters, and a failure counts as no success. If success does not
decide, the first headline metric decides. If this metric does not decide either, the <b>tail</b> decides: the worlds
in which a method is far better or far worse. A method <b>loses</b> a world if it is worse there by a difference that
matters.</p>
<p>Each comparison has two verdicts. The verdict <b>on these worlds</b> (these clips, these people) is about the
measured differences. The verdict <b>for others</b> (other clips, other people) counts each clip once, however many
worlds were drawn from the clip. With fewer than six clips, there is no such verdict. It is about the
<b>pseudo-median</b> of the clips' differences: the median of the means of all pairs of clips, which a single unusual
clip hardly changes. The mean must have the same sign. A sign in brackets, such as (=), is a verdict on these worlds
only.</p>
<p>The status <b>ok</b> means that a cell was measured, even if the method missed its goal: success is reported
separately. <b>Unsolved</b> means that the method ended without reaching its goal. Every failure is
counted and has a reason. A missing value is shown as —, never as zero.</p>
)";

std::string HowToRead() {
  return fmt::format("<details class=\"how\"><summary>How to read this</summary>{}<p>{}</p><p>{}</p></details>\n",
                     kHowToRead, kSigns, kComparisonLegend);
}

/// Returns a sentence about the part of a large run that the pictures show; "" if the pictures show the whole run.
std::string LeftOutSentence(const RunData& run) {
  if (!run.source) return "";
  return fmt::format(
      " Numbers and verdicts use all cells. Dots, curves and the reasons for missing values use only {} cells: all "
      "cells of every n-th world.",
      FormatCount(static_cast<long long>(run.rows.size())));
}

std::string Footer(const RunData& run) {
  std::string html = "<footer><details><summary>About this run</summary><dl>";
  const auto entry = [&](std::string_view name, const std::string& value) {
    if (!value.empty()) html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, EscapeMarkup(value));
  };
  entry("Etude", run.program_version);
  entry("Worlds", DescribeWorlds(run));
  entry("Duration", run.wall_seconds > 0 ? FormatNumber(run.wall_seconds) + " s" : "");
  entry("Machine", run.host);
  entry("Command", run.command_line);
  html += "</dl></details><p>";
  if (!run.unsealed.empty()) html += fmt::format("<b>Unsealed</b> {} ", EscapeMarkup(run.unsealed));
  return html +
         "<a href=\"summary.md\">Markdown</a>, <a href=\"junit.xml\">JUnit</a>, <a "
         "href=\"../summary.json\">JSON</a></p></footer>";
}

/// Returns the section that shows captures of real films, and the simulated takes for comparison; "" if there are no
/// captures of real films.
std::string RealTakesSection(const RunData& run, std::span<const RealTake> takes) {
  if (takes.empty()) return "";
  const std::string html =
      "<section class=\"card\"><h2>On real films</h2><p>Distances between captures of real films and a reference "
      "(<code>etude capture --reference</code>), beside the simulated takes of this run. The rows of a real take show "
      "the median and the 95th percentile over joints and frames. <b>Error</b> is the true error only if the reference "
      "is right. <b>Agreement</b> is not an error, because the reference may be made from the same keypoints. The rows "
      "of simulated takes show the mean distance from the true joints, over joints and frames, as a median over "
      "takes.</p>";
  Table table{.label = "Captures of real films",
              .columns = {{"Takes"},
                          {"Recovery"},
                          {"Cameras"},
                          {.head = "Median, mm", .is_number = true},
                          {.head = "95 %, mm", .is_number = true}}};
  table.rows.push_back({.mark = std::string(kTakesBegin)});
  for (const RealTake& take : takes) AddRealRows(take, table);
  table.rows.push_back({.mark = std::string(kTakesEnd)});
  std::size_t rows = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.task == "capture") AddSimulatedRows(scenario, rows, table);
  }
  return html + TableHtml(table) + LeftOutHtml(rows, kMaxTableRows, "rows", "the CSV files in report/tables") +
         "</section>\n";
}

}  // namespace

std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real) {
  std::vector<ScenarioFindings> findings;
  for (const ScenarioSummary& scenario : run.scenarios) findings.push_back(FindingsOf(run, scenario));

  // Write the header, the clips with faults, the answers, and the run's film.
  std::string html = Head(run);
  html += fmt::format(
      "<body>{}<a class=\"skip\" href=\"#{}\">Skip to answers</a><main><header><p class=\"eyebrow\">Etude"
      "</p><h1>The {} suite</h1><p class=\"verdict\">{}</p></header>",
      MarkDefsSvg(), CardAnchor(0), EscapeMarkup(run.suite),
      EscapeMarkup(FindingsOf(run).sentence + LeftOutSentence(run)));
  html += FaultyClipsSection(run);
  html += Answers(run, findings);
  html += fmt::format("{}{}{}", kMediaBegin, FilmElement(media.film, true), kMediaEnd);
  // Write one card per scenario, and the sections about the whole run.
  for (std::size_t i = 0; i < run.scenarios.size(); ++i) html += WriteScenarioCard(run, i, findings[i], media);
  html += RealTakesSection(run, real);
  html += HowToRead();
  html += Footer(run);
  // Add the scripts.
  html += "</main><script>";
  html += ReportJs();
  html += "</script>";
  if (const std::string index = ViewerIndexHtml(run); !index.empty()) {
    html += fmt::format("{}<script type=\"module\">{}</script>", index, ViewerJs());
  }
  html += "</body></html>\n";
  return html;
}

}  // namespace etude
