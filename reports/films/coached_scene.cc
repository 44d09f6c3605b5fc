#include "reports/films/coached_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>

#include "reports/films/forest.h"
#include "reports/films/look.h"
#include "reports/films/stick_figure.h"
#include "reports/words/figures.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

constexpr Box kStage{12, 52, 1256, 520};
constexpr Box kSaid{12, 52, 1064, 520};  // of the stage, what words may cover
constexpr Box kInset{1086, 372, 170, 188};
constexpr Box kHint{1046, 64, 210, 232};

// Who stands where, and what is seen of them.
constexpr FloorMove kCoachAt{.yaw = 0, .x = -1.05, .z = -0.3}, kLearnerAt{.yaw = 0, .x = 0.95, .z = -0.3};
constexpr double kSessionEyeHeight = 1.35, kSessionDistance = 5.2, kSessionLookAt = 1.0, kSessionSeen = 2.5;

constexpr int kBeforeCorrection = 3 * kFilmRate;

/// What the timeline shows at most; of a longer film what is around the present.
constexpr int kTimelineFrames = 24 * kFilmRate;

const Room kMeadow{.casts_shadows = false};

Paint PaintOfMode(const std::string& mode) {
  if (mode == "dance") return kAccent;
  if (mode == "correct") return kWarm;
  if (mode == "demonstrate") return {0.72, 0.58, 0.90, 1};
  if (mode == "praise") return kRightPaint;
  return kUndecidedPaint;
}

/// What is in force at a frame: the last that began.
template <typename Span>
const Span& InForce(const std::vector<Span>& spans, int frame) {
  const auto after = std::ranges::upper_bound(spans, frame, {}, &Span::begin_frame);
  return after == spans.begin() ? spans.front() : *(after - 1);
}

BodyPose PutAt(const BodyPose& pose, const FloorMove& place) { return place.Apply(pose); }

}  // namespace

CoachedScene::CoachedScene(CoachedSessionFacts facts, std::string heading, int longest, Renderer& renderer)
    : facts_(std::move(facts)),
      heading_(std::move(heading)),
      renderer_(renderer),
      bear_(BearCharacter()),
      learner_(MannequinCharacter()) {
  const int frames = facts_.Frames();
  if (!facts_.corrections.empty()) first_ = facts_.corrections.front() - kBeforeCorrection;
  first_ = std::clamp(first_, 0, std::max(0, frames - std::min(frames, longest)));
  last_ = first_ + std::min(frames - first_, longest);
}

int CoachedScene::PosterFrame() const {
  for (int frame = first_; frame < last_; ++frame) {
    if (InForce(facts_.modes, frame).mode == "correct") return std::min(frame + kFilmRate, last_ - 1) - first_;
  }
  return Frames() / 2;
}

std::string CoachedScene::Words() const {
  return fmt::format(
      "A coached session, seconds {} to {} of {}: the coach in its forest, the learner as danced beside it, and as the "
      "sensor saw it (lower right). Timeline: what the coach does; what every performance truly was; what it was taken "
      "for. "
      "{} corrections in the whole session. A click for every beat of the music.",
      FormatFixed(first_ / kJudgedRateHz, 0), FormatFixed(last_ / kJudgedRateHz, 0),
      FormatFixed(facts_.Frames() / kJudgedRateHz, 0), facts_.corrections.size());
}

const ColourImage& CoachedScene::Backdrop(const Camera& camera) {
  if (backdrop_.pixels.empty()) {
    backdrop_ = renderer_.Render(kMeadow, {ForestFigure()}, camera, Targets::kColour).colour;
  }
  return backdrop_;
}

void CoachedScene::DrawStage(Canvas& canvas, int frame) {
  const auto t = static_cast<std::size_t>(frame);
  Intrinsics inside;
  inside.width = static_cast<int>(kStage.width);
  inside.height = static_cast<int>(kStage.height);
  inside.fx = inside.fy = kStage.height * kSessionDistance / kSessionSeen;
  inside.cx = kStage.width / 2;
  inside.cy = kStage.height / 2;
  const Camera camera = LookAt(inside, {0, kSessionEyeHeight, kSessionDistance}, {0, kSessionLookAt, 0});
  const BodyPose coach = PutAt(facts_.coach.poses[t], kCoachAt), learner = PutAt(facts_.learner.poses[t], kLearnerAt);
  Figure spots;
  spots.surfaces = {SpotBelow(coach), SpotBelow(learner)};
  const std::vector<Figure> people{spots, PosedFigure(bear_, coach), PosedFigure(learner_, learner)};
  const View seen = renderer_.Render(kMeadow, people, camera, Targets::kColourAndLabels);
  ColourImage stage = Backdrop(camera);
  for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
    if (seen.labels.pixels[i] != static_cast<std::uint8_t>(Part::kBackground)) stage.pixels[i] = seen.colour.pixels[i];
  }
  canvas.DrawImage(stage, kStage, kPanelRadius);
  DrawTag(canvas, kStage, fmt::format("The coach: {}", InForce(facts_.modes, frame).mode));
  std::string why;
  for (const auto& decision : facts_.decisions) {
    if (decision.frame <= frame && frame < decision.frame + 2 * kFilmRate && !decision.why.empty()) {
      why = fmt::format("{}: {}", decision.event, decision.why);
    }
  }
  DrawCaption(canvas, kSaid, InForce(facts_.words, frame).say, why.empty() ? "the learner dances on the right" : why);
}

void CoachedScene::DrawSkeletonInset(Canvas& canvas, int frame) const {
  canvas.FillBox(kInset, {0.05, 0.06, 0.07, 0.78}, kPanelRadius);
  DrawStickFigure(canvas, facts_.sensed.poses[static_cast<std::size_t>(frame)], kInset, 2.3, kWarm);
  canvas.DrawText({kInset.x + 10, kInset.y + 18}, "as the sensor saw it", 12, kSoftInk, kInset.width - 20);
}

void CoachedScene::DrawHint(Canvas& canvas, int frame) const {
  const auto& words = InForce(facts_.words, frame);
  if (words.hint.empty() || !words.picture) return;
  canvas.FillBox(kHint, {0.05, 0.06, 0.07, 0.78}, kPanelRadius);
  DrawStickFigure(canvas, *words.picture, {kHint.x, kHint.y + 24, kHint.width, kHint.height - 56}, 2.3, kInk);
  canvas.DrawText({kHint.x + 10, kHint.y + 18}, "key pose", 12, kSoftInk, kHint.width - 20);
  canvas.DrawText({kHint.x + 10, kHint.y + kHint.height - 12}, words.hint, 11, kInk, kHint.width - 20, true);
}

FrameSpan CoachedScene::TimelineAt(int now) const {
  if (Frames() <= kTimelineFrames) return {first_, last_};
  const int begin = std::clamp(now - kTimelineFrames / 2, first_, last_ - kTimelineFrames);
  return {begin, begin + kTimelineFrames};
}

void CoachedScene::DrawTimeline(Canvas& canvas, int now) const {
  const FrameSpan shown = TimelineAt(now);
  SessionTimeline timeline(canvas, shown);
  timeline.Label(0, "coach");
  timeline.Label(1, "truth");
  timeline.Label(2, "judged");
  for (std::size_t i = 0; i < facts_.modes.size(); ++i) {
    const int end = i + 1 < facts_.modes.size() ? facts_.modes[i + 1].begin_frame : facts_.Frames();
    timeline.Bar(0, facts_.modes[i].begin_frame, end, PaintOfMode(facts_.modes[i].mode));
  }
  for (const auto& performance : facts_.performances) {
    const auto& [begin, end] = std::pair(performance.begin_frame, performance.end_frame);
    if (end < shown.begin || begin > shown.end) continue;
    timeline.Bar(1, begin, end, PaintOfWord(performance.truth));
    if (now >= end) timeline.Bar(2, begin, end, PaintOfWord(performance.called));
    timeline.Text(1, begin, end, performance.move);
  }
  for (const int seam : facts_.transitions) {
    if (timeline.Shows(seam)) timeline.Tick(seam, 0, 0, kInk);
  }
  timeline.Tick(now, 0, 2, kInk);
}

std::vector<double> CoachedScene::Beats() const {
  const double begin_s = first_ / kJudgedRateHz, end_s = last_ / kJudgedRateHz;
  std::vector<double> beats;
  for (const double beat : facts_.beats_s) {
    if (beat >= begin_s && beat < end_s) beats.push_back(beat - begin_s);
  }
  return beats;
}

Canvas CoachedScene::Draw(int frame) {
  const int shown = first_ + frame;
  Canvas canvas =
      BeginFrame(fmt::format("{} · {} · {} s", heading_, facts_.song, FormatFixed(shown / kJudgedRateHz, 1)));
  DrawStage(canvas, shown);
  DrawHint(canvas, shown);
  DrawSkeletonInset(canvas, shown);
  DrawTimeline(canvas, shown);
  return canvas;
}

}  // namespace etude
