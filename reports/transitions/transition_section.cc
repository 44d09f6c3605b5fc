#include "reports/transitions/transition_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

TableColumn NumberColumn(std::string head) { return {.head = std::move(head), .is_number = true}; }

/// Draws a bar for one feature: the feature's partial distance, divided by `full`, the value of a full bar.
TableCell Bar(double partial, double full, bool has_threshold) {
  const double share = full > 0 ? std::clamp(partial / full, 0.0, 1.0) : 0;
  const bool alone = has_threshold && partial >= full;
  return {"",
          {},
          fmt::format("{}<i class=\"{}\" style=\"width:{:.0f}%\"></i>",
                      partial < kMinShownPartial ? "0" : FormatFixed(partial, 3), alone ? "over" : "", 100 * share)};
}

std::string DistanceWords(double distance, std::optional<double> threshold) {
  if (!threshold) return FormatFixed(distance, 3);
  return fmt::format("{} {} {}", FormatFixed(distance, 3), distance < *threshold ? "<" : "≥",
                     fmt::format("{:g}", *threshold));
}

// The maximum numbers of worlds and methods that the page shows; the recordings contain all.
constexpr std::size_t kMaxWorlds = 6;
constexpr std::size_t kMaxMethods = 12;
constexpr std::size_t kMaxCandidates = 24;

std::string NumberOr(std::optional<double> value, int decimals) {
  return value ? FormatFixed(*value, decimals) : std::string(kNoValue);
}

std::span<const RecordedTransition> Shown(const RecordedRequest& world) {
  return std::span(world.transitions).first(std::min(world.transitions.size(), kMaxMethods));
}

/// Returns the sequence of clips and frames that the coach plays: "clap 41 → in-between 0 … in-between 12 → side kick
/// 3".
std::string WayOf(const TransitionFacts& facts) {
  std::string text;
  for (const PointFacts& point : facts.points) {
    if (!point.from_frame || !point.to_frame) continue;
    text += fmt::format("{}{} {} → {} {}", text.empty() ? "" : " … ", point.from, *point.from_frame, point.to,
                        *point.to_frame);
  }
  return text.empty() ? std::string(kNoValue) : text;
}

/// Returns the largest distance of the transition points. If this distance is below the threshold, the distances of all
/// transition points are below it.
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

std::string WaitOf(const TransitionFacts& facts) {
  return facts.wait_s ? FormatFixed(*facts.wait_s, 2) + " s" : std::string(kNoValue);
}

std::string WaysTable(const RecordedRequest& world) {
  Table table{.label = "The transition by each method",
              .columns = {{"Method"},
                          {"Branch"},
                          {"Frames, left → entered"},
                          NumberColumn("Wait"),
                          NumberColumn("d"),
                          NumberColumn("Pairs matched"),
                          {"Why"}}};
  for (const RecordedTransition& taken : Shown(world)) {
    const TransitionFacts& facts = taken.facts;
    table.rows.push_back({{taken.row->method, Dashed(facts.branch), WayOf(facts), WaitOf(facts),
                           NumberOr(WorstDistance(facts), 3), PairsOf(facts), Dashed(facts.why)}});
  }
  return TableHtml(table);
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

/// Returns the name of a frame's clip and the frame's number, "clap 28"; only the number if the name is unknown.
std::string FrameIn(const std::string& clip, int frame) {
  return clip.empty() ? std::to_string(frame) : fmt::format("{} {}", clip, frame);
}

/// Returns the transition point for which a candidate pair of frames was considered. (A transition through an
/// in-between clip has two points.) If the point is unknown, the result has no clips.
PointFacts PointOf(const CandidateFacts& candidate, const TransitionFacts& facts) {
  const int point = candidate.point.value_or(facts.points.size() == 1 ? 0 : -1);
  const bool is_told = point >= 0 && point < static_cast<int>(facts.points.size());
  return is_told ? facts.points[static_cast<std::size_t>(point)] : PointFacts{};
}

TableRow CandidateRow(const CandidateFacts& candidate, const TransitionFacts& facts, bool has_costs) {
  const bool taken = candidate.outcome == "taken";
  const PointFacts point = PointOf(candidate, facts);
  TableRow row{.cells = {(taken ? "✓ " : "") + Dashed(candidate.outcome), FrameIn(point.from, candidate.from_frame),
                         FrameIn(point.to, candidate.to_frame), FormatFixed(candidate.distance, 3)},
               .attributes = taken ? " class=\"taken\"" : ""};
  if (has_costs) row.cells.emplace_back(candidate.cost ? FormatNumber(*candidate.cost) : std::string(kNoValue));
  row.cells.emplace_back(candidate.partials ? MostlyBy(*candidate.partials) : std::string(kNoValue));
  return row;
}

/// Returns a note that says how many of the candidate pairs of frames are listed; "" if all are.
std::string HowMany(const TransitionFacts& facts) {
  const auto listed = static_cast<long long>(facts.candidates.size());
  if (!facts.pairs_seen || *facts.pairs_seen <= listed) return "";
  return fmt::format(
      "<p class=\"quiet legend\">{} of {} pairs of frames are listed: the chosen pair and the best other pairs.</p>",
      FormatCount(listed), FormatCount(*facts.pairs_seen));
}

std::string CandidatesTable(const std::string& methods, const TransitionFacts& facts) {
  if (facts.candidates.empty()) return "";
  const bool has_costs = std::ranges::any_of(facts.candidates, [](const auto& c) { return c.cost.has_value(); });
  Table table{.label = "Candidates of " + methods,
              .columns = {{"Outcome"}, NumberColumn("Leaves at"), NumberColumn("Enters at"), NumberColumn("d")}};
  if (has_costs) {
    table.columns.push_back(NumberColumn(facts.cost_unit.empty() ? "Cost" : fmt::format("Cost ({})", facts.cost_unit)));
  }
  table.columns.push_back({"largest contributions to d²"});
  const std::size_t shown = std::min(facts.candidates.size(), kMaxCandidates);
  for (std::size_t i = 0; i < shown; ++i) table.rows.push_back(CandidateRow(facts.candidates[i], facts, has_costs));
  return fmt::format("<h4>Candidates that {} considered</h4>{}{}{}", EscapeMarkup(methods), HowMany(facts),
                     TableHtml(table), LeftOutHtml(facts.candidates.size(), shown, "candidates", "the recording"));
}

/// Writes the candidate pairs of frames of all methods. Methods that differ only in how they join the frames have the
/// same candidates and share one table.
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
         "<p class=\"quiet legend\">Too far: the distance d of the pair is not below the threshold. Later: the pair "
         "matches, but the method chose an earlier match. Worse: the pair matches, but another pair ranks higher.</p>";
}

std::string WorldHtml(const RecordedRequest& world) {
  std::string html =
      fmt::format("<details class=\"transitions\"><summary>Why each method chose its frames: {}, {}</summary>",
                  EscapeMarkup(world.Request()), EscapeMarkup(world.Name()));
  html += WaysTable(world) + Distances(world) + AllCandidates(world);
  return html + LeftOutHtml(world.transitions.size(), kMaxMethods, "methods", "the folder recordings") + "</details>";
}

std::string WorldMarkdown(const RecordedRequest& world) {
  Table table{.columns = {{"method"},
                          {"branch"},
                          {"frames, left → entered"},
                          {"wait"},
                          {"d"},
                          {"largest contributions to d²"},
                          {"why"}}};
  for (const RecordedTransition& taken : Shown(world)) {
    const TransitionFacts& facts = taken.facts;
    const auto worst =
        std::ranges::max_element(facts.points, {}, [](const PointFacts& m) { return m.distance.value_or(-1); });
    table.rows.push_back(
        {{taken.row->method, Dashed(facts.branch), WayOf(facts), WaitOf(facts), NumberOr(WorstDistance(facts), 3),
          worst->partials ? MostlyBy(*worst->partials) : std::string(kNoValue), Dashed(facts.why)}});
  }
  return fmt::format("\n{}, {}:\n{}", EscapeMarkdown(world.Request()), EscapeMarkdown(world.Name()),
                     TableMarkdown(table));
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
  Table table{.label = "Partial distances", .style = "partials", .columns = {{"Partial distances S·Δ²"}}};
  for (const Feature feature : AllFeatures()) table.columns.push_back(NumberColumn(std::string(FeatureName(feature))));
  table.columns.insert(table.columns.end(), {NumberColumn("Sum d²"), NumberColumn("d")});
  // Add one row for each set of feature weights.
  for (const auto& [methods, weights] : weights_) {
    TableRow row{.cells = {weights_.size() == 1 ? "weight S" : "weight S of " + methods},
                 .attributes = " class=\"weights\""};
    for (const double weight : weights) row.cells.emplace_back(fmt::format("{:.3g}", weight));
    row.cells.emplace_back(fmt::format("{:.3g}", std::accumulate(weights.begin(), weights.end(), 0.0)));
    row.cells.emplace_back("");
    table.rows.push_back(std::move(row));
  }
  // Add one row for each transition point.
  for (const Point& point : points_) {
    const PerFeature& partials = *point.facts.partials;
    const double sum = std::accumulate(partials.begin(), partials.end(), 0.0);
    const double full = point.threshold ? *point.threshold * *point.threshold : std::ranges::max(partials);
    const std::string clips = point.facts.from.empty() ? "" : fmt::format("{} → {}", point.facts.from, point.facts.to);
    TableRow row{
        .cells = {{"", {}, fmt::format("{}<small>{}</small>", EscapeMarkup(point.method), EscapeMarkup(clips))}}};
    for (const double partial : partials) row.cells.push_back(Bar(partial, full, point.threshold.has_value()));
    row.cells.emplace_back(FormatFixed(sum, 3));
    row.cells.emplace_back(DistanceWords(point.facts.distance.value_or(std::sqrt(sum)), point.threshold));
    table.rows.push_back(std::move(row));
  }
  return TableHtml(table) +
         fmt::format(
             "<p class=\"quiet legend\">The bars of a row sum to d². A full bar means that this feature alone reaches "
             "the threshold; without a threshold, the largest bar of each row is full. {}</p>",
             EscapeMarkup(kFeatureLegend));
}

std::string MostlyBy(const PerFeature& partials) {
  constexpr std::size_t kNamed = 3;
  std::array<std::size_t, kFeatureCount> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) { return partials[k]; });
  std::string text;
  for (const std::size_t k : std::span(order).first(kNamed)) {
    if (partials[k] < kMinShownPartial) break;
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
  std::string text = "\n<details><summary>Why each method chose its frames</summary>\n";
  for (std::size_t i = 0; i < std::min(worlds.size(), kMaxWorlds); ++i) text += WorldMarkdown(worlds[i]);
  const std::string rest = LeftOutWords(worlds.size(), kMaxWorlds, "requests", "the folder recordings");
  return text + (rest.empty() ? "" : "\n" + rest + "\n") + "\n</details>\n";
}

}  // namespace etude
