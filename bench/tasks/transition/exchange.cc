#include "bench/tasks/transition/exchange.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/metrics/seam.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/transition/options.h"
#include "engine/formats/bvh.h"
#include "engine/motion/from_body.h"

namespace etude {
namespace {

constexpr std::size_t kMostBetween = 300;  // ten seconds
constexpr std::size_t kMostThrough = 16;
constexpr std::size_t kLongestExcuse = 300;
constexpr double kLimbTolerance = 0.02;  // metres

Result<void> CheckLimbs(const BodyPose& pose, const Physique& character, const std::string& path) {
  for (const Bone& bone : AllBones()) {
    const double length = BoneLength(pose, bone), own = character.limb_lengths[Index(bone.child)];
    if (std::abs(length - own) <= kLimbTolerance) continue;
    return Fail({}, "{}: {} is {:.3f} m from {}; allowed: {:.3f} m ± {:g}, the character's", path, RoleName(bone.child),
                length, RoleName(bone.parent), own, kLimbTolerance);
  }
  return {};
}

std::vector<BodyPose> ReadBetween(AnswerFields& fields, const Physique& character) {
  std::vector<BodyPose> poses;
  for (const Json& entry : fields.List("between", 0, kMostBetween)) {
    const std::string path = fields.PathOf("between", poses.size());
    const auto pose = ReadPose(entry, path);
    const auto fits = pose ? CheckLimbs(*pose, character, path) : tl::unexpected(pose.error());
    if (!fits) {
      fields.Note(fits.error());
      return {};
    }
    poses.push_back(*pose);
  }
  return poses;
}

/// The clips played on the way: each switch into one of them ends in where it is left.
void ReadThrough(AnswerFields& fields, const Stage& stage, std::vector<Switch>& switches) {
  const Json& entries = fields.List("through", 0, kMostThrough);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    AnswerFields entry(entries[i], fields.PathOf("through", i));
    const int clip = entry.Integer("clip", 0, static_cast<int>(stage.tagged.size()) - 1);
    const int last = stage.tagged[clip].FrameCount() - 1;
    switches.back().to_clip = clip;
    switches.back().to_frame = entry.Integer("enter_frame", 0, last - 1);
    switches.push_back({.from_clip = clip, .distance = {}});
    switches.back().from_frame = entry.Integer("leave_frame", switches.end()[-2].to_frame + 1, last);
    if (auto done = entry.Finish(); !done) fields.Note(done.error());
  }
}

SwitchAnswer ReadSwitch(AnswerFields& fields, const Stage& stage, const SwitchRequest& request) {
  SwitchAnswer answer;
  const int last_of_from = stage.tagged[request.from].FrameCount() - 1;
  const int last_of_to = stage.tagged[request.to].FrameCount() - 1;
  answer.switches.push_back({.from_clip = request.from, .distance = {}});
  answer.switches.back().from_frame = fields.Integer("leave_frame", request.request_frame, last_of_from);
  ReadThrough(fields, stage, answer.switches);
  answer.switches.back().to_clip = request.to;
  answer.switches.back().to_frame = fields.Integer("enter_frame", 0, last_of_to - 1);  // a frame must follow
  answer.between = ReadBetween(fields, stage.character);
  answer.join = JoinOf(fields.Choice("join", JoinNames(), JoinNames().front()));
  answer.matched = fields.Boolean("matched", false);
  if (!answer.between.empty()) {
    if (answer.switches.size() > 1) fields.Note({{}, "through: not together with 'between'"});
    if (answer.join != Join::kCut) fields.Note({{}, "join: only 'cut' together with 'between'"});
  }
  return answer;
}

}  // namespace

Exhibit ExhibitStage(const Stage& stage) {
  Exhibit setting{std::make_unique<Json>(Json{{"rate_hz", kJudgedRateHz}}), {}};
  setting.json->update(DescribeBody());
  Json& clips = (*setting.json)["clips"] = Json::array();
  for (std::size_t clip = 0; clip < stage.names.size(); ++clip) {
    const std::string file = fmt::format("clip-{}.bvh", clip);
    const BodyMotion& motion = stage.motions[clip];
    clips.push_back({{"name", stage.names[clip]}, {"poses", EncodePoses(motion.poses)}, {"file", file}});
    setting.files.push_back({file, WriteBvh(ToClip(motion, stage.names[clip]))});
  }
  return setting;
}

Exhibit ExhibitRequest(const SwitchRequest& request, double max_wait_s) {
  const Json json = {
      {"from", request.from}, {"to", request.to}, {"request_frame", request.request_frame}, {"max_wait_s", max_wait_s}};
  return {std::make_unique<Json>(json), {}};
}

Exhibit ExhibitNature(const Stage& stage, const SwitchRequest& request) {
  const double limit = NaturalLimitCm(NaturalJumpsOf(stage, request.from, request.to));
  return {std::make_unique<Json>(Json{{"natural_limit_cm", limit}}), {}};
}

Result<SwitchAnswer> ReadSwitchAnswer(const Json& answer, const Stage& stage, const SwitchRequest& request) {
  AnswerFields fields(answer);
  SwitchAnswer read;
  if (fields.Has("unsolved")) {
    read.unsolved = fields.Text("unsolved", kLongestExcuse);
  } else {
    read = ReadSwitch(fields, stage, request);
  }
  if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
  return read;
}

}  // namespace etude
