#include "reports/films/transition_plots.h"

#include <fmt/core.h>

#include <algorithm>

#include "bench/metrics/transition_smoothness.h"
#include "io/drawing/look.h"
#include "reports/films/session_parts.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr Paint kFloor{0.30, 0.34, 0.37, 1};
constexpr Paint kNature{0.55, 0.82, 0.50, 1};
constexpr Paint kFaint{0.95, 0.955, 0.96, 0.18};
constexpr double kTextSize = 15, kJumpRoom = 210;
constexpr double kSide = 12, kStripTop = 24, kStripBottom = 34, kClipHeight = 6;

// Computes the metric jump_cm (the largest jump near a transition point) from the frames up to `frame`.
std::optional<double> JumpAtPoints(const TransitionPath& path, int frame) {
  std::optional<double> largest;
  for (const int point : path.facts.transition_frames) {
    const int last = std::min({point + kWindowReach, frame, static_cast<int>(path.jumps_cm.size()) - 1});
    for (int at = std::max(0, point - kWindowReach); frame > point && at <= last; ++at) {
      largest = std::max(largest.value_or(0), path.jumps_cm[static_cast<std::size_t>(at)]);
    }
  }
  return largest;
}

constexpr double kHeadingSize = 16, kLabelSize = 15, kValueSize = 15;
constexpr double kHeadingHeight = 26, kRowHeight = 18, kBarHeight = 8;
constexpr double kShortLabel = 58, kLongLabel = 96, kRoomForLong = 220, kValueWidth = 46, kBarMargin = 12;
constexpr std::size_t kRows = kFeatureCount / 2;
constexpr Paint kTrack{0.30, 0.34, 0.37, 1};
constexpr Paint kBeyond{0.98, 0.52, 0.45, 1};

// Returns the partial distance that fills a bar: the squared threshold, or the largest partial distance if there is no
// threshold.
double FullBar(const TransitionFacts& facts, const PerFeature& partials) {
  return facts.threshold ? *facts.threshold * *facts.threshold : std::ranges::max(partials);
}

// Draws the bar of one feature. A narrow bar is labelled with the feature's abbreviation from paper A.
void DrawBar(Canvas& canvas, const Box& row, Feature feature, std::optional<double> partial, double full,
             bool has_threshold) {
  const bool is_wide = row.width >= kRoomForLong;
  const double label_width = is_wide ? kLongLabel : kShortLabel;
  const double baseline = row.y + row.height / 2 + 4.5;
  canvas.DrawText({row.x, baseline}, std::string(is_wide ? PlainNameOf(feature) : FeatureName(feature)), kLabelSize,
                  partial ? kInk : kSoftInk, label_width);
  const Box track{row.x + label_width, row.y + (row.height - kBarHeight) / 2, row.width - label_width - kValueWidth,
                  kBarHeight};
  canvas.FillBox(track, kTrack, kBarHeight / 2);
  if (!partial) return;
  const double share = full > 0 ? std::clamp(*partial / full, 0.0, 1.0) : 0;
  const bool beyond = has_threshold && *partial >= full;
  // Bars have rounded ends, so a bar is at least as wide as its two ends.
  const double width = std::max(track.width * share, kBarHeight);
  if (share > 0.005) canvas.FillBox({track.x, track.y, width, kBarHeight}, beyond ? kBeyond : kWarm, kBarHeight / 2);
  canvas.DrawText({track.x + track.width + 6, baseline}, FormatFixed(*partial, 3), kValueSize, kSoftInk, kValueWidth);
}

}  // namespace

/// The plot area inside the axes, which maps times and jumps to pixels.
struct JumpStrip::Frame {
  Box box;
  const JumpStrip& strip;

  double X(double time) const {
    const double share = (time - strip.first_) / std::max(1, strip.last_ - strip.first_);
    return box.x + box.width * std::clamp(share, 0.0, 1.0);
  }
  double Y(double cm) const { return box.y + box.height * (1 - std::clamp(cm / strip.highest_cm_, 0.0, 1.0)); }
  double Bottom() const { return box.y + box.height; }
};

const Paint& PaintOfSegment(const TransitionFacts& facts, std::size_t points_before) {
  if (points_before == 0) return kAccent;
  return points_before < facts.transition_frames.size() ? kSoftInk : kWarm;
}

void JumpStrip::Draw(Canvas& canvas, const Box& box, const TransitionPath& path, int time) const {
  const Frame frame{{box.x + kSide, box.y + kStripTop, box.width - 2 * kSide, box.height - kStripTop - kStripBottom},
                    *this};
  const int shown = path.FrameAt(time);
  std::string jump = fmt::format("jump {} cm", FormatFixed(path.jumps_cm[static_cast<std::size_t>(shown)], 1));
  if (const auto largest = JumpAtPoints(path, shown)) jump += fmt::format(", worst {}", FormatFixed(*largest, 1));
  canvas.DrawText({frame.box.x, box.y + 16}, path.IsRecordedAt(time) ? jump : "jump —", kTextSize, kInk, kJumpRoom);
  if (path.facts.natural_limit_cm) {
    const double y = frame.Y(*path.facts.natural_limit_cm);
    canvas.DrawLine({frame.box.x, y}, {frame.box.x + frame.box.width, y}, 1.2, kNature);
    const std::string words = fmt::format("natural: up to {} cm", FormatFixed(*path.facts.natural_limit_cm, 1));
    const double width = canvas.TextWidth(words, kTextSize);
    const double left = std::max(frame.box.x + frame.box.width - width, frame.box.x + kJumpRoom + 6);
    canvas.DrawText({left, box.y + 16}, words, kTextSize, kNature, frame.box.x + frame.box.width - left + 1);
  }
  DrawCurve(canvas, frame, path, last_, kFaint);
  DrawCurve(canvas, frame, path, time, kInk);
  DrawClips(canvas, frame, path);
  const double x = frame.X(time), y = frame.Bottom() + 8 + kClipHeight / 2;
  canvas.DrawLine({x, frame.box.y}, {x, y}, 1, {0.95, 0.955, 0.96, 0.5});
  canvas.DrawDot({x, y}, 6, PaintOfSegment(path.facts, path.PointsBefore(time)));
}

void JumpStrip::DrawCurve(Canvas& canvas, const Frame& frame, const TransitionPath& path, int until,
                          const Paint& paint) const {
  std::vector<glm::dvec2> points;
  for (int time = first_; time <= std::min(until, last_); ++time) {
    const int at = path.request + time;
    if (at < 0 || at >= static_cast<int>(path.jumps_cm.size())) continue;
    points.emplace_back(frame.X(time), frame.Y(path.jumps_cm[static_cast<std::size_t>(at)]));
  }
  if (points.size() > 1) canvas.DrawPath(points, 1.8, paint);
}

void JumpStrip::DrawClips(Canvas& canvas, const Frame& frame, const TransitionPath& path) const {
  const double y = frame.Bottom() + 8;
  canvas.DrawLine({frame.box.x, frame.Bottom()}, {frame.box.x + frame.box.width, frame.Bottom()}, 1, kFloor);
  double from = frame.box.x;
  const std::size_t points = path.facts.transition_frames.size();
  for (std::size_t segment = 0; segment <= points; ++segment) {
    const double to = segment < points ? frame.X(path.TimeOf(path.facts.transition_frames[segment]) + 0.5)
                                       : frame.box.x + frame.box.width;
    if (to > from) canvas.FillBox({from, y, to - from, kClipHeight}, PaintOfSegment(path.facts, segment));
    from = to;
  }
  const double request = frame.X(0), baseline = y + kClipHeight + 15;
  canvas.DrawLine({request, y - 5}, {request, y + kClipHeight + 3}, 2, kInk);
  const std::string words = "request";
  canvas.DrawText({request - canvas.TextWidth(words, kTextSize) / 2, baseline}, words, kTextSize, kSoftInk, 80);
  for (int second = 1; second * path.motion.rate_hz <= last_; ++second) {
    const double x = frame.X(second * path.motion.rate_hz);
    const std::string label = fmt::format("{} s", second);
    const double width = canvas.TextWidth(label, kTextSize);
    if (x + width / 2 > frame.box.x + frame.box.width) break;
    canvas.DrawLine({x, y + kClipHeight}, {x, y + kClipHeight + 3}, 1, kSoftInk);
    if (x - width / 2 > request + 40) canvas.DrawText({x - width / 2, baseline}, label, kTextSize, kSoftInk, width + 1);
  }
}

std::string PointWords(const TransitionFacts& facts, std::size_t point) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() || more.empty() ? "" : " · ") + more; };
  if (facts.points.size() > 1) add(fmt::format("{} of {}", point + 1, facts.points.size()));
  if (const auto distance = facts.points[point].distance) {
    std::string d = "distance " + FormatFixed(*distance, 3);
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
                              : !partials ? PointWords(facts, *point) + " · distances were not recorded"
                                          : PointWords(facts, *point);
  canvas.DrawText({box.x + kBarMargin, box.y + 18}, heading, kHeadingSize, known ? kInk : kSoftInk, inner, known);
  const double full = partials ? FullBar(facts, *partials) : 0;
  constexpr double kGap = 14;
  const double half = (inner - kGap) / 2;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    const double column = static_cast<double>(k / kRows), line = static_cast<double>(k % kRows);
    const Box row{box.x + kBarMargin + column * (half + kGap), box.y + kHeadingHeight + line * kRowHeight, half,
                  kRowHeight};
    DrawBar(canvas, row, AllFeatures()[k], partials ? std::optional((*partials)[k]) : std::nullopt, full,
            facts.threshold.has_value());
  }
}

std::string CountdownWords(const std::string& wanted, int time, int last_point, double rate_hz) {
  if (time < 0) return "";
  if (time <= last_point) return fmt::format("{} in {} s", wanted, FormatFixed((last_point - time) / rate_hz, 2));
  return fmt::format("waited {} s", FormatFixed(last_point / rate_hz, 2));
}

}  // namespace etude
