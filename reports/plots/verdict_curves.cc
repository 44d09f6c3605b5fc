#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>

#include "bench/statistics/curves/curves.h"
#include "bench/statistics/distributions.h"
#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "reports/plots/verdicts.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr double kRocHeight = 240, kRocTop = 8, kRocBottom = 208;
constexpr std::size_t kMaxConditions = 4;
constexpr std::size_t kMaxRocs = 16;

using SharePoints = std::vector<std::pair<double, double>>;

const Axis kSharesAcross{.low = 0, .high = 1, .from = kPanelLeft, .to = kPanelRight};
const Axis kSharesUp{.low = 0, .high = 1, .from = kRocBottom, .to = kRocTop};

std::string LineThrough(std::size_t method, const SharePoints& points) {
  std::string path;
  for (const auto& [x, y] : points) path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x, y);
  return MethodLine(method, path);
}

std::string Figure(const std::string& caption, const std::string& words, const std::string& drawn) {
  return fmt::format("<figure><figcaption>{}</figcaption>{}{}</svg></figure>", EscapeMarkup(caption),
                     BeginPanel(kRocHeight, words), drawn);
}

/// Draws one share against another as one curve per method, for example an ROC curve. If a method has an operating
/// point, a mark shows it on the curve.
std::string SharePanel(const std::string& caption, const std::string& words,
                       const std::map<std::size_t, SharePoints>& curves,
                       const std::map<std::size_t, std::pair<double, double>>& marked = {}) {
  std::string drawn = VerticalAxisGrid(kSharesUp) + HorizontalAxisGrid(kSharesAcross, kRocTop, kRocBottom);
  for (const auto& [method, curve] : curves) {
    SharePoints placed;
    for (const auto& [x, y] : curve) placed.emplace_back(kSharesAcross.At(x), kSharesUp.At(y));
    drawn += LineThrough(method, placed);
  }
  for (const auto& [method, at] : marked) {
    drawn += MarkUse(method, method, kSharesAcross.At(at.first), kSharesUp.At(at.second));
  }
  return Figure(caption, words, drawn);
}

/// An axis that shows shares from 1 to 99 % on the scale of normal deviates. If the scores of right and of wrong
/// performances are normally distributed, a DET curve is a straight line (Martin et al. 1997).
struct DeviateAxis {
  static constexpr double kLow = 0.01, kHigh = 0.99;
  double from = 0, to = 1;

  double At(double share) const {
    const double low = NormalQuantile(kLow), high = NormalQuantile(kHigh);
    return from + (NormalQuantile(std::clamp(share, kLow, kHigh)) - low) / (high - low) * (to - from);
  }
};

std::string DetPanel(const std::string& caption, const std::string& words,
                     const std::map<std::size_t, SharePoints>& curves,
                     const std::map<std::size_t, std::pair<double, double>>& marked) {
  const DeviateAxis across{kPanelLeft, kPanelRight}, up{kRocBottom, kRocTop};
  std::string drawn;
  for (const double share : {0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99}) {
    const std::string text = fmt::format("{:.0f} %", 100 * share);
    drawn += fmt::format("<path d=\"M{} {:.1f}H{}M{:.1f} {}V{}\"/>", kPanelLeft, up.At(share), kPanelRight,
                         across.At(share), kRocTop, kRocBottom) +
             PanelText(kPanelLeft - 5, up.At(share) + 4, text, "end") +
             PanelText(across.At(share), kRocBottom + 13, text, "middle");
  }
  for (const auto& [method, curve] : curves) {
    SharePoints placed;
    for (const auto& [wrong, right] : curve) placed.emplace_back(across.At(wrong), up.At(1 - right));
    drawn += LineThrough(method, placed);
  }
  for (const auto& [method, at] : marked) {
    drawn += MarkUse(method, method, across.At(at.first), up.At(1 - at.second));
  }
  return Figure(caption, words, drawn);
}

/// Draws, as one step curve per method, how a share grows over seconds.
std::string WaitPanel(const std::string& caption, const std::string& words,
                      const std::map<std::size_t, SharePoints>& curves) {
  Axis time{.low = 0, .high = 0, .from = kPanelLeft, .to = kPanelRight};
  for (const auto& [method, curve] : curves) {
    time.low = std::min(time.low, curve.front().first);
    time.high = std::max(time.high, curve.back().first);
  }
  if (!(time.high > time.low)) return "";
  std::string drawn = VerticalAxisGrid(kSharesUp) + HorizontalAxisGrid(time, kRocTop, kRocBottom);
  for (const auto& [method, curve] : curves) {
    SharePoints steps{{time.from, kSharesUp.At(1)}};
    for (const auto& [at, left] : curve) {
      steps.emplace_back(time.At(at), steps.back().second);
      steps.emplace_back(time.At(at), kSharesUp.At(left));
    }
    steps.emplace_back(time.to, steps.back().second);
    drawn += LineThrough(method, steps);
  }
  return Figure(caption, words, drawn);
}

std::string ConditionPrefix(const ConditionSummary& condition) {
  const std::string label = ConditionLabel(condition.condition);
  return label.empty() ? "" : label + ": ";
}

std::string VerdictKey(const ScenarioSummary& scenario, std::size_t method, const std::string& told) {
  return fmt::format("<span>{}{} {} {}</span> ", LineKeySvg(method), MarkKeySvg(method, method),
                     EscapeMarkup(MethodLabel(scenario, scenario.methods[method])), told);
}

/// The data of the curves of one condition, by method.
struct Curves {
  std::map<std::size_t, SharePoints> rocs, found, waiting;
  std::map<std::size_t, std::pair<double, double>> operated;
  std::string words, found_words, wait_words, keys;
};

/// All performances that are truly right or wrong (not grey), pooled over trials, with the performer of each
/// performance.
struct PooledEvents {
  std::vector<JudgedEvent> events;
  std::vector<int> people;
};

PooledEvents PoolEvents(std::span<const JudgedPerformance> performances) {
  PooledEvents pooled;
  for (const JudgedPerformance& performance : performances) {
    if (performance.truth == 0.5) continue;
    pooled.events.push_back({performance.truth > 0.5, performance.is_called, performance.score});
    pooled.people.push_back(performance.person);
  }
  return pooled;
}

void AddMethod(const ScenarioSummary& scenario, std::size_t method, const MethodVerdicts& verdicts, Curves& curves) {
  const auto [events, people] = PoolEvents(verdicts.performances);
  const std::string& name = scenario.methods[method];
  std::string told;
  if (const auto area = JackknifedAuc(events, people)) {
    curves.rocs[method] = RocCurve(events);
    told += fmt::format("{:.3f} [{:.3f}, {:.3f}]", area->value, area->low, area->high);
    curves.words += fmt::format("{}: area {:.3f}. ", name, area->value);
  }
  if (const auto at = OperatedAt(events)) {
    curves.operated[method] = *at;
    told += fmt::format(
        "; judges {:.0f} % of the right performances and {:.0f} % of the wrong performances as right; best F1 over all "
        "thresholds {:.2f}",
        100 * at->second, 100 * at->first, *BestF1(events));
  }
  if (const SharePoints by_severity = FoundBySeverity(verdicts.performances); by_severity.size() > 1) {
    curves.found[method] = by_severity;
    if (const auto half = HalfFoundAt(by_severity))
      told += fmt::format("; finds half of the faults with a severity of {:.2f} or more", *half);
    curves.found_words += fmt::format("{}: {:.0f} % of the worst faults. ", name, 100 * by_severity.back().second);
  }
  if (SharePoints waiting = SurvivalCurve(verdicts.waits); waiting.size() > 1) {
    curves.wait_words += fmt::format("{}: {:.0f} % are never judged right. ", name, 100 * waiting.back().second);
    curves.waiting[method] = std::move(waiting);
  }
  if (!told.empty()) curves.keys += VerdictKey(scenario, method, told);
}

std::string VerdictPanels(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition) {
  // Collect the curves of every method.
  Curves curves;
  for (const auto& [method, verdicts] : VerdictsUnder(run, scenario, condition)) {
    if (method < kMaxRocs) AddMethod(scenario, method, verdicts, curves);
  }
  const std::string prefix = ConditionPrefix(condition);
  // Draw one panel for each kind of curve.
  std::string html;
  if (!curves.rocs.empty()) {
    html += SharePanel(prefix +
                           "share of right performances that are judged right, against the share of wrong performances "
                           "that are judged right, for all thresholds and all people together; the mark shows the "
                           "threshold that the method uses",
                       curves.words, curves.rocs, curves.operated);
    html += DetPanel(prefix +
                         "the same errors on scales of normal deviates (DET curve): right performances that are judged "
                         "wrong, against wrong performances that are judged right",
                     curves.words, curves.rocs, curves.operated);
  }
  if (!curves.found.empty()) {
    html += SharePanel(prefix + "share of faulty performances that are judged wrong, by the severity of the fault",
                       curves.found_words, curves.found);
  }
  if (!curves.waiting.empty()) {
    html += WaitPanel(
        prefix +
            "share of right performances that are not yet judged right, by the time in s since the performance was "
            "truly right; a performance that is never judged right is censored when its time window ends",
        curves.wait_words, curves.waiting);
  }
  if (html.empty()) return "";
  return fmt::format(
      "<div class=\"panels\">{}</div><p class=\"quiet legend units\">Area under the curve with 95 % "
      "interval over people: {}</p>",
      html, curves.keys);
}

}  // namespace

std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances) {
  constexpr std::size_t kFifths = 5;
  std::array<int, kFifths> all{}, found{};
  for (const JudgedPerformance& performance : performances) {
    if (!(performance.severity > 0)) continue;
    const auto fifth = std::min(kFifths - 1, static_cast<std::size_t>(performance.severity * kFifths));
    ++all[fifth];
    found[fifth] += !performance.is_called;
  }
  SharePoints curve;
  for (std::size_t i = 0; i < kFifths; ++i) {
    if (all[i] > 0)
      curve.emplace_back((static_cast<double>(i) + 0.5) / kFifths, found[i] / static_cast<double>(all[i]));
  }
  return curve;
}

std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const auto [x0, y0] = curve[i - 1];
    const auto [x1, y1] = curve[i];
    if (y0 < 0.5 && y1 >= 0.5) return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0);
  }
  return std::nullopt;
}

std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    if (count == kMaxConditions) break;
    const std::string panels = VerdictPanels(run, scenario, condition);
    html += panels;
    count += !panels.empty();
  }
  return html.empty() ? "" : "<div class=\"verdicts\">" + html + "</div>";
}

}  // namespace etude
