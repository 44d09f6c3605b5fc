#include "reports/films/coached_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <string_view>
#include <utility>

#include "bench/model/recording.h"
#include "engine/base/angles.h"
#include "engine/base/names.h"
#include "io/drawing/look.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "sim/character/characters.h"
#include "sim/character/posed.h"

namespace etude {
namespace {

/// Clamps every frame number of a recording to the frames of the session.
void KeepWithin(CoachedSessionFacts& facts) {
  const int last = facts.Frames() - 1;
  const auto keep = [&](int& frame) { frame = std::clamp(frame, 0, last); };
  for (auto& mode : facts.modes) keep(mode.begin_frame);
  for (auto& performance : facts.performances) {
    keep(performance.begin_frame);
    keep(performance.end_frame);
  }
  for (auto& words : facts.words) keep(words.begin_frame);
  for (auto& decision : facts.decisions) keep(decision.frame);
  for (std::vector<int>* frames : {&facts.corrections, &facts.transitions}) std::ranges::for_each(*frames, keep);
}

}  // namespace

Result<CoachedSessionFacts> ReadCoachedSession(const ShownCell& cell) {
  const Place place{.file = "recording " + cell.row->Id()};
  auto extras = ReadExtras<CoachExtras>(cell.recording->extras_json);
  CoachedSessionFacts facts;
  for (const auto& [name, motion] :
       {std::pair{"coach", &facts.coach}, std::pair{"truth", &facts.learner}, std::pair{"sensed", &facts.sensed}}) {
    const BodyMotion* track = FindTrack(*cell.recording, name);
    if (track == nullptr || track->poses.empty()) return Fail(place, "has no track '{}'", name);
    *motion = *track;
  }
  if (facts.learner.poses.size() != facts.coach.poses.size() || facts.sensed.poses.size() != facts.coach.poses.size()) {
    return Fail(place, "the tracks 'coach', 'truth' and 'sensed' differ in length");
  }
  if (!extras) return Fail(place, "the extras are not those of a coached session: {}", extras.error().message);
  static_cast<CoachExtras&>(facts) = *std::move(extras);
  KeepWithin(facts);
  if (facts.modes.empty() || facts.words.empty())
    return Fail(place, "the extras contain no mode or no words of the coach");
  return facts;
}

std::optional<ShownCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario) {
  std::optional<ShownCell> worst;
  double most_wrong = -1;
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (row->scenario != scenario.name) continue;
    const double wrong = ValueOf(*row, "corrections_unneeded_per_min").value_or(0) +
                         ValueOf(*row, "corrections_missed_per_min").value_or(0);
    if (wrong <= most_wrong) continue;
    most_wrong = wrong;
    worst = ShownCell{&scenario, row, &recorded->recording};
  }
  return worst;
}

namespace {

constexpr Rgb8 kSky{176, 212, 232}, kHills{122, 160, 138}, kGrass{126, 168, 92}, kTrunk{112, 84, 60};
constexpr std::array<Rgb8, 3> kCrowns = {{{66, 118, 72}, {82, 136, 78}, {52, 100, 68}}};

/// Returns a flat convex polygon. `corners` are in counter-clockwise order, seen from the side to which `normal`
/// points.
Surface Sheet(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal, Rgb8 colour) {
  Surface sheet;
  sheet.positions = corners;
  sheet.normals.assign(corners.size(), normal);
  for (std::uint32_t i = 2; i < corners.size(); ++i) sheet.triangles.push_back({0, i - 1, i});
  sheet.parts.assign(sheet.triangles.size(), Part::kClutter);
  sheet.colour = colour;
  return sheet;
}

/// Returns a part of a tree: a frustum about the vertical axis, which is a trunk or, with a top radius of 0, a crown.
Surface Cone(const glm::dvec3& foot, double height, double foot_radius, double top_radius, Rgb8 colour) {
  constexpr int kSides = 10;
  Surface cone;
  const double slope = (foot_radius - top_radius) / height;
  for (int i = 0; i <= kSides; ++i) {
    const double turn = 2 * kPi * i / kSides;
    const glm::dvec3 out(std::cos(turn), 0, std::sin(turn));
    const glm::dvec3 normal = glm::normalize(out + glm::dvec3(0, slope, 0));
    cone.positions.push_back(foot + foot_radius * out);
    cone.positions.push_back(foot + glm::dvec3(0, height, 0) + top_radius * out);
    cone.normals.insert(cone.normals.end(), 2, normal);
  }
  for (std::uint32_t i = 0; i < 2 * kSides; i += 2) {
    cone.triangles.push_back({i, i + 1, i + 2});
    cone.triangles.push_back({i + 1, i + 3, i + 2});
  }
  cone.parts.assign(cone.triangles.size(), Part::kClutter);
  cone.colour = colour;
  return cone;
}

void AddTree(const glm::dvec3& foot, double height, std::size_t kind, Figure& forest) {
  const double trunk = 0.22 * height;
  forest.surfaces.push_back(Cone(foot, 1.2 * trunk, 0.035 * height, 0.025 * height, kTrunk));
  for (int tier = 0; tier < 3; ++tier) {
    const double low = trunk + 0.24 * height * tier, radius = (0.21 - 0.045 * tier) * height;
    forest.surfaces.push_back(Cone(foot + glm::dvec3(0, low, 0), 0.36 * height, radius, 0.0, kCrowns[kind % 3]));
  }
}

constexpr Box kStage{12, 52, 1256, 520};
constexpr Box kSaid{12, 52, 1064, 520};  // the part of the picture that text may cover, pixels
constexpr Box kInset{1086, 372, 170, 188};
constexpr Box kHint{1046, 64, 210, 280};

// The positions of coach and learner, and the camera.
constexpr FloorMove kCoachAt{.yaw = 0, .x = -1.05, .z = -0.3}, kLearnerAt{.yaw = 0, .x = 0.95, .z = -0.3};
constexpr double kSessionEyeHeight = 1.35, kSessionDistance = 5.2, kSessionLookAt = 1.0, kSessionSeen = 2.5;

constexpr int kBeforeCorrection = 3 * kFilmRate;

/// The maximum number of frames that the timeline shows. If the film is longer, the timeline shows a window around the
/// current frame.
constexpr int kTimelineFrames = 24 * kFilmRate;

const Room kMeadow{.casts_shadows = false};

Paint PaintOfMode(const std::string& mode) {
  if (mode == "dance") return kAccent;
  if (mode == "correct") return kWarm;
  if (mode == "demonstrate") return {0.72, 0.58, 0.90, 1};
  if (mode == "praise") return kRightPaint;
  return kUndecidedPaint;
}

/// Returns the span that applies at a frame: the last span that begins at or before the frame. If all spans begin
/// later, returns the first one.
template <typename Span>
const Span& InForce(const std::vector<Span>& spans, int frame) {
  const auto after = std::ranges::upper_bound(spans, frame, {}, &Span::begin_frame);
  return after == spans.begin() ? spans.front() : *(after - 1);
}

BodyPose PutAt(const BodyPose& pose, const FloorMove& place) { return place.Apply(pose); }

}  // namespace

Surface SpotBelow(const BodyPose& pose) {
  constexpr int kCorners = 24;
  constexpr Rgb8 kShade{92, 128, 70};
  const glm::dvec3 left = pose[Role::kLeftAnkle], right = pose[Role::kRightAnkle];
  const glm::dvec3 middle = 0.5 * (left + right);
  const double half = 0.22 + 0.5 * std::abs(left.x - right.x);
  std::vector<glm::dvec3> rim;
  for (int i = 0; i < kCorners; ++i) {
    const double turn = -2 * kPi * i / kCorners;
    rim.push_back({middle.x + half * std::cos(turn), 0.012, middle.z + 0.17 * std::sin(turn)});
  }
  return Sheet(rim, {0, 1, 0}, kShade);
}

Figure ForestFigure() {
  constexpr double kFar = 14, kNear = 8, kBack = kWallZ + 0.02;
  // Draw the sky, the hills in strips, and the meadow.
  Figure forest;
  forest.surfaces.push_back(
      Sheet({{-kFar, 0, kBack}, {kFar, 0, kBack}, {kFar, 10, kBack}, {-kFar, 10, kBack}}, {0, 0, 1}, kSky));
  const auto hill = [](double x) { return 1.5 + 0.28 * std::sin(0.9 * x + 0.6) + 0.16 * std::sin(2.3 * x); };
  constexpr double kStep = 0.5;
  for (double x = -kFar; x < kFar; x += kStep) {
    const double z = kBack + 0.05, end = x + kStep;
    forest.surfaces.push_back(Sheet({{x, 0, z}, {end, 0, z}, {end, hill(end), z}, {x, hill(x), z}}, {0, 0, 1}, kHills));
  }
  forest.surfaces.push_back(Sheet(
      {{-kFar, 0.004, kNear}, {kFar, 0.004, kNear}, {kFar, 0.004, kBack}, {-kFar, 0.004, kBack}}, {0, 1, 0}, kGrass));
  // The trees were placed by hand. The middle is free for the dancers.
  constexpr std::array<glm::dvec3, 12> kTrees = {{{-5.6, 3.0, -2.1},
                                                  {-4.7, 2.3, -1.8},
                                                  {-3.9, 2.9, -2.2},
                                                  {-3.1, 2.2, -1.9},
                                                  {-2.2, 2.7, -2.2},
                                                  {-1.2, 2.0, -2.3},
                                                  {0.2, 2.2, -2.3},
                                                  {1.3, 2.6, -2.2},
                                                  {2.3, 2.1, -2.0},
                                                  {3.2, 2.9, -2.2},
                                                  {4.2, 2.4, -1.8},
                                                  {5.2, 3.1, -2.1}}};  // x, height, z of each tree
  for (std::size_t i = 0; i < kTrees.size(); ++i) {
    AddTree({kTrees[i].x, 0, kTrees[i].z}, kTrees[i].y, i, forest);
  }
  return forest;
}

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
      "A coached session, seconds {} to {} of {}. Left: the coach in a forest. Right: the learner's true motion. Lower "
      "right: the learner's motion as the sensor measured it. The bands of the timeline show the coach's action, "
      "whether each performance was truly right, and the coach's judgement. The whole session has {} corrections. The "
      "film has a click for every beat of the music.",
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
  // Place the camera so that it sees coach and learner side by side.
  Intrinsics inside;
  inside.width = static_cast<int>(kStage.width);
  inside.height = static_cast<int>(kStage.height);
  inside.fx = inside.fy = kStage.height * kSessionDistance / kSessionSeen;
  inside.cx = kStage.width / 2;
  inside.cy = kStage.height / 2;
  const Camera camera = LookAt(inside, {0, kSessionEyeHeight, kSessionDistance}, {0, kSessionLookAt, 0});
  const BodyPose coach = PutAt(facts_.coach.poses[t], kCoachAt), learner = PutAt(facts_.learner.poses[t], kLearnerAt);
  // Render the people, and copy their pixels over the picture of the forest.
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
  // Show the reason for the coach's latest decision, if the decision was made within the last two seconds.
  std::string why;
  for (const auto& decision : facts_.decisions) {
    // Leave out decisions about music, clips and rules of correction: such decisions are too detailed for viewers.
    const bool is_said = decision.event != "tag" && decision.event != "transition" && decision.event != "corrects";
    if (is_said && decision.frame <= frame && frame < decision.frame + 2 * kFilmRate && !decision.why.empty()) {
      // For the verdict "wrong", show the fault, but not the evidence that follows in the text; for "right", show only
      // the verdict.
      const std::string_view event = decision.event;
      why = event == "wrong"   ? "wrong: " + decision.why.substr(0, decision.why.find(':'))
            : event == "right" ? "judged right"
                               : decision.why;
    }
  }
  DrawCaption(canvas, kSaid, InForce(facts_.words, frame).say,
              why.empty() ? "the learner dances on the right" : WithSpaces(why));
}

void CoachedScene::DrawSkeletonInset(Canvas& canvas, int frame) const {
  canvas.FillBox(kInset, {0.05, 0.06, 0.07, 0.78}, kPanelRadius);
  DrawStickFigure(canvas, facts_.sensed.poses[static_cast<std::size_t>(frame)], kInset, 2.3, kWarm);
  canvas.DrawText({kInset.x + 10, kInset.y + 18}, "as measured by the sensor", 15, kSoftInk, kInset.width - 20);
}

void CoachedScene::DrawHint(Canvas& canvas, int frame) const {
  const auto& words = InForce(facts_.words, frame);
  if (words.hint.empty() || !words.picture) return;
  canvas.FillBox(kHint, {0.05, 0.06, 0.07, 0.78}, kPanelRadius);
  constexpr double kSize = 16, kLine = 21, kRoom = kHint.width - 20;
  canvas.DrawText({kHint.x + 10, kHint.y + 20}, "key pose", kSize, kSoftInk, kRoom);
  const std::vector<std::string> lines = LinesOf(canvas, words.hint, kSize, kRoom, true);
  double y = kHint.y + kHint.height - 12 - kLine * static_cast<double>(lines.size());
  DrawStickFigure(canvas, *words.picture, {kHint.x, kHint.y + 28, kHint.width, y - kHint.y - 34}, 2.3, kInk);
  for (const std::string& line : lines) canvas.DrawText({kHint.x + 10, y += kLine}, line, kSize, kInk, kRoom, true);
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
  // Draw the coach's modes, the performances with their verdicts, and the transitions.
  for (std::size_t i = 0; i < facts_.modes.size(); ++i) {
    const int end = i + 1 < facts_.modes.size() ? facts_.modes[i + 1].begin_frame : facts_.Frames();
    timeline.Bar(0, facts_.modes[i].begin_frame, end, PaintOfMode(facts_.modes[i].mode));
  }
  for (const auto& performance : facts_.performances) {
    const auto& [begin, end] = std::pair(performance.begin_frame, performance.end_frame);
    if (end < shown.begin || begin > shown.end) continue;
    timeline.Bar(1, begin, end, PaintOfWord(performance.truth));
    if (now >= end) timeline.Bar(2, begin, end, PaintOfWord(performance.called));
    timeline.Text(1, begin, end, WithSpaces(performance.move));
  }
  for (const int point : facts_.transitions) {
    if (timeline.Shows(point)) timeline.Tick(point, 0, 0, kInk);
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
