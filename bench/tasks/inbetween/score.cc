#include "bench/tasks/inbetween/score.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/metrics/alignment.h"
#include "bench/metrics/transition_body.h"
#include "bench/metrics/transition_smoothness.h"
#include "bench/model/recording.h"
#include "bench/recordings/evaluation_extras.h"
#include "engine/base/digest.h"
#include "engine/base/order_statistics.h"
#include "engine/fuzzy/features.h"
#include "engine/motion/support.h"
#include "sim/choreography/judged_proportions.h"

namespace etude {
namespace {

/// The positions and rotations of the joints in the world's frame, for several frames.
struct Globals {
  std::size_t joints = 0;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dquat> turns;
};

Globals GlobalsOf(const JointTree& tree, std::span<const TreePose> poses) {
  Globals globals{tree.size(), {}, {}};
  for (const TreePose& pose : poses) AppendGlobals(tree, pose, globals.positions, globals.turns);
  return globals;
}

std::size_t JudgedCount(const JointTree& tree) {
  return static_cast<std::size_t>(std::ranges::count(tree.is_point, false));
}

/// Returns the values of the frames `first` to `last`. Points without a rotation are left out.
template <typename Value>
std::vector<Value> JudgedFrames(const std::vector<Value>& values, const JointTree& tree, int first, int last) {
  std::vector<Value> judged;
  for (std::size_t i = static_cast<std::size_t>(first) * tree.size();
       i < static_cast<std::size_t>(last + 1) * tree.size(); ++i) {
    if (!tree.is_point[i % tree.size()]) judged.push_back(values[i]);
  }
  return judged;
}

/// Returns the joint of a role or, if the file lacks it, of the next role towards the hip centre that the file has.
int JointOf(const std::array<int, kRoleCount>& roles, Role role) {
  for (std::optional<Role> at = role; at; at = ParentOf(*at)) {
    if (roles[Index(*at)] >= 0) return roles[Index(*at)];
  }
  return 0;
}

/// Returns the twenty joints of each frame, with heights above the floor, scaled. A joint that the file lacks is put at
/// its parent.
std::vector<BodyPose> BodiesOf(const Globals& globals, const std::array<int, kRoleCount>& roles, double floor_m,
                               double scale = 1) {
  std::vector<BodyPose> bodies;
  for (std::size_t at = 0; at < globals.positions.size(); at += globals.joints) {
    BodyPose& body = bodies.emplace_back();
    for (const Role role : AllRoles()) {
      body[role] = globals.positions[at + static_cast<std::size_t>(JointOf(roles, role))];
      body[role].y -= floor_m;
      body[role] *= scale;
    }
  }
  return bodies;
}

std::string DigestOf(std::span<const glm::dvec3> positions) {
  return Digest().Add(std::span(&positions.front().x, 3 * positions.size())).Hex();
}

/// Returns global rotations as channels: w, x, y, z of each joint. Quaternions keep the signs that they have as
/// products of local quaternions, as in LAFAN1's code.
ChannelTracks ChannelsOf(const std::vector<glm::dquat>& turns, std::size_t joints) {
  ChannelTracks tracks{4 * joints, {}};
  for (const glm::dquat& q : turns) tracks.values.insert(tracks.values.end(), {q.w, q.x, q.y, q.z});
  return tracks;
}

/// Measures L2P, L2Q and NPSS of LAFAN1's code, and the mean joint error.
void MeasureDistances(const HiddenWindow& hidden, const Globals& found, const Globals& truth, CellResult& result) {
  const auto part = [&](const auto& values) {
    return JudgedFrames(values, hidden.motion.tree, hidden.first, hidden.last);
  };
  const std::size_t joints = JudgedCount(hidden.motion.tree);
  EvaluatedPair pair;
  pair.found = {joints, part(found.positions)};
  pair.truth = {joints, part(truth.positions)};
  // Measure L2P: the distance of positions that are divided by their standard deviations in the training set.
  const auto deviations = JudgedFrames(hidden.deviations, hidden.motion.tree, 0, hidden.deviations.empty() ? -1 : 0);
  const bool all_move =
      std::ranges::none_of(deviations, [](const glm::dvec3& one) { return one.x <= 0 || one.y <= 0 || one.z <= 0; });
  std::optional<double> l2p;
  if (!deviations.empty() && all_move) {
    const std::vector<glm::dvec3> means(joints);  // equal means cancel in the difference
    l2p = MeanChannelDistance(StandardisedChannels(pair.found.positions, means, deviations),
                              StandardisedChannels(pair.truth.positions, means, deviations));
  }
  result.MeasureOr(
      "l2p@lafan1", l2p,
      all_move ? "no training clip is as long as a training window" : "a coordinate never moves in training");
  // Measure the distance and the spectrum of the rotations (L2Q and NPSS).
  const ChannelTracks true_turns = ChannelsOf(part(truth.turns), joints);
  const ChannelTracks found_turns = ChannelsOf(part(found.turns), joints);
  result.MeasureOr("l2q@lafan1", MeanChannelDistance(found_turns, true_turns), "");
  const auto npss = MeasurePowerSpectrum(found_turns, true_turns, true_turns.FrameCount(), PowerOf::kRealPart);
  result.MeasureOr("npss@lafan1", npss ? std::optional(npss->value) : std::nullopt, "the truth has no power");
  result.MeasureOr("npss_power@lafan1", npss ? std::optional(npss->power) : std::nullopt, "the truth has no power");
  // Measure the positions in millimetres, without alignment.
  const FrameFits none{{Similarity{}}, pair.found.FrameCount()};
  result.MeasureOr("mpjpe_unaligned_mm", MeanJointErrorMm(pair, none), "");
}

/// Returns the reason why `clean_share` cannot be measured; "" if it can.
std::string WhyNotClean(const HiddenWindow& hidden) {
  if (hidden.motion.rate_hz != kJudgedRateHz) return fmt::format("the rate is not {:g} Hz", kJudgedRateHz);
  for (const Role role : AllRoles()) {
    if (role == Role::kLeftHand || role == Role::kRightHand) continue;  // a missing hand is placed at the wrist
    if (hidden.roles[Index(role)] < 0) return fmt::format("the file has no {}", RoleName(role));
  }
  return "";
}

/// Returns true if the filled gap passes all tests of a clean transition (clean_share). The true motion takes the
/// place of both clips of the transition, and the real frames of StrangeCmSeconds are all frames of its file. The
/// test of `settle_s` always passes, because the gap's length is given.
bool IsCleanFilling(const HiddenWindow& hidden, const Globals& found, const Globals& truth) {
  const JudgedFile& file = *hidden.file;
  const std::vector<BodyPose> shown = BodiesOf(found, hidden.roles, file.floor_m, file.scale);
  const std::vector<BodyPose> own = BodiesOf(truth, hidden.roles, file.floor_m, file.scale);
  const SupportingClip clip{.poses = own};
  const double rate_hz = hidden.motion.rate_hz;
  const auto support = FindSupport(shown, std::span(&clip, 1), hidden.first, hidden.last, rate_hz);
  const int after = hidden.last + 1;
  const JoinView view{.shown = shown,
                      .left = own,
                      .wanted = std::span<const BodyPose>(own).subspan(static_cast<std::size_t>(after)),
                      .request = hidden.first,
                      .first = hidden.first,
                      .last = after,
                      .rate_hz = rate_hz};
  const std::array ends = {hidden.first - 1, after};
  return IsClean({.natural = IsNatural(MeasureTransitions({rate_hz, shown}, ends).jump_cm, file.natural_jumps_cm),
                  .calmly_natural = IsCalmlyNatural(view, NaturalLimitCm(file.natural_jumps_cm)),
                  .supported = IsSupported(support),
                  .slide_cmps = FootSlideCmps(shown, hidden.first - 1, after, rate_hz),
                  .strange_cm_s = StrangeCmSeconds(view, file.frames),
                  .live = Liveness(view),
                  .own_slide_cmps = file.own_slide_cmps,
                  .settle_s = 0,
                  .possible = IsPossible(MeasureBody(view, support))});
}

/// Measures if a body could move as in the filled gap: support, foot slide, jitter, and all parts of `clean_share`.
void MeasureMovement(const HiddenWindow& hidden, const Globals& found, const Globals& truth, CellResult& result) {
  using enum Role;
  const std::vector<BodyPose> shown = BodiesOf(found, hidden.roles, hidden.file->floor_m);
  const std::vector<BodyPose> own = BodiesOf(truth, hidden.roles, hidden.file->floor_m);
  const SupportingClip clip{.poses = own};
  const auto has = [&](Role role) { return hidden.roles[Index(role)] >= 0; };
  const bool has_legs = has(kLeftKnee) && has(kLeftAnkle) && has(kRightKnee) && has(kRightAnkle);
  std::optional<double> supported, slide;
  if (has_legs) {
    supported = IsSupported(FindSupport(shown, std::span(&clip, 1), hidden.first, hidden.last, hidden.motion.rate_hz));
  }
  if (has(kLeftFoot) && has(kRightFoot)) {
    slide = FootSlideCmps(shown, hidden.first - 1, hidden.last + 1, hidden.motion.rate_hz);
  }
  result.MeasureOr("supported_share", supported, "the file has no legs");
  result.MeasureOr("foot_slide_cmps", slide, "the file has no toes");
  constexpr int kReach = 3;  // number of earlier frames in a third difference (jerk)
  const std::size_t joints = JudgedCount(hidden.motion.tree);
  const PointTracks around{
      joints, JudgedFrames(found.positions, hidden.motion.tree, hidden.first - kReach, hidden.last + kReach)};
  result.MeasureOr("jitter@wham", Jitter(around, hidden.motion.rate_hz), "");
  const std::string unmet = WhyNotClean(hidden);
  result.MeasureOr("clean_share",
                   unmet.empty() ? std::optional(IsCleanFilling(hidden, found, truth) ? 1.0 : 0.0) : std::nullopt,
                   unmet);
}

Recording RecordingOf(const HiddenWindow& hidden, const Globals& found, const Globals& truth) {
  EvaluationExtras extras;
  extras.truth.rate_hz = hidden.motion.rate_hz;
  extras.truth.joints = hidden.motion.tree.names;
  // Name the joints by their roles, because readers of clips look for these names.
  for (const Role role : AllRoles()) {
    if (hidden.roles[Index(role)] >= 0)
      extras.truth.joints[static_cast<std::size_t>(hidden.roles[Index(role)])] = RoleName(role);
  }
  extras.truth.parents = hidden.motion.tree.parents;
  extras.answer = extras.truth;
  extras.truth.positions = truth.positions;
  extras.answer.positions = found.positions;
  return {{}, WriteEvaluationExtras(extras)};
}

}  // namespace

std::vector<std::string> InbetweenMetrics() {
  return {"l2p@lafan1",      "l2q@lafan1",      "npss@lafan1", "npss_power@lafan1", "mpjpe_unaligned_mm",
          "supported_share", "foot_slide_cmps", "jitter@wham", "clean_share"};
}

std::shared_ptr<const JudgedFile> JudgeFile(const HiddenWindow& whole) {
  auto file = std::make_shared<JudgedFile>();
  const Globals globals = GlobalsOf(whole.motion.tree, whole.motion.poses);
  // Estimate the height of the floor.
  std::vector<double> lowest;
  for (const BodyPose& body : BodiesOf(globals, whole.roles, 0)) {
    double& height = lowest.emplace_back(body[Role::kHead].y);
    for (const Role role : AllRoles()) {
      if (role != Role::kLeftHand && role != Role::kRightHand) height = std::min(height, body[role].y);
    }
  }
  constexpr double kShare = 0.05;
  file->floor_m = LowerPercentile(std::move(lowest), kShare);
  if (!WhyNotClean(whole).empty()) return file;
  // Scale the body to the size at which transitions are judged.
  BodyMotion motion{whole.motion.rate_hz, BodiesOf(globals, whole.roles, file->floor_m)};
  file->scale = JudgedProportions().standing_hip_height / StandingHipHeight(motion.poses.front());
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint *= file->scale;
  }
  file->natural_jumps_cm = NaturalJumpsCm(motion);
  file->own_slide_cmps = FootSlideCmps(motion.poses, 0, static_cast<int>(motion.poses.size()) - 1, motion.rate_hz);
  file->frames = RealFrames(std::span(&motion, 1));
  return file;
}

CellResult ScoreFilling(const HiddenWindow& hidden, std::span<const TreePose> filled, bool keeps_motion) {
  std::vector<TreePose> shown = hidden.motion.poses;
  for (std::size_t f = 0; f < filled.size(); ++f) {
    const std::size_t at = static_cast<std::size_t>(hidden.first) + f;
    shown[at] = filled[f];
    // For each quaternion, choose the sign that is nearer to the quaternion in the previous frame.
    for (std::size_t j = 0; j < filled[f].turns.size(); ++j) {
      glm::dquat& turn = shown[at].turns[j];
      if (glm::dot(turn, shown[at - 1].turns[j]) < 0) turn = -turn;
    }
  }
  const Globals truth = GlobalsOf(hidden.motion.tree, hidden.motion.poses),
                found = GlobalsOf(hidden.motion.tree, shown);
  CellResult result = CellResult::Ended(Status::kOk, "");
  result.digests = {{"truth", DigestOf(truth.positions)}, {"answer", DigestOf(found.positions)}};
  MeasureDistances(hidden, found, truth, result);
  MeasureMovement(hidden, found, truth, result);
  if (keeps_motion) result.recording = RecordingOf(hidden, found, truth);
  return result;
}

}  // namespace etude
