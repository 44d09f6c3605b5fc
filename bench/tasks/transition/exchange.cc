#include "bench/tasks/transition/exchange.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/metrics/transition_smoothness.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "engine/formats/bvh.h"
#include "engine/motion/from_body.h"

namespace etude {
namespace {

constexpr std::size_t kMostBetween = 300;  // ten seconds
constexpr std::size_t kMostThrough = 16;
constexpr std::size_t kLongestExcuse = 300;
constexpr Range kJoins_s{0, 5};
constexpr double kLimbTolerance = 0.02;  // metres

Result<void> CheckLimbs(const BodyPose& pose, const BodyProportions& character, const std::string& path) {
  for (const Bone& bone : AllBones()) {
    const double length = BoneLength(pose, bone), own = character.limb_lengths[Index(bone.child)];
    if (std::abs(length - own) <= kLimbTolerance) continue;
    return Fail({}, "{}: {} is {:.3f} m from {}; allowed: {:.3f} m ± {:g}, the character's", path, RoleName(bone.child),
                length, RoleName(bone.parent), own, kLimbTolerance);
  }
  return {};
}

/// A pose that the character can take; complaints go to `fields`.
BodyPose ReadOwnPose(const Json& json, const std::string& path, const BodyProportions& character,
                     AnswerFields& fields) {
  const auto pose = ReadPose(json, path);
  const auto fits = pose ? CheckLimbs(*pose, character, path) : tl::unexpected(pose.error());
  if (!fits) fields.Note(fits.error());
  return pose.value_or(BodyPose{});
}

/// Frames of the method's own making. Frame 0 of the segment is its version of the frame left, which is not shown.
std::optional<Segment> ReadBetween(AnswerFields& fields, const BodyProportions& character) {
  const Json& entries = fields.List("between", 0, kMostBetween);
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

/// The clips played on the way.
void ReadThrough(AnswerFields& fields, const Stage& stage, std::vector<Segment>& segments) {
  const Json& entries = fields.List("through", 0, kMostThrough);
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
  const int last_of_from = stage.library.tagged[request.from].FrameCount() - 1;
  const int last_of_to = stage.library.tagged[request.to].FrameCount() - 1;
  const int left = fields.Integer("leave_frame", request.request_frame, last_of_from);
  answer.segments.push_back({.clip = request.from, .first = request.request_frame, .last = left, .own = {}});
  ReadThrough(fields, stage, answer.segments);
  const int entered = fields.Integer("enter_frame", 0, last_of_to - 1);  // a frame must follow
  std::optional<Segment> between = ReadBetween(fields, stage.library.proportions);
  if (between && answer.segments.size() > 1) fields.Note({{}, "through: not together with 'between'"});
  if (between) answer.segments.push_back(*std::move(between));
  answer.segments.push_back({.clip = request.to, .first = entered, .last = last_of_to, .own = {}});
  answer.join = FindJoin(fields.Choice("join", JoinNames(), JoinNames().front()));
  if (fields.Has("join_s")) {
    answer.segments.back().preferred = PreferredJoin{.blend_s = fields.Number("join_s", kJoins_s)};
    answer.segments.back().preferred->fades = fields.Boolean("fades", false);
  }
  answer.matched = fields.Boolean("matched", false);
  return answer;
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

Payload NaturePayload(const Stage& stage, const TransitionRequest& request) {
  const double limit = NaturalLimitCm(NaturalJumpsOf(stage, request.from, request.to));
  return PayloadOf({{"natural_limit_cm", limit}});
}

Result<TransitionAnswer> ReadTransitionAnswer(const Json& answer, const Stage& stage,
                                              const TransitionRequest& request) {
  AnswerFields fields(answer);
  TransitionAnswer read;
  if (fields.Has("unsolved")) {
    read.unsolved = fields.Text("unsolved", kLongestExcuse);
  } else {
    read = ReadTransition(fields, stage, request);
  }
  RETURN_IF_ERROR(fields.Finish());
  return read;
}

}  // namespace etude
