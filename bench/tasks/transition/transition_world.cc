#include "bench/tasks/transition/transition_world.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/follow.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

std::string GradesDigest(const TaggedClip& from, const TaggedClip& to) {
  Digest digest;
  for (const TaggedClip* clip : {&from, &to}) {
    for (const Grades& grades : clip->grades) digest.Add(std::span<const double>(grades));
  }
  return digest.Hex();
}

std::string BridgeFramesDigest(const TaggedClip& from, const TaggedClip& to) {
  Digest digest;
  for (const TaggedClip* clip : {&from, &to}) {
    for (int frame : clip->bridge_frames) digest.Add(std::int64_t{frame});
  }
  return digest.Hex();
}

std::string SwitchesDigest(const SwitchRecord& record) {
  Digest digest;
  for (const Leg& leg : record.legs)
    digest.Add(std::int64_t{leg.clip}).Add(std::int64_t{leg.first}).Add(std::int64_t{leg.last});
  for (const FuzzyDistance& meeting : record.meetings) digest.Add(meeting.value);
  return digest.Hex();
}

std::string MotionDigest(const BodyMotion& motion) {
  Digest digest;
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
  }
  return digest.Hex();
}

}  // namespace

TransitionWorld::TransitionWorld(const TransitionBasis& basis, Result<SwitchRequest> request, bool keeps_motion)
    : basis_(basis), request_(std::move(request)), keeps_motion_(keeps_motion) {
  if (!request_) return;
  const TaggedClip &from = basis_.stage.library.tagged[request_->from], &to = basis_.stage.library.tagged[request_->to];
  clip_digests_ = {{"features", GradesDigest(from, to)}, {"bridge_frames", BridgeFramesDigest(from, to)}};
}

std::optional<std::string> TransitionWorld::WhySkipped() const {
  return request_ ? std::nullopt : std::optional(request_.error().message);
}

CellResult TransitionWorld::Run(std::size_t method) {
  const SwitchOutcome outcome = Switch(basis_.methods[method]);
  CellResult result = Score(outcome);
  if (result.status == Status::kUnsolved) result.reason = WhyNoWay(basis_.methods[method], outcome.record);
  return result;
}

Result<Exhibit> TransitionWorld::MakeProblem() {
  if (!request_) return tl::unexpected(request_.error());
  return ExhibitRequest(*request_, basis_.max_wait_s);
}

Result<Exhibit> TransitionWorld::MakeTruth() {
  if (!request_) return tl::unexpected(request_.error());
  return ExhibitNature(basis_.stage, *request_);
}

Result<CellResult> TransitionWorld::Judge(const Json& answer) {
  if (!request_) return tl::unexpected(request_.error());
  const auto read = ReadSwitchAnswer(answer, basis_.stage, *request_);
  if (!read) return tl::unexpected(read.error());
  if (!read->unsolved) return Score(FollowAnswer(*read, basis_.stage, *request_));
  CellResult result = Score({.weights = PaperWeights(), .record = {}, .splice = {}});
  result.reason = *read->unsolved;
  return result;
}

SwitchOutcome TransitionWorld::Switch(const TransitionMethod& method) const {
  const Stage& stage = basis_.stage;
  SwitchMethod way = method.way;
  if (method.adaptive_weights) {
    way.rules.weights =
        basis_.adaptive.Without(stage.identities[request_->from], stage.identities[request_->to]).weights;
  }
  SwitchRequest request = *request_;
  request.budget_s = method.wait_s;
  SwitchResult result = SwitchClips(stage.library, request, way);
  return {.matched = way.choice->matches_poses,
          .weights = way.rules.weights,
          .record = std::move(result.record),
          .splice = std::move(result.splice)};
}

CellResult TransitionWorld::Score(const SwitchOutcome& outcome) const {
  CellResult result = CellResult::Ended(Status::kOk, "");
  result.digests = clip_digests_;
  result.digests.emplace_back("weights", Digest().Add(std::span<const double>(outcome.weights)).Hex());
  result.digests.emplace_back("switches", SwitchesDigest(outcome.record));
  result.digests.emplace_back("motion", MotionDigest(outcome.splice.motion));
  if (outcome.record.legs.empty()) {
    result.status = Status::kUnsolved;
    MeasureNoWay(result);
    return result;
  }
  ScoreSwitch(outcome, basis_.stage, result);
  result.series.push_back(SeamSeries(outcome));
  if (keeps_motion_) result.recording = RecordSwitch(outcome, basis_.stage);
  return result;
}

std::string TransitionWorld::WhyNoWay(const TransitionMethod& method, const SwitchRecord& record) const {
  const std::string when = fmt::format("within {:g} s of the request", method.wait_s);
  const std::string &from = basis_.stage.library.names[request_->from], &to = basis_.stage.library.names[request_->to];
  if (record.pairs_seen == 0) return fmt::format("{} has no bridge frame {}", from, when);
  return fmt::format("no bridge frame of {} {} matches one of {}, directly or through a third clip ({} pairs compared)",
                     from, when, to, record.pairs_seen);
}

}  // namespace etude
