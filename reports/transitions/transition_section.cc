#include "reports/transitions/transition_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "io/drawing/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

/// Draws a bar for the share of the squared threshold that this feature alone takes up.
std::string Bar(double partial, double full, bool has_threshold) {
  const double share = full > 0 ? std::clamp(partial / full, 0.0, 1.0) : 0;
  const bool alone = has_threshold && partial >= full;
  return fmt::format("<td class=\"n\">{}<i class=\"{}\" style=\"width:{:.0f}%\"></i></td>",
                     partial < kLeastShown ? "0" : FormatFixed(partial, 3), alone ? "over" : "", 100 * share);
}

std::string DistanceWords(double distance, std::optional<double> threshold) {
  if (!threshold) return FormatFixed(distance, 3);
  return fmt::format("{} {} {}", FormatFixed(distance, 3), distance < *threshold ? "&lt;" : "≥",
                     fmt::format("{:g}", *threshold));
}

// Limits for readability; the recordings hold everything.
constexpr std::size_t kMaxWorlds = 6;
constexpr std::size_t kMostMethods = 12;
constexpr std::size_t kMostCandidates = 24;

std::string NumberOr(std::optional<double> value, int decimals) {
  return value ? FormatFixed(*value, decimals) : std::string(kNoValue);
}

std::span<const RecordedTransition> Shown(const RecordedRequest& world) {
  return std::span(world.transitions).first(std::min(world.transitions.size(), kMostMethods));
}

/// Returns the path through the clips: "clap 41 → in-between 0 … in-between 12 → side kick 3".
std::string WayOf(const TransitionFacts& facts) {
  std::string text;
  for (const PointFacts& point : facts.points) {
    if (!point.from_frame || !point.to_frame) continue;
    text += fmt::format("{}{} {} → {} {}", text.empty() ? "" : " … ", point.from, *point.from_frame, point.to,
                        *point.to_frame);
  }
  return text.empty() ? std::string(kNoValue) : text;
}

/// Returns the largest distance of all transition points, which is compared with the threshold.
std::optional<double> WorstDistance(const TransitionFacts& facts) {
  std::optional<double> worst;
  for (const PointFacts& point : facts.points) {
    if (point.distance && (!worst || *point.distance > *worst)) worst = point.distance;
  }
  return worst;
}

std::string PairsOf(const TransitionFacts& facts) {
  if (!facts.pairs_seen || *facts.pairs_seen == 0) return std::string(kNoValue);
  if (!facts.pairs_matched) return FormatCount(*facts.pairs_seen);
  return fmt::format("{} of {}", FormatCount(*facts.pairs_matched), FormatCount(*facts.pairs_seen));
}

std::string Dashed(const std::string& text) { return text.empty() ? std::string(kNoValue) : text; }

std::string WaysTable(const RecordedRequest& world) {
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Which way each method "
      "took\"><table><thead><tr>"
      "<th scope=\"col\">Method</th><th scope=\"col\">Branch</th><th scope=\"col\">Frames, left → entered</th>"
      "<th scope=\"col\" class=\"n\">Wait</th><th scope=\"col\" class=\"n\">d</th>"
      "<th scope=\"col\" class=\"n\">Pairs matched</th><th scope=\"col\">Why</th></tr></thead><tbody>";
  for (const RecordedTransition& taken : Shown(world)) {
    const TransitionFacts& facts = taken.facts;
    html += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td>{}</td></tr>",
        EscapeMarkup(taken.row->method), EscapeMarkup(Dashed(facts.branch)), EscapeMarkup(WayOf(facts)),
        facts.wait_s ? FormatFixed(*facts.wait_s, 2) + " s" : std::string(kNoValue), NumberOr(WorstDistance(facts), 3),
        PairsOf(facts), EscapeMarkup(Dashed(facts.why)));
  }
  return html + "</tbody></table></div>";
}

std::string Distances(const RecordedRequest& world) {
  DistanceTable table;
  for (const RecordedTransition& taken : Shown(world)) {
    const TransitionFacts& facts = taken.facts;
    if (facts.weights) table.AddWeights(taken.row->method, *facts.weights);
    for (const PointFacts& point : facts.points) {
      if (point.partials) table.AddPoint(taken.row->method, point, facts.threshold);
    }
  }
  return table.Html();
}

/// Returns a frame with its clip, "clap 28", or the frame alone.
std::string FrameIn(const std::string& clip, int frame) {
  return clip.empty() ? std::to_string(frame) : fmt::format("{} {}", EscapeMarkup(clip), frame);
}

/// Returns the transition point for which a candidate was considered; with an in-between there are two. Its clips are
/// empty if the point is unknown.
PointFacts PointOf(const CandidateFacts& candidate, const TransitionFacts& facts) {
  const int point = candidate.point.value_or(facts.points.size() == 1 ? 0 : -1);
  const bool is_told = point >= 0 && point < static_cast<int>(facts.points.size());
  return is_told ? facts.points[static_cast<std::size_t>(point)] : PointFacts{};
}

std::string CandidateRow(const CandidateFacts& candidate, const TransitionFacts& facts, bool has_costs) {
  const bool taken = candidate.outcome == "taken";
  const PointFacts point = PointOf(candidate, facts);
  std::string html =
      fmt::format("<tr{}><td>{}{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>",
                  taken ? " class=\"taken\"" : "", taken ? "✓ " : "", EscapeMarkup(Dashed(candidate.outcome)),
                  FrameIn(point.from, candidate.from_frame), FrameIn(point.to, candidate.to_frame),
                  FormatFixed(candidate.distance, 3));
  if (has_costs)
    html += fmt::format("<td class=\"n\">{}</td>", candidate.cost ? FormatNumber(*candidate.cost) : kNoValue);
  return html +
         fmt::format("<td>{}</td></tr>", candidate.partials ? MostlyBy(*candidate.partials) : std::string(kNoValue));
}

/// Returns a note on how many of all pairs of frames are listed; "" if all are.
std::string HowMany(const TransitionFacts& facts) {
  const auto listed = static_cast<long long>(facts.candidates.size());
  if (!facts.pairs_seen || *facts.pairs_seen <= listed) return "";
  return fmt::format("<p class=\"quiet legend\">{} of {} pairs of frames: the taken, and the best of the others.</p>",
                     FormatCount(listed), FormatCount(*facts.pairs_seen));
}

std::string CandidatesTable(const std::string& methods, const TransitionFacts& facts) {
  if (facts.candidates.empty()) return "";
  const bool has_costs = std::ranges::any_of(facts.candidates, [](const auto& c) { return c.cost.has_value(); });
  std::string html = fmt::format(
      "<h4>What {} looked at</h4>{}<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Candidates of "
      "{}\">"
      "<table><thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\" class=\"n\">Leaves at</th>"
      "<th scope=\"col\" class=\"n\">Enters at</th><th scope=\"col\" class=\"n\">d</th>",
      EscapeMarkup(methods), HowMany(facts), EscapeMarkup(methods));
  if (has_costs) {
    const std::string unit = facts.cost_unit.empty() ? "" : fmt::format(" ({})", facts.cost_unit);
    html += fmt::format("<th scope=\"col\" class=\"n\">Cost{}</th>", EscapeMarkup(unit));
  }
  html += "<th scope=\"col\">d² is mostly</th></tr></thead><tbody>";
  const std::size_t shown = std::min(facts.candidates.size(), kMostCandidates);
  for (std::size_t i = 0; i < shown; ++i) html += CandidateRow(facts.candidates[i], facts, has_costs);
  return html + "</tbody></table></div>" + LeftOutHtml(facts.candidates.size(), shown, "candidates", "the recording");
}

/// Writes the candidates of all methods; methods that differ only in the join share one table.
std::string AllCandidates(const RecordedRequest& world) {
  std::string html;
  std::vector<bool> told(world.transitions.size());
  for (std::size_t i = 0; i < Shown(world).size(); ++i) {
    if (told[i]) continue;
    std::string methods = world.transitions[i].row->method;
    for (std::size_t j = i + 1; j < Shown(world).size(); ++j) {
      if (world.transitions[j].facts.candidates != world.transitions[i].facts.candidates) continue;
      methods += ", " + world.transitions[j].row->method;
      told[j] = true;
    }
    html += CandidatesTable(methods, world.transitions[i].facts);
  }
  if (html.empty()) return html;
  return html +
         "<p class=\"quiet legend\">Too far: d is not below the threshold. Later: it matches, but the first match is "
         "taken. Worse: it matches, but another ranks before it.</p>";
}

std::string WorldHtml(const RecordedRequest& world) {
  std::string html =
      fmt::format("<details class=\"transitions\"><summary>Why each transition went where it went: {}, {}</summary>",
                  EscapeMarkup(world.Request()), EscapeMarkup(world.Name()));
  html += WaysTable(world) + Distances(world) + AllCandidates(world);
  return html + LeftOutHtml(world.transitions.size(), kMostMethods, "methods", "the folder recordings") + "</details>";
}

std::string WorldMarkdown(const RecordedRequest& world) {
  std::string text = fmt::format(
      "\n{}, {}:\n\n| method | branch | frames, left → entered | wait | d | d² is mostly | why |\n"
      "|---|---|---|---|---|---|---|\n",
      EscapeMarkdown(world.Request()), EscapeMarkdown(world.Name()));
  for (const RecordedTransition& taken : Shown(world)) {
    const TransitionFacts& facts = taken.facts;
    const auto worst =
        std::ranges::max_element(facts.points, {}, [](const PointFacts& m) { return m.distance.value_or(-1); });
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} |\n", EscapeMarkdown(taken.row->method),
        EscapeMarkdown(Dashed(facts.branch)), EscapeMarkdown(WayOf(facts)),
        facts.wait_s ? FormatFixed(*facts.wait_s, 2) + " s" : std::string(kNoValue), NumberOr(WorstDistance(facts), 3),
        worst->partials ? MostlyBy(*worst->partials) : std::string(kNoValue), EscapeMarkdown(Dashed(facts.why)));
  }
  return text;
}

}  // namespace

void DistanceTable::AddWeights(const std::string& method, const FeatureWeights& weights) {
  const auto known = std::ranges::find(weights_, weights, &std::pair<std::string, FeatureWeights>::second);
  if (known == weights_.end()) {
    weights_.emplace_back(method, weights);
  } else {
    known->first += ", " + method;
  }
}

void DistanceTable::AddPoint(const std::string& method, const PointFacts& point, std::optional<double> threshold) {
  points_.push_back({method, point, threshold});
}

std::string DistanceTable::Html() const {
  if (points_.empty()) return "";
  // One column for each feature.
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Partial distances\"><table class=\"partials\">"
      "<thead><tr><th scope=\"col\">Partial distances S·Δ²</th>";
  for (const Feature feature : AllFeatures()) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", FeatureName(feature));
  }
  html += "<th scope=\"col\" class=\"n\">Sum d²</th><th scope=\"col\" class=\"n\">d</th></tr></thead><tbody>";
  // The weights, once for all methods that share them.
  for (const auto& [methods, weights] : weights_) {
    const bool shared_by_all = weights_.size() == 1;
    html +=
        fmt::format("<tr class=\"weights\"><td>weight S{}</td>", shared_by_all ? "" : EscapeMarkup(" of " + methods));
    for (const double weight : weights) html += fmt::format("<td class=\"n\">{:.3g}</td>", weight);
    html += fmt::format("<td class=\"n\">{}</td><td></td></tr>",
                        fmt::format("{:.3g}", std::accumulate(weights.begin(), weights.end(), 0.0)));
  }
  // One row for each transition point.
  for (const Point& point : points_) {
    const PerFeature& partials = *point.facts.partials;
    const double sum = std::accumulate(partials.begin(), partials.end(), 0.0);
    const double full = point.threshold ? *point.threshold * *point.threshold : std::ranges::max(partials);
    const std::string clips = point.facts.from.empty() ? "" : fmt::format("{} → {}", point.facts.from, point.facts.to);
    html += fmt::format("<tr><td>{}<small>{}</small></td>", EscapeMarkup(point.method), EscapeMarkup(clips));
    for (const double partial : partials) html += Bar(partial, full, point.threshold.has_value());
    html += fmt::format("<td class=\"n\">{}</td><td class=\"n\">{}</td></tr>", FormatFixed(sum, 3),
                        DistanceWords(point.facts.distance.value_or(std::sqrt(sum)), point.threshold));
  }
  return html + fmt::format(
                    "</tbody></table></div><p class=\"quiet legend\">They sum to d². A full bar alone reaches the "
                    "threshold; without one, it is the largest of its row. {}</p>",
                    EscapeMarkup(std::string(kFeatureLegend)));
}

std::string MostlyBy(const PerFeature& partials) {
  constexpr std::size_t kNamed = 3;
  std::array<std::size_t, kFeatureCount> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) { return partials[k]; });
  std::string text;
  for (const std::size_t k : std::span(order).first(kNamed)) {
    if (partials[k] < kLeastShown) break;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", FeatureName(AllFeatures()[k]), FormatFixed(partials[k], 3));
  }
  return text.empty() ? "all alike" : text;
}

std::string TransitionsHtml(const std::vector<RecordedRequest>& worlds) {
  std::string html;
  for (std::size_t i = 0; i < std::min(worlds.size(), kMaxWorlds); ++i) html += WorldHtml(worlds[i]);
  return html + LeftOutHtml(worlds.size(), kMaxWorlds, "requests", "the folder recordings");
}

std::string TransitionsMarkdown(const std::vector<RecordedRequest>& worlds) {
  if (worlds.empty()) return "";
  std::string text = "\n<details><summary>Why each transition went where it went</summary>\n";
  for (std::size_t i = 0; i < std::min(worlds.size(), kMaxWorlds); ++i) text += WorldMarkdown(worlds[i]);
  const std::string rest = LeftOutWords(worlds.size(), kMaxWorlds, "requests", "the folder recordings");
  return text + (rest.empty() ? "" : "\n" + rest + "\n") + "\n</details>\n";
}

}  // namespace etude
