#include "reports/films/judged_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "bench/model/recording.h"
#include "engine/base/names.h"
#include "engine/fuzzy/features.h"
#include "engine/recognition/key_pose.h"
#include "io/drawing/look.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

using Facts = JudgedSessionFacts;

TrackingState StateOf(char letter) {
  if (letter == 't') return TrackingState::kTracked;
  return letter == 'i' ? TrackingState::kInferred : TrackingState::kNotTracked;
}

Result<SkeletonStream> StreamOf(const BodyMotion& motion, const std::vector<std::string>& states, const Place& place) {
  if (states.size() < motion.poses.size()) {
    return Fail(place, "the extras do not fit the session: 'joint_states' has {} frames, but the motion has {}",
                states.size(), motion.poses.size());
  }
  SkeletonStream stream{.rate_hz = motion.rate_hz, .frames = {}};
  for (std::size_t frame = 0; frame < motion.poses.size(); ++frame) {
    const std::string& letters = states[frame];
    if (letters.size() < kRoleCount) {
      return Fail(place, "the extras do not fit the session: 'joint_states[{}]' has {} joints, but must have {}", frame,
                  letters.size(), kRoleCount);
    }
    SensedFrame& sensed = stream.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      sensed.joints[j] = {motion.poses[frame].joints[j], StateOf(letters[j])};
    }
    sensed.body_seen = letters.find_first_not_of('n') != std::string::npos;
  }
  return stream;
}

std::map<std::string, std::vector<TaughtPose>> KeyPosesIn(const std::vector<DetectionExtras::Move>& moves) {
  std::map<std::string, std::vector<TaughtPose>> all;
  for (const DetectionExtras::Move& move : moves) {
    for (const auto& targets : move.key_poses) {
      TaughtPose& pose = all[move.name].emplace_back();
      for (const DetectionExtras::Target& target : targets) {
        const Feature* feature = FindFeature(target.feature);
        if (feature != nullptr) pose.targets.push_back({*feature, target.degrees, target.tolerance_deg});
      }
    }
  }
  return all;
}

std::vector<Facts::Performance> PerformancesIn(const DetectionExtras& extras, const SeenStream& seen) {
  const auto poses = KeyPosesIn(extras.moves);
  const int frames = static_cast<int>(seen.frames.size());
  std::vector<Facts::Performance> performances;
  for (const DetectionExtras::Event& event : extras.events) {
    Facts::Performance& performance = performances.emplace_back();
    performance.move = event.move;
    performance.truth = event.truth;
    performance.fault = event.fault;
    performance.begin_frame = std::clamp(event.begin_frame, 0, frames);
    performance.end_frame = std::clamp(event.end_frame, performance.begin_frame, frames);
    if (const auto known = poses.find(performance.move); known != poses.end()) performance.poses = known->second;
    // For each key pose, find the frame of the session at which the performer reached this pose.
    const auto window = std::span(seen.frames)
                            .subspan(static_cast<std::size_t>(performance.begin_frame),
                                     static_cast<std::size_t>(performance.end_frame - performance.begin_frame));
    performance.reached = WhenReached(performance.poses, window, {}, {});
    for (auto& when : performance.reached) {
      if (when) *when += performance.begin_frame;
    }
  }
  return performances;
}

Facts::Judge JudgeIn(const DetectionExtras& extras, const std::string& method) {
  Facts::Judge judge{.method = method, .called_right = {}, .alarms = extras.alarms};
  for (const DetectionExtras::Event& event : extras.events) judge.called_right.push_back(event.called_frame);
  return judge;
}

Result<DetectionExtras> ExtrasOf(const Recording& recording, const Place& place) {
  auto extras = ReadExtras<DetectionExtras>(recording.extras_json);
  if (!extras) return Fail(place, "the extras do not fit the session: {}", extras.error().message);
  return extras;
}

/// Adds the verdicts of other methods recorded in the same world, until the timeline has two rows of methods.
Result<void> AddOtherJudges(const RunData& run, const ShownCell& cell, Facts& facts) {
  constexpr std::size_t kMaxJudges = 2;
  for (const auto& [row, recorded] : RecordedRows(run)) {
    if (facts.judges.size() == kMaxJudges) return {};
    const bool same_world = row->scenario == cell.row->scenario && row->condition == cell.row->condition &&
                            row->trial == cell.row->trial && row->method != cell.row->method;
    if (!same_world) continue;
    ASSIGN_OR_RETURN(const auto extras, ExtrasOf(recorded->recording, {.file = "recording " + recorded->cell}));
    Facts::Judge other = JudgeIn(extras, row->method);
    if (other.called_right.size() == facts.performances.size()) facts.judges.push_back(std::move(other));
  }
  return {};
}

}  // namespace

Result<JudgedSessionFacts> ReadJudgedSession(const RunData& run, const ShownCell& cell) {
  const Place place{.file = "recording " + cell.row->Id()};
  // Check the tracks.
  const BodyMotion* truth = FindTrack(*cell.recording, "truth");
  const BodyMotion* sensed = FindTrack(*cell.recording, "sensed");
  if (truth == nullptr || sensed == nullptr || sensed->poses.empty()) {
    return Fail(place, "has no tracks 'truth' and 'sensed'");
  }
  if (truth->poses.size() != sensed->poses.size())
    return Fail(place, "the tracks 'truth' and 'sensed' differ in length");
  ASSIGN_OR_RETURN(const auto extras, ExtrasOf(*cell.recording, place));
  ASSIGN_OR_RETURN(const auto stream, StreamOf(*sensed, extras.joint_states, place));
  // Read the session as the sensor recorded it, the performances, and the method's verdicts.
  JudgedSessionFacts facts;
  facts.truth = *truth;
  facts.seen = SeeStream(stream, {});
  facts.threshold = extras.threshold;
  facts.performances = PerformancesIn(extras, facts.seen);
  facts.judges.push_back(JudgeIn(extras, cell.row->method));
  RETURN_IF_ERROR(AddOtherJudges(run, cell, facts));
  if (facts.performances.empty()) return Fail(place, "no performance was requested");
  // Use the evidence curve (a score per frame) only if the curve has one value for every frame.
  const Series* score = FindSeries(run, *cell.row, "score");
  if (score != nullptr && score->values.size() == sensed->poses.size()) facts.evidence = score->values;
  return facts;
}

namespace {

constexpr Box kSeenPanel{12, 52, 440, 520}, kAnglesPanel{464, 52, 804, 520};
constexpr Box kFigure{12, 84, 440, 440};
constexpr double kTall = 2.4;  // height that the box of the figure shows, metres
constexpr Paint kPanelGround{0.05, 0.06, 0.07, 0.78}, kGhost{0.80, 0.83, 0.85, 0.28};
constexpr double kStripLeft = 156, kStripsTop = 116, kStripsHeight = 392, kStripGap = 8;
constexpr double kMaxAngle = 180;

Paint WithOpacity(const Paint& paint, double a) { return {paint.r, paint.g, paint.b, a}; }

/// Returns the angles that at least one of the poses prescribes, in order of their first occurrence.
std::vector<Feature> FeaturesOf(const std::vector<TaughtPose>& poses) {
  std::vector<Feature> features;
  for (const TaughtPose& pose : poses) {
    for (const PoseTarget& target : pose.targets) {
      if (std::ranges::find(features, target.feature) == features.end()) features.push_back(target.feature);
    }
  }
  return features;
}

/// A horizontal strip that shows a value over the frames of a window.
struct Strip {
  Box box;
  int begin, end;
  double highest;

  double X(int frame) const {
    return box.x + box.width * std::clamp(frame - begin, 0, end - begin) / std::max(1, end - begin);
  }
  double Y(double value) const { return box.y + box.height * (1 - std::clamp(value / highest, 0.0, 1.0)); }
};

/// Describes the ground truth of a performance: "truth: wrong (wrong side, late)".
std::string TruthWords(const JudgedSessionFacts::Performance& danced) {
  std::string fault = danced.fault == "none" ? "" : " (" + WithSpaces(danced.fault) + ")";
  if (const auto plus = fault.find('+'); plus != std::string::npos) fault.replace(plus, 1, ", ");
  return fmt::format("truth: {}{}", danced.truth == "grey" ? "neither" : danced.truth, fault);
}

}  // namespace

JudgedScene::JudgedScene(JudgedSessionFacts facts, std::string heading, int longest)
    : facts_(std::move(facts)), heading_(std::move(heading)) {
  const auto& all = facts_.performances;
  std::size_t shown = 0;
  while (shown < all.size() && !IsMisjudged(shown)) ++shown;
  if (shown == all.size()) shown = 0;
  if (shown > 0) --shown;
  const int frames = facts_.Frames();
  first_ = std::clamp(all[shown].begin_frame - kFilmRate, 0, std::max(0, frames - longest));
  last_ = first_ + std::min(frames - first_, longest);
}

bool JudgedScene::IsMisjudged(std::size_t performance) const {
  const std::string& truth = facts_.performances[performance].truth;
  const bool called_right = facts_.judges.front().called_right[performance].has_value();
  return truth == (called_right ? "wrong" : "right");
}

std::size_t JudgedScene::CurrentAt(int frame) const {
  const auto after = std::ranges::upper_bound(facts_.performances, frame, {}, &Performance::begin_frame);
  return after == facts_.performances.begin() ? 0 : static_cast<std::size_t>(after - facts_.performances.begin()) - 1;
}

std::string JudgedScene::CalledAt(std::size_t judge, std::size_t performance, int frame) const {
  const auto& right = facts_.judges[judge].called_right[performance];
  if (right && frame >= *right) return "right";
  return frame >= facts_.performances[performance].end_frame ? "wrong" : "";
}

int JudgedScene::PosterFrame() const {
  for (const Performance& performance : facts_.performances) {
    const int late = performance.begin_frame + 3 * (performance.end_frame - performance.begin_frame) / 4;
    if (performance.begin_frame >= first_ && late < last_) return late - first_;
  }
  return Frames() / 2;
}

std::string JudgedScene::Words() const {
  return fmt::format(
      "A session in front of the sensor, seconds {} to {} of {}. The skeleton that the sensor measured is drawn over "
      "the true body (pale). The curves show the angles of the requested key poses, where a tick marks a pose that "
      "paper A's rule has recognised, and the evidence of {}. The bands of the timeline show whether each performance "
      "was truly right, the judgement of each performance, and false alarms.",
      FormatFixed(first_ / kJudgedRateHz, 0), FormatFixed(last_ / kJudgedRateHz, 0),
      FormatFixed(facts_.Frames() / kJudgedRateHz, 0), facts_.judges.front().method);
}

void JudgedScene::DrawSkeleton(Canvas& canvas, int now) const {
  const auto t = static_cast<std::size_t>(now);
  canvas.FillBox(kSeenPanel, kPanelGround, kPanelRadius);
  DrawStickFigure(canvas, facts_.truth.poses[t], kFigure, kTall, kGhost);
  const SensedFrame& sensed = facts_.seen.filtered.frames[t];
  if (sensed.body_seen) {
    const BodyPose pose = PoseOf(sensed);
    DrawStickFigure(canvas, pose, kFigure, kTall, kAccent);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto role = static_cast<Role>(j);
      const TrackingState state = sensed[role].state;
      if (state == TrackingState::kTracked) continue;
      canvas.DrawDot(StickJoint(pose, role, kFigure, kTall), 6,
                     state == TrackingState::kInferred ? kWarm : kWrongPaint);
    }
  }
  DrawTag(canvas, kSeenPanel, sensed.body_seen ? "Measured by the sensor" : "The sensor sees nobody");
  canvas.DrawText({kSeenPanel.x + 16, kSeenPanel.y + kSeenPanel.height - 16},
                  "pale: true pose · orange: guessed joint · red: missing joint", 16, kSoftInk, kSeenPanel.width - 32);
}

void JudgedScene::DrawAngles(Canvas& canvas, int now) const {
  canvas.FillBox(kAnglesPanel, kPanelGround, kPanelRadius);
  // Write the heading: the expected move, the verdict and the truth.
  const std::size_t current = CurrentAt(now);
  const Performance& asked = facts_.performances[current];
  const bool is_open = now >= asked.begin_frame && now < asked.end_frame;
  const double left = kAnglesPanel.x + 16;
  canvas.DrawText({left, kAnglesPanel.y + 28},
                  fmt::format("{}: {}", is_open ? "requested" : "last request", WithSpaces(asked.move)), 20, kInk, 300,
                  true);
  const std::string called = CalledAt(0, current, now);
  const std::string verdict = called.empty() ? "not yet judged" : "judged " + called;
  canvas.DrawText({left, kAnglesPanel.y + 53}, fmt::format("{}: {}", facts_.judges.front().method, verdict), 17,
                  called.empty() ? kSoftInk : PaintOfWord(called), 300, true);
  canvas.DrawText({left, kAnglesPanel.y + 77}, TruthWords(asked), 17, PaintOfWord(asked.truth), 300);
  // Draw the expected key poses in order, with a check mark at each pose that was reached.
  for (std::size_t k = 0; k < asked.poses.size(); ++k) {
    const bool is_reached = asked.reached[k] && now >= *asked.reached[k];
    const Box box{kAnglesPanel.x + 316 + 122 * static_cast<double>(k % 4),
                  kAnglesPanel.y + 14 + 30 * static_cast<double>(k / 4), 118, 24};
    if (box.y + box.height > kAnglesPanel.y + kStripsTop - 20) break;
    canvas.FillBox(box, is_reached ? kRightPaint : WithOpacity(kUndecidedPaint, 0.5), 5);
    canvas.DrawText({box.x + 8, box.y + 17}, fmt::format("pose {}{}", k + 1, is_reached ? " ✓" : ""), 16,
                    is_reached ? kBackdrop : kInk, box.width - 8, true);
  }
  // Draw one strip for each angle, and one strip for the evidence.
  const std::vector<Feature> features = FeaturesOf(asked.poses);
  const double rows = static_cast<double>(features.size()) + 1;
  const double height = std::min(84.0, kStripsHeight / rows - kStripGap);
  // In a damaged recording, the performance may end at frame 0; show at least this frame.
  const int shown_to = std::max(0, std::min(now, asked.end_frame - 1));
  const auto strip_at = [&](std::size_t row, double highest) {
    return Strip{
        {kAnglesPanel.x + kStripLeft, kAnglesPanel.y + kStripsTop + static_cast<double>(row) * (height + kStripGap),
         kAnglesPanel.width - kStripLeft - 16, height},
        asked.begin_frame,
        asked.end_frame,
        highest};
  };
  const auto draw = [&](const Strip& strip, const std::string& name, const std::string& value, const auto& at) {
    canvas.FillBox(strip.box, {0.16, 0.18, 0.20, 1}, 4);
    canvas.DrawText({left, strip.box.y + height / 2 - 2}, name, 16, kInk, kStripLeft - 24, true);
    canvas.DrawText({left, strip.box.y + height / 2 + 16}, value, 16, kSoftInk, kStripLeft - 24);
    std::vector<glm::dvec2> path;
    for (int frame = asked.begin_frame; frame <= shown_to; ++frame)
      path.emplace_back(strip.X(frame), strip.Y(at(frame)));
    return path;
  };
  // Draw each angle's curve over the tolerance bands of the key poses.
  for (std::size_t row = 0; row < features.size(); ++row) {
    const Feature feature = features[row];
    const auto angle = [&](int frame) { return facts_.seen.frames[static_cast<std::size_t>(frame)].features[feature]; };
    const Strip strip = strip_at(row, kMaxAngle);
    const auto path = draw(strip, std::string(PlainNameOf(feature)), FormatFixed(angle(now), 0) + "°", angle);
    for (std::size_t k = 0; k < asked.poses.size(); ++k) {
      const bool is_reached = asked.reached[k] && now >= *asked.reached[k];
      for (const PoseTarget& target : asked.poses[k].targets) {
        if (target.feature != feature) continue;
        const double top = strip.Y(target.degrees + target.tolerance_deg);
        const double bottom = strip.Y(target.degrees - target.tolerance_deg);
        canvas.FillBox({strip.box.x, top, strip.box.width, bottom - top},
                       WithOpacity(is_reached ? kRightPaint : kAccent, 0.18));
        canvas.DrawText({strip.box.x + strip.box.width - 16, strip.Y(target.degrees) + 5}, fmt::format("{}", k + 1), 15,
                        kSoftInk, 14);
      }
      if (is_reached)
        canvas.DrawLine({strip.X(*asked.reached[k]), strip.box.y}, {strip.X(*asked.reached[k]), strip.box.y + height},
                        1.5, kRightPaint);
    }
    if (path.size() > 1) canvas.DrawPath(path, 2, kInk);
  }
  // Draw the evidence curve, with the threshold for the verdict "right".
  if (facts_.evidence.empty()) return;
  const auto evidence = [&](int frame) { return facts_.evidence[static_cast<std::size_t>(frame)]; };
  const Strip strip = strip_at(features.size(), 1);
  const auto path = draw(strip, "evidence", FormatFixed(evidence(shown_to), 2), evidence);
  if (facts_.threshold) {
    canvas.DrawLine({strip.box.x, strip.Y(*facts_.threshold)},
                    {strip.box.x + strip.box.width, strip.Y(*facts_.threshold)}, 1.5, kWarm);
  }
  if (path.size() > 1) canvas.DrawPath(path, 2, kAccent);
}

void JudgedScene::DrawTimeline(Canvas& canvas, int now) const {
  SessionTimeline timeline(canvas, {first_, last_});
  const auto rows = static_cast<int>(facts_.judges.size());
  timeline.Label(0, "truth");
  for (const Performance& performance : facts_.performances) {
    if (performance.end_frame < first_ || performance.begin_frame > last_) continue;
    timeline.Bar(0, performance.begin_frame, performance.end_frame, PaintOfWord(performance.truth));
    timeline.Text(0, performance.begin_frame, performance.end_frame, WithSpaces(performance.move));
  }
  for (int j = 0; j < rows; ++j) {
    const auto& judge = facts_.judges[static_cast<std::size_t>(j)];
    timeline.Label(j + 1, judge.method);
    for (std::size_t i = 0; i < facts_.performances.size(); ++i) {
      const Performance& performance = facts_.performances[i];
      if (performance.end_frame < first_ || performance.begin_frame > last_) continue;
      const std::string called = CalledAt(static_cast<std::size_t>(j), i, now);
      if (called.empty()) continue;
      timeline.Bar(j + 1, performance.begin_frame, performance.end_frame, PaintOfWord(called));
    }
    for (const auto& alarm : judge.alarms) {
      if (alarm.frame <= now && timeline.Shows(alarm.frame)) timeline.Tick(alarm.frame, j + 1, j + 1, kWarm);
    }
  }
  timeline.Tick(now, 0, rows, kInk);
}

Canvas JudgedScene::Draw(int frame) {
  const int now = first_ + frame;
  Canvas canvas = BeginFrame(fmt::format("{} · {} s", heading_, FormatFixed(now / kJudgedRateHz, 1)));
  DrawSkeleton(canvas, now);
  DrawAngles(canvas, now);
  DrawTimeline(canvas, now);
  return canvas;
}

}  // namespace etude
