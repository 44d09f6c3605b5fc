#include "bench/tasks/transition/run.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "bench/metrics/speed_profile.h"
#include "bench/metrics/transition_body.h"
#include "bench/metrics/transition_join.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/outcome.h"
#include "engine/base/digest.h"
#include "engine/motion/body.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {

MatchTally TallyMatches(const Stage& stage, const TransitionRequest& request, const TransitionWay& way) {
  const TaggedClip &from = stage.library.tagged[request.from], &to = stage.library.tagged[request.to];
  const AllowedFrames allowed = way.choice->allowed(stage.library, request, way.choice_settings);
  MatchTally tally{.pairs = allowed.Pairs()};
  for (int leave : allowed.leave) {
    const BodyPose& left = stage.library.motions[request.from].poses[leave];
    for (int enter : allowed.enter) {
      if (!Matches(from, leave, to, enter, way.rules)) continue;
      ++tally.matching;
      const BodyPose& entered = stage.library.motions[request.to].poses[enter];
      tally.falsely_smooth += IsFalselySmooth(100 * PoseGap(left, entered)) ? 1 : 0;
    }
  }
  return tally;
}

namespace {

constexpr std::array kTransitionMetrics = {"jump_cm",
                                           "mean_joint_jump_cm",
                                           "rotation_step_change_deg",
                                           "jerk_peak_mps3",
                                           "natural_share",
                                           "pose_gap_cm",
                                           "velocity_gap_cmps",
                                           "false_smooth",
                                           "foot_slide_cmps",
                                           "sparc",
                                           "ldlj",
                                           "wait_s",
                                           "fuzzy_distance",
                                           "in_between",
                                           "settle_s",
                                           "strange_cm_s",
                                           "join_slide_cmps",
                                           "live",
                                           "unsupported_frames",
                                           "supported_share",
                                           "balance_cm",
                                           "skipped_s",
                                           "skipped_share",
                                           "calm_natural_share",
                                           kBodyRules[0].metric.data(),
                                           kBodyRules[1].metric.data(),
                                           kBodyRules[2].metric.data(),
                                           kBodyRules[3].metric.data(),
                                           kBodyRules[4].metric.data(),
                                           kBodyRules[5].metric.data(),
                                           kBodyRules[6].metric.data(),
                                           "clean_share",
                                           "clean_share_v3"};
constexpr std::array kMatchingMetrics = {"direct_match", "matching_share", "false_smooth_share"};

/// Returns the segments that played from the request until the wanted clip began.
std::vector<Stay> StaysOf(const TransitionRecord& record) {
  std::vector<Stay> stays;
  for (std::size_t i = 0; i + 1 < record.segments.size(); ++i)
    stays.push_back({record.segments[i].first, record.segments[i].last});
  return stays;
}

std::vector<int> PointFrames(const Splice& splice) {
  std::vector<int> frames;
  for (const PlacedPoint& point : splice.points) frames.push_back(point.frame);
  return frames;
}

/// Measures the motion at the transition points. Returns true if the transition is natural there.
bool ScorePoints(const TransitionOutcome& outcome, const Stage& stage, CellResult& result) {
  const Splice& splice = outcome.splice;
  const TransitionSmoothness smoothness = MeasureTransitions(splice.motion, PointFrames(splice));
  result.Measure("jump_cm", smoothness.jump_cm);
  result.Measure("mean_joint_jump_cm", smoothness.mean_joint_jump_cm);
  result.Measure("rotation_step_change_deg", smoothness.rotation_step_change_deg);
  result.Measure("jerk_peak_mps3", smoothness.jerk_peak_mps3);
  std::vector<double> nature = NaturalJumpsOf(stage, outcome.request.from, outcome.request.to);
  const bool natural = IsNatural(smoothness.jump_cm, std::move(nature));
  result.Measure("natural_share", natural ? 1 : 0);

  // Measure gaps and foot slide at the worst transition point.
  double pose_gap = 0, velocity_gap = 0, foot_slide = 0;
  for (const PlacedPoint& point : splice.points) {
    pose_gap = std::max(pose_gap, PoseGapCm(point.leaving, point.arriving));
    velocity_gap = std::max(velocity_gap, VelocityGapCmps(point.leaving_before, point.leaving, point.arriving,
                                                          point.arriving_after, splice.motion.rate_hz));
    foot_slide = std::max(foot_slide, FootSlideCmps(splice.motion, point.frame));
  }
  result.Measure("pose_gap_cm", pose_gap);
  result.Measure("velocity_gap_cmps", velocity_gap);
  if (outcome.matched) {
    result.Measure("false_smooth", IsFalselySmooth(pose_gap) ? 1 : 0);
  } else {
    result.Missing("false_smooth", "the method did not choose these frames by a match");
  }
  result.Measure("foot_slide_cmps", foot_slide);
  // Measure the smoothness of the joints' mean speed around the transition points, and the remaining metrics.
  const FrameWindow second = AroundPoints(splice, 1);
  const std::vector<double> speed = MeanJointSpeed(splice.motion, second.first, second.last);
  constexpr const char* kStill = "nothing moves around the transition point, or not long enough";
  result.MeasureOr("sparc", SpectralArcLength(speed, splice.motion.rate_hz), kStill);
  result.MeasureOr("ldlj", LogDimensionlessJerk(speed), kStill);
  result.Measure("wait_s", WaitSeconds(StaysOf(outcome.record), splice.motion.rate_hz));
  result.Measure("fuzzy_distance", WorstDistance(outcome.record).value);
  result.Measure("in_between", outcome.record.segments.size() > 2 ? 1 : 0);
  return natural;
}

SkippedStart SkippedOf(const TransitionOutcome& outcome, const Stage& stage) {
  const Segment& entered = outcome.record.segments.back();
  SkippedStart start{.entered_frame = {},
                     .frames = stage.library.tagged[entered.clip].FrameCount(),
                     .rate_hz = outcome.splice.motion.rate_hz};
  if (outcome.record.branch != Branch::kUnbroken) start.entered_frame = entered.first;
  return start;
}

/// Measures the whole join and compares it with both clips.
void ScoreJoin(const TransitionOutcome& outcome, const Stage& stage, bool natural, CellResult& result) {
  const JoinView view = ViewOf(outcome, stage);
  const double limit = CalmerLimitCm(stage, outcome.request.from, outcome.request.to);
  const std::vector<Support> support = JoinSupport(view);
  const SkippedStart skipped = SkippedOf(outcome, stage);
  const BodyMeasures body = MeasureBody(view, support);
  const CleanMeasures clean{.natural = natural,
                            .calmly_natural = IsCalmlyNatural(view, limit),
                            .supported = IsSupported(support),
                            .slide_cmps = JoinSlideCmps(view),
                            .strange_cm_s = StrangeCmSeconds(view, stage.real_frames),
                            .live = Liveness(view),
                            .own_slide_cmps = std::max(stage.natural_slides_cmps[outcome.request.from],
                                                       stage.natural_slides_cmps[outcome.request.to]),
                            .skipped_share = SkippedShare(skipped),
                            .settle_s = SettleSeconds(view),
                            .possible = IsPossible(body)};
  // Add each measure, and then the shares that combine measures.
  result.MeasureOr("settle_s", clean.settle_s, "the wanted clip was never reached");
  result.Measure("strange_cm_s", clean.strange_cm_s);
  result.Measure("join_slide_cmps", clean.slide_cmps);
  result.Measure("live", clean.live);
  result.Measure("unsupported_frames", UnsupportedFrames(support));
  result.Measure("supported_share", clean.supported ? 1 : 0);
  result.MeasureOr("balance_cm", BalanceCm(view, support), "the body has no support");
  result.Measure("skipped_s", SkippedSeconds(skipped));
  result.Measure("skipped_share", clean.skipped_share);
  result.Measure("calm_natural_share", clean.calmly_natural ? 1 : 0);
  for (std::size_t i = 0; i < body.size(); ++i) {
    result.MeasureOr(std::string(kBodyRules[i].metric), body[i], std::string(kBodyRules[i].unmet));
  }
  result.Measure("clean_share", IsClean(clean) ? 1 : 0);
  result.Measure("clean_share_v3", IsCleanByVersion3(clean) ? 1 : 0);
}

}  // namespace

void ScoreTransition(const TransitionOutcome& outcome, const Stage& stage, CellResult& result) {
  const bool natural = ScorePoints(outcome, stage, result);
  ScoreJoin(outcome, stage, natural, result);
}

void ScoreMatching(const std::optional<MatchTally>& tally, CellResult& result) {
  if (!tally) {
    for (const char* id : kMatchingMetrics) result.Missing(id, "this method matches no frames by a threshold");
    return;
  }
  result.Measure("direct_match", HasDirectMatch(*tally) ? 1 : 0);
  result.MeasureOr("matching_share", MatchingShare(*tally), "no pair of frames could be compared");
  result.MeasureOr("false_smooth_share", FalseSmoothShare(*tally), "no pair matches");
}

std::vector<std::string> TransitionMetrics() {
  std::vector<std::string> ids(kTransitionMetrics.begin(), kTransitionMetrics.end());
  ids.insert(ids.end(), kMatchingMetrics.begin(), kMatchingMetrics.end());
  return ids;
}

std::optional<double> TransitionFailureValue(std::string_view metric) {
  constexpr std::array kShares = {"natural_share", "calm_natural_share", "supported_share", "clean_share",
                                  "clean_share_v3"};
  return std::ranges::find(kShares, metric) != kShares.end() ? std::optional(0.0) : std::nullopt;
}

void MeasureNoWay(CellResult& result) {
  for (const char* id : kTransitionMetrics) {
    const std::optional<double> value = TransitionFailureValue(id);
    value ? result.Measure(id, *value) : result.Missing(id, "no transition was found");
  }
}

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
  for (const TransitionMethod& method : basis_.methods) WeightsOf(method.weights);  // learn and cache the weights
}

CellResult TransitionRun::Run(std::size_t index) {
  const TransitionMethod& method = basis_.methods[index];
  TransitionRequest request = *request_;
  request.budget_s = method.wait_s;
  TransitionWay way = method.way;
  way.rules.weights = WeightsOf(method.weights);
  Transition made = MakeTransition(basis_.stage.library, request, way);
  // A forced transition takes the pair of frames with the smallest distance, although no pair matches.
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
  return NaturalLimitPayload(basis_.stage, *request_);
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
