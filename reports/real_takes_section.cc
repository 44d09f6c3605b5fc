#include "reports/real_takes_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/left_out.h"

namespace etude {
namespace {

constexpr const char* kMetric = "mpjpe_mm";

std::string Row(std::string_view style, const std::array<std::string, 5>& cells) {
  std::string html = fmt::format("<tr{}>", style);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    html += fmt::format("<td{}>{}</td>", i < 3 ? "" : " class=\"n\"", EscapeMarkup(cells[i]));
  }
  return html + "</tr>";
}

std::string Millimetres(std::optional<double> mm) { return mm ? FormatNumber(*mm) : std::string(kNoValue); }

/// What keypoints tell is error only where the reference was not made of the same ones.
std::string MeasureOf(const RealTake& take) { return take.recovery == "keypoints" ? "agreement" : "error"; }

std::string RealRows(const RealTake& take) {
  std::string html;
  for (const RealDistance& distance : take.distances) {
    const std::string cameras = distance.cameras == "all" ? fmt::format("all {}", take.films.size()) : distance.cameras;
    html += Row("", {fmt::format("real: {}, {}", take.name, Plural(take.frames, "frame")),
                     fmt::format("{} ({})", take.recovery, MeasureOf(take)), cameras, Millimetres(distance.median_mm),
                     Millimetres(distance.p95_mm)});
  }
  return html;
}

/// `rows` counts on from scenario to scenario.
std::string SimulatedRows(const ScenarioSummary& scenario, std::size_t& rows) {
  std::string html;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      const auto metric = std::ranges::find(method.metrics, kMetric, &MetricSummary::id);
      if (metric == method.metrics.end() || !metric->median) continue;
      if (++rows > kMostTableRows) continue;
      const std::string label = ConditionLabel(condition.condition);
      html +=
          Row(" class=\"quiet\"", {fmt::format("simulated: {}{}{}", scenario.name, label.empty() ? "" : ", ", label),
                                   MethodLabel(scenario, method.method) + " (error)", std::string(kNoValue),
                                   Millimetres(metric->median), std::string(kNoValue)});
    }
  }
  return html;
}

}  // namespace

std::string RealTakesSection(const RunData& run, std::span<const RealTake> takes) {
  if (takes.empty()) return "";
  std::string html =
      "<section class=\"card\"><h2>On real films</h2><p>How far captures of real films are from a reference "
      "(<code>etude capture --reference</code>), beside the simulated takes of this run. Of a real take: median and "
      "95th "
      "percentile over joints and frames. <b>Error</b> is error as far as the reference itself is right; what comes of "
      "keypoints is <b>agreement</b> where the reference was made of the same ones. Of simulated takes: the median "
      "over takes of the mean over joints and frames, from the true joints.</p><div class=\"scroll\" tabindex=\"0\" "
      "role=\"region\" aria-label=\"On real films\"><table><thead><tr><th scope=\"col\">Takes</th><th scope=\"col\">"
      "Recovery</th><th scope=\"col\">Cameras</th><th scope=\"col\" class=\"n\">Median, mm</th><th scope=\"col\" "
      "class=\"n\">95 %, mm</th></tr></thead><tbody>";
  for (const RealTake& take : takes) html += RealRows(take);
  std::size_t rows = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    if (scenario.task == "capture") html += SimulatedRows(scenario, rows);
  }
  return html + "</tbody></table></div>" + LeftOutHtml(rows, kMostTableRows, "rows", "the CSV files in report/tables") +
         "</section>\n";
}

}  // namespace etude
