#include "bench/tasks/transition/run.h"

#include <algorithm>
#include <iterator>

#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/tally.h"
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

std::string KeysDigest(const InBetweenNet& net) {
  Digest digest;
  for (const InBetweenNet::Key& key : net.keys) digest.Add(std::int64_t{key.clip}).Add(std::int64_t{key.frame});
  return digest.Hex();
}

std::string TransitionDigest(const TransitionRecord& record) {
  Digest digest;
  for (const Segment& segment : record.segments)
    digest.Add(std::int64_t{segment.clip}).Add(std::int64_t{segment.first}).Add(std::int64_t{segment.last});
  for (const FuzzyDistance& distance : record.distances) digest.Add(distance.value);
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

TransitionRun::TransitionRun(const TransitionBasis& basis, Result<TransitionRequest> request, bool keeps_motion)
    : basis_(basis), request_(std::move(request)), keeps_motion_(keeps_motion) {
  if (!request_) return;
  const TaggedClip &from = basis_.stage.library.tagged[request_->from], &to = basis_.stage.library.tagged[request_->to];
  stage_digests_ = {{"features", GradesDigest(from, to)},
                    {"bridge_frames", BridgeFramesDigest(from, to)},
                    {"in_between_keys", KeysDigest(basis_.stage.library.in_betweens)}};
}

std::optional<std::string> TransitionRun::WhySkipped() const {
  return request_ ? std::nullopt : std::optional(request_.error().message);
}

void TransitionRun::PrepareShared() {
  for (const TransitionMethod& method : basis_.methods) WeightsOf(method.weights);  // learnt once, then remembered
}

CellResult TransitionRun::Run(std::size_t index) {
  const TransitionMethod& method = basis_.methods[index];
  TransitionRequest request = *request_;
  request.budget_s = method.wait_s;
  TransitionWay way = method.way;
  way.rules.weights = WeightsOf(method.weights);
  Transition made = MakeTransition(basis_.stage.library, request, way);
  // A forced way takes what is nearest, although no frames match.
  CellResult result = Score({.request = request,
                             .matched = way.choice->matches_poses && made.record.branch != Branch::kForced,
                             .rules = way.rules,
                             .record = std::move(made.record),
                             .splice = std::move(made.splice)});
  std::optional<MatchTally> tally;
  if (way.choice->uses_fuzzy) tally = TallyMatches(basis_.stage, request, way);
  ScoreMatching(tally, result);
  return result;
}

Result<Payload> TransitionRun::MakeProblem() {
  if (!request_) return tl::unexpected(request_.error());
  return RequestPayload(*request_, basis_.max_wait_s);
}

Result<Payload> TransitionRun::MakeTruth() {
  if (!request_) return tl::unexpected(request_.error());
  return NaturePayload(basis_.stage, *request_);
}

Result<CellResult> TransitionRun::Judge(const Json& answer) {
  if (!request_) return tl::unexpected(request_.error());
  ASSIGN_OR_RETURN(const auto read, ReadTransitionAnswer(answer, basis_.stage, *request_));
  TransitionOutcome outcome;
  if (read.unsolved) {
    outcome.rules.weights = basis_.stage.fuzzy.weights;
    outcome.record.why = *read.unsolved;
  } else {
    outcome = FollowAnswer(read, basis_.stage, *request_);
  }
  CellResult result = Score(outcome);
  ScoreMatching(std::nullopt, result);
  return result;
}

const FeatureWeights& TransitionRun::WeightsOf(WeightSource source) const {
  const std::vector<std::string>& identities = basis_.stage.identities;
  return basis_.learnt.For(source, identities[request_->from], identities[request_->to]);
}

CellResult TransitionRun::Score(const TransitionOutcome& outcome) const {
  CellResult result = CellResult::Ended(Status::kOk, "");
  result.digests = stage_digests_;
  result.digests.emplace_back("weights", Digest().Add(std::span<const double>(outcome.rules.weights)).Hex());
  result.digests.emplace_back("transition", TransitionDigest(outcome.record));
  result.digests.emplace_back("motion", MotionDigest(outcome.splice.motion));
  if (outcome.record.segments.empty()) {
    result.status = Status::kUnsolved;
    result.reason = outcome.record.why;
    MeasureNoWay(result);
    return result;
  }
  ScoreTransition(outcome, basis_.stage, result);
  result.series.push_back(JumpSeries(outcome));
  if (basis_.explain) std::ranges::move(ExplanationOf(outcome.record), std::back_inserter(result.series));
  if (keeps_motion_) result.recording = RecordTransition(outcome, basis_.stage);
  return result;
}

}  // namespace etude
