#include "bench/tasks/transition/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "bench/metrics/transition_join.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/recordings/task_extras.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "engine/formats/bvh.h"
#include "engine/motion/clip.h"

namespace etude {
namespace {

constexpr std::size_t kMaxBetween = 300;  // number of frames in ten seconds
constexpr std::size_t kMaxThrough = 16;
constexpr std::size_t kMaxReasonBytes = 300;
constexpr Range kJoins_s{0, 5};
constexpr double kLimbTolerance = 0.02;  // tolerance of limb lengths, metres

Result<void> CheckLimbs(const BodyPose& pose, const BodyProportions& character, const std::string& path) {
  for (const Bone& bone : AllBones()) {
    const double length = BoneLength(pose, bone), own = character.limb_lengths[Index(bone.child)];
    if (std::abs(length - own) <= kLimbTolerance) continue;
    return Fail({}, "{}: {} is {:.3f} m from {}; allowed: {:.3f} m ± {:g}, the length of the character's limb", path,
                RoleName(bone.child), length, RoleName(bone.parent), own, kLimbTolerance);
  }
  return {};
}

/// Reads a pose, which must have the character's limb lengths. Errors are collected in `fields`.
BodyPose ReadOwnPose(const Json& json, const std::string& path, const BodyProportions& character,
                     AnswerFields& fields) {
  const auto pose = ReadPose(json, path);
  const auto fits = pose ? CheckLimbs(*pose, character, path) : tl::unexpected(pose.error());
  if (!fits) fields.Note(fits.error());
  return pose.value_or(BodyPose{});
}

/// Reads the method's own frames. Frame 0 of the segment is the method's version of `leave_frame`; it is not shown.
std::optional<Segment> ReadBetween(AnswerFields& fields, const BodyProportions& character) {
  const Json& entries = fields.List("between", 0, kMaxBetween);
  Segment segment{.first = 0, .last = static_cast<int>(entries.size()), .own = {BodyPose{}}, .in_place = true};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    segment.own.push_back(ReadOwnPose(entries[i], fields.PathOf("between", i), character, fields));
  }
  const Json* start = fields.Raw("between_start");
  if (entries.empty()) {
    if (start != nullptr) fields.Note({{}, "between_start: only together with 'between'"});
    return std::nullopt;
  }
  segment.own.front() = start != nullptr
                            ? ReadOwnPose(*start, "between_start", character, fields)
                            : FrameBefore(segment.own[1], segment.own[std::min<std::size_t>(2, entries.size())]);
  return segment;
}

/// Reads the clips played in between.
void ReadThrough(AnswerFields& fields, const Stage& stage, std::vector<Segment>& segments) {
  const Json& entries = fields.List("through", 0, kMaxThrough);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    AnswerFields entry(entries[i], fields.PathOf("through", i));
    const int clip = entry.Integer("clip", 0, static_cast<int>(stage.library.tagged.size()) - 1);
    const int last = stage.library.tagged[clip].FrameCount() - 1;
    const int entered = entry.Integer("enter_frame", 0, last - 1);
    const int left = entry.Integer("leave_frame", entered + 1, last);
    segments.push_back({.clip = clip, .first = entered, .last = left, .own = {}});
    if (auto done = entry.Finish(); !done) fields.Note(done.error());
  }
}

TransitionAnswer ReadTransition(AnswerFields& fields, const Stage& stage, const TransitionRequest& request) {
  TransitionAnswer answer;
  // Read the segments: the playing clip, clips or frames in between, and the wanted clip.
  const int last_of_from = stage.library.tagged[request.from].FrameCount() - 1;
  const int last_of_to = stage.library.tagged[request.to].FrameCount() - 1;
  const int left = fields.Integer("leave_frame", request.request_frame, last_of_from);
  answer.segments.push_back({.clip = request.from, .first = request.request_frame, .last = left, .own = {}});
  ReadThrough(fields, stage, answer.segments);
  const int entered = fields.Integer("enter_frame", 0, last_of_to - 1);  // at least one frame must follow
  std::optional<Segment> between = ReadBetween(fields, stage.library.proportions);
  if (between && answer.segments.size() > 1) fields.Note({{}, "through: not together with 'between'"});
  if (between) answer.segments.push_back(*std::move(between));
  answer.segments.push_back({.clip = request.to, .first = entered, .last = last_of_to, .own = {}});
  // Read the join and its duration.
  answer.join = FindJoin(fields.Choice("join", JoinNames(), JoinNames().front()));
  if (fields.Has("join_s")) {
    answer.segments.back().preferred = PreferredJoin{.blend_s = fields.Number("join_s", kJoins_s)};
    const bool fades = fields.Boolean("fades", false), direct = fields.Boolean("direct", false);
    answer.segments.back().preferred->way = direct ? JoinStyle::kDirect : fades ? JoinStyle::kFades : JoinStyle::kDecays;
  }
  answer.matched = fields.Boolean("matched", false);
  return answer;
}

/// Returns the frames to record: 2.5 s before and after the transition points, and at least the frames in which the
/// join is judged.
FrameWindow RecordedFrames(const TransitionOutcome& outcome, const Stage& stage) {
  constexpr double kSeconds = 2.5;
  const JoinView view = ViewOf(outcome, stage);
  FrameWindow window = AroundPoints(outcome.splice, kSeconds);
  const int judged = view.first + static_cast<int>(JoinSupport(view).size()) - 1;
  const int landed = judged + static_cast<int>(view.rate_hz);  // one second later: by then, a body in flight has landed
  window.last = std::max(window.last, std::min(landed, static_cast<int>(view.shown.size()) - 1));
  return window;
}

std::string NameOf(const Segment& segment, const Stage& stage) {
  return segment.clip == Segment::kOwnFrames ? "in-between" : stage.library.names[segment.clip];
}

}  // namespace

Payload StagePayload(const Stage& stage) {
  Payload setting = PayloadOf({{"rate_hz", kJudgedRateHz}});
  setting.json->update(DescribeBody());
  Json& clips = (*setting.json)["clips"] = Json::array();
  for (std::size_t clip = 0; clip < stage.library.names.size(); ++clip) {
    const std::string file = fmt::format("clip-{}.bvh", clip);
    const BodyMotion& motion = stage.library.motions[clip];
    clips.push_back({{"name", stage.library.names[clip]}, {"poses", EncodePoses(motion.poses)}, {"file", file}});
    setting.files.push_back({file, WriteBvh(ToClip(motion, stage.library.names[clip]))});
  }
  return setting;
}

Payload RequestPayload(const TransitionRequest& request, double max_wait_s) {
  Json json = {
      {"from", request.from}, {"to", request.to}, {"request_frame", request.request_frame}, {"max_wait_s", max_wait_s}};
  return PayloadOf(std::move(json));
}

Payload NaturalLimitPayload(const Stage& stage, const TransitionRequest& request) {
  const double limit = NaturalLimitCm(NaturalJumpsOf(stage, request.from, request.to));
  return PayloadOf({{"natural_limit_cm", limit}});
}

Result<TransitionAnswer> ReadTransitionAnswer(const Json& answer, const Stage& stage,
                                              const TransitionRequest& request) {
  AnswerFields fields(answer);
  TransitionAnswer read;
  if (fields.Has("unsolved")) {
    read.unsolved = fields.Text("unsolved", kMaxReasonBytes);
  } else {
    read = ReadTransition(fields, stage, request);
  }
  RETURN_IF_ERROR(fields.Finish());
  return read;
}

Series JumpSeries(const TransitionOutcome& outcome) {
  const FrameWindow window = AroundPoints(outcome.splice, 1);
  const std::vector<double> all = SecondDifferencesCm(outcome.splice.motion);
  return {"second_difference_cm", "frame", {all.begin() + window.first, all.begin() + window.last + 1}};
}

std::vector<Series> ExplanationOf(const TransitionRecord& record) {
  const auto append = [](std::vector<double>& all, const PerFeature& ten) {
    all.insert(all.end(), ten.begin(), ten.end());
  };
  Series points{"point_partials", "feature", {}}, partials{"candidate_partials", "feature", {}};
  for (const FuzzyDistance& distance : record.distances) append(points.values, distance.partials);
  for (const Candidate& candidate : record.candidates) append(partials.values, candidate.distance.partials);
  const auto each = [&](const char* name, auto&& value) {
    Series series{name, "candidate", {}};
    for (const Candidate& candidate : record.candidates) series.values.push_back(static_cast<double>(value(candidate)));
    return series;
  };
  return {std::move(points),
          each("candidate_point", [](const Candidate& c) { return c.point; }),
          each("candidate_from_frame", [](const Candidate& c) { return c.from_frame; }),
          each("candidate_to_frame", [](const Candidate& c) { return c.to_frame; }),
          each("candidate_distance", [](const Candidate& c) { return c.distance.value; }),
          each("candidate_outcome", [](const Candidate& c) { return static_cast<int>(c.outcome); }),
          std::move(partials)};
}

Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage) {
  const FrameWindow window = RecordedFrames(outcome, stage);
  const JoinView view = ViewOf(outcome, stage);
  const auto track = [&](const char* name, std::span<const BodyPose> poses, int shown_first, int more = 0) {
    const std::ptrdiff_t count = std::ssize(poses), begin = std::max(window.first - shown_first, 0);
    const std::ptrdiff_t end = std::min<std::ptrdiff_t>(window.last - shown_first + 1 + more, count);
    return Track{name, {view.rate_hz, {poses.begin() + begin, poses.begin() + end}}};
  };
  // The support of a clip is needed even after the clip was left: for the window of the support rules, and for one more
  // frame, from which velocities are computed.
  const int asked = static_cast<int>(std::lround(SupportRules().window_s * view.rate_hz)) + 1;

  // Describe the transition.
  const TransitionRecord& record = outcome.record;
  const FuzzyDistance& worst = WorstDistance(record);
  TransitionExtras extras;
  for (const PlacedPoint& point : outcome.splice.points) {
    extras.transition_frames.push_back(point.frame - window.first);
  }
  extras.transition_frame = extras.transition_frames.front();
  extras.from = NameOf(record.segments.front(), stage);
  extras.to = NameOf(record.segments.back(), stage);
  extras.branch = BranchName(record.branch);
  extras.why = record.why;
  extras.request_frame = record.request_frame - window.first;
  extras.wait_s = record.wait_s;
  extras.threshold = outcome.rules.threshold;
  extras.natural_limit_cm = NaturalLimitCm(NaturalJumpsOf(stage, outcome.request.from, outcome.request.to));
  extras.distance = worst.value;
  extras.weights = outcome.rules.weights;
  extras.partials = worst.partials;
  extras.pairs_seen = record.pairs_seen;
  extras.pairs_matched = record.pairs_matched;
  // Add the transition points and the candidates, with their distances.
  for (std::size_t i = 0; i < record.distances.size(); ++i) {
    const Segment &old = record.segments[i], &next = record.segments[i + 1];
    extras.points.push_back({.from = NameOf(old, stage),
                             .to = NameOf(next, stage),
                             .from_frame = old.last,
                             .to_frame = next.first,
                             .distance = record.distances[i].value,
                             .partials = record.distances[i].partials});
  }
  extras.cost_unit = record.cost_unit;
  for (const Candidate& candidate : record.candidates) {
    extras.candidates.push_back({.point = candidate.point,
                                 .from_frame = candidate.from_frame,
                                 .to_frame = candidate.to_frame,
                                 .distance = candidate.distance.value,
                                 .partials = candidate.distance.partials,
                                 .cost = candidate.cost,
                                 .outcome = std::string(OutcomeName(candidate.outcome))});
  }
  // Record the motion shown, and the clips of which it was made.
  Recording recording{
      {track("coach", view.shown, 0), track("left", view.left, 0, asked), track("wanted", view.wanted, view.last)},
      WriteExtras(extras)};
  for (const SupportingClip& clip : view.between) {
    if (!clip.poses.empty()) recording.tracks.push_back(track("through", clip.poses, clip.begin, asked));
  }
  return recording;
}

}  // namespace etude
