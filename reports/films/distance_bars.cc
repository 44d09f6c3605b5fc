#include "reports/films/distance_bars.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/films/look.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr double kHeadingSize = 15, kLabelSize = 13, kValueSize = 12;
constexpr double kHeadingHeight = 26, kRowHeight = 18, kBarHeight = 8;
constexpr double kLabelWidth = 58, kValueWidth = 40, kBarMargin = 12;
constexpr std::size_t kRows = kFeatureCount / 2;
constexpr Paint kTrack{0.30, 0.34, 0.37, 1};
constexpr Paint kBeyond{0.98, 0.52, 0.45, 1};

// What a full bar stands for: the threshold alone, or the largest of them where no threshold is told.
double FullBar(const TransitionFacts& facts, const PerFeature& partials) {
  return facts.threshold ? *facts.threshold * *facts.threshold : std::ranges::max(partials);
}

void DrawBar(Canvas& canvas, const Box& row, std::string_view label, std::optional<double> partial, double full,
             bool has_threshold) {
  const double baseline = row.y + row.height / 2 + 4.5;
  canvas.DrawText({row.x, baseline}, std::string(label), kLabelSize, partial ? kInk : kSoftInk, kLabelWidth);
  const Box track{row.x + kLabelWidth, row.y + (row.height - kBarHeight) / 2, row.width - kLabelWidth - kValueWidth,
                  kBarHeight};
  canvas.FillBox(track, kTrack, kBarHeight / 2);
  if (!partial) return;
  const double share = full > 0 ? std::clamp(*partial / full, 0.0, 1.0) : 0;
  const bool beyond = has_threshold && *partial >= full;
  // Never narrower than its round ends.
  const double width = std::max(track.width * share, kBarHeight);
  if (share > 0.005) canvas.FillBox({track.x, track.y, width, kBarHeight}, beyond ? kBeyond : kWarm, kBarHeight / 2);
  canvas.DrawText({track.x + track.width + 6, baseline}, FormatFixed(*partial, 3), kValueSize, kSoftInk, kValueWidth);
}

}  // namespace

std::string PointWords(const TransitionFacts& facts, std::size_t point) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() || more.empty() ? "" : " · ") + more; };
  if (facts.points.size() > 1) add(fmt::format("{} of {}", point + 1, facts.points.size()));
  if (const auto distance = facts.points[point].distance) {
    std::string d = "d " + FormatFixed(*distance, 3);
    if (facts.threshold) d += fmt::format(" {} {:g}", *distance < *facts.threshold ? "<" : "≥", *facts.threshold);
    add(d);
  }
  add(facts.branch);
  return words;
}

void DrawDistanceBars(Canvas& canvas, const Box& box, const TransitionFacts& facts, std::optional<std::size_t> point) {
  const double inner = box.width - 2 * kBarMargin;
  const bool known = point && *point < facts.points.size();
  const std::optional<PerFeature> partials = known ? facts.points[*point].partials : std::nullopt;
  const std::string heading = !known      ? "no transition yet"
                              : !partials ? PointWords(facts, *point) + " · no distances told"
                                          : PointWords(facts, *point);
  canvas.DrawText({box.x + kBarMargin, box.y + 18}, heading, kHeadingSize, known ? kInk : kSoftInk, inner, known);
  const double full = partials ? FullBar(facts, *partials) : 0;
  constexpr double kGap = 14;
  const double half = (inner - kGap) / 2;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    const double column = static_cast<double>(k / kRows), line = static_cast<double>(k % kRows);
    const Box row{box.x + kBarMargin + column * (half + kGap), box.y + kHeadingHeight + line * kRowHeight, half,
                  kRowHeight};
    DrawBar(canvas, row, FeatureName(AllFeatures()[k]), partials ? std::optional((*partials)[k]) : std::nullopt, full,
            facts.threshold.has_value());
  }
}

}  // namespace etude
