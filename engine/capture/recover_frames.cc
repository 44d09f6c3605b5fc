#include "engine/capture/recover_frames.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

using enum Role;

/// The pose from which inverse kinematics starts in one frame, made from the joints in the pictures.
struct Start {
  BodyPose fixed;                 ///< joints with the body's limb lengths
  std::optional<TreeState> seen;  ///< the same pose as angles, if it has been found
};

std::optional<Start> PaperStart(const CaptureBody& body, const LimbObservation& seen) {
  const std::optional<BodyPose> fixed = FixLimbLengths(seen, body.lengths);
  if (!fixed) return std::nullopt;
  return Start{*fixed, FindStartState(body.tree, *fixed, body.tree.limits)};
}

// Computes target positions of the joints and of the midpoint of the hips, by following the observed limb directions
// inwards from every end effector (paper B, figure 3.2(a)).
PoseTargets TargetsFromEnds(const CaptureBody& body, const LimbObservation& seen) {
  constexpr double kUnseen = 0.01;  // weight of positions that depend on a lacking end or direction
  constexpr double kBent = 0.1;     // weight of positions beyond a joint whose bend is not observed
  PoseTargets wanted;
  for (const Role end : {kLeftFoot, kRightFoot, kLeftHand, kRightHand, kHead}) {
    glm::dvec3 position = seen.ends[end];
    double weight = seen.lacks_end[Index(end)] ? kUnseen : 1;
    Role role = end;
    // Follow the chain of limbs from the end inwards, up to the first limb that is not in `ObservedLimbs()`.
    while (true) {
      wanted.places[role] = position;
      wanted.weights[Index(role)] = weight;
      if (std::ranges::find(ObservedLimbs(), role) == ObservedLimbs().end()) break;
      if (!body.is_rigid[Index(role)]) weight = std::min(weight, kBent);
      if (seen.lacks_direction[Index(role)]) weight = kUnseen;
      position -= body.bones[Index(role)] * glm::normalize(seen.directions[Index(role)]);
      role = *ParentOf(role);
    }
  }
  wanted.places[kHipCentre] = 0.5 * (wanted.places[kLeftHip] + wanted.places[kRightHip]);
  wanted.weights[Index(kLeftFoot)] = 1;
  return wanted;
}

std::optional<Start> FittedStart(const CaptureBody& body, const PoseFitter& fitter, const LimbObservation& seen,
                                 std::optional<PoseFit>& last) {
  std::optional<PoseFit> found = fitter.Fit(TargetsFromEnds(body, seen), last);
  if (!found) return std::nullopt;
  last = std::move(found);
  return Start{ToBodyPose(body, last->state), last->state};
}

// Returns the errors of the end effectors that were seen.
std::vector<EffectorError> ErrorsSeen(const CaptureBody& body, const LimbObservation& seen,
                                      const std::vector<EffectorError>& errors) {
  std::vector<EffectorError> kept;
  for (std::size_t e = 0; e < errors.size(); ++e) {
    if (body.ends[e].has_position && !seen.lacks_end[Index(body.ends[e].role)]) kept.push_back(errors[e]);
  }
  return kept;
}

/// Returns the pose at which the solver starts; nullopt if neither the pictures nor the last frame give one.
std::optional<TreeState> StartOf(const Start& found, const std::optional<RecoveredFrame>& last, bool is_marked) {
  if (!last || (found.seen && is_marked)) return found.seen;
  // The solver does not move the root. So take the root's position from the pictures, and also its orientation
  // (`root_frame`) if the pictures show it.
  TreeState start = last->state;
  start.root_position = found.fixed[kLeftFoot];
  if (found.seen) start.root_frame = found.seen->root_frame;
  return start;
}

}  // namespace

FrameRecovery::FrameRecovery(const CaptureBody& body, const RecoverOptions& options)
    : body_(body), options_(options), solver_(Prepare(*options.solver, body.tree)), fitter_(body) {
  assert(!body.is_paper || IsValid(body.lengths));
}

std::optional<RecoveredFrame> FrameRecovery::Next(const std::optional<LimbObservation>& observed, bool is_marked,
                                                  const KnownAngles& known) {
  if (!observed) return std::nullopt;
  const BodyPose like = last_ ? last_->pose : ToBodyPose(body_, StandingState(body_.tree));
  const auto seen = CompleteObservation(*observed, body_.lengths, like, last_.has_value());
  if (!seen) return std::nullopt;
  const auto found = body_.is_paper ? PaperStart(body_, *seen) : FittedStart(body_, fitter_, *seen, last_fit_);
  if (!found) return std::nullopt;
  const std::optional<TreeState> start = known.start ? known.start : StartOf(*found, last_, is_marked);
  if (!start) return std::nullopt;
  std::optional<RecoveredFrame> recovered = Solve(*seen, *start, known.pose);
  if (!recovered) return std::nullopt;
  recovered->fixed = found->fixed;
  last_ = recovered;
  return recovered;
}

std::optional<RecoveredFrame> FrameRecovery::Solve(const LimbObservation& seen, const TreeState& start,
                                                   const std::optional<TreeState>& known_pose) const {
  const IkProblem problem = MakeImageProblem(body_, seen, start);
  TreeState state = start;
  std::vector<EffectorError> errors;
  if (known_pose) {
    state = *known_pose;
    const TreeFrames frames = ComputeFrames(body_.tree, state);
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      errors.push_back(ErrorOf(frames.effectors[e], problem.targets[e]));
    }
  } else {
    IkSolution solution = solver_->Solve(problem, options_.ik);
    if (solution.status == IkStatus::kBadInput) return std::nullopt;
    state.angles = std::move(solution.angles);
    errors = std::move(solution.errors);
  }
  const BodyPose pose = ToBodyPose(body_, state);
  return RecoveredFrame{
      .fixed = {}, .state = std::move(state), .pose = pose, .errors = ErrorsSeen(body_, seen, errors)};
}

std::vector<std::optional<RecoveredFrame>> RecoverFrames(const RecoverInputs& inputs, const RecoverOptions& options) {
  const auto fits = [&](std::size_t count) { return count == 0 || count == inputs.seen.size(); };
  assert(fits(inputs.marked.size()) && fits(inputs.known_starts.size()) && fits(inputs.known_poses.size()));
  assert(options.solver != nullptr);
  (void)fits;
  FrameRecovery recovery(inputs.body, options);
  std::vector<std::optional<RecoveredFrame>> frames;
  for (std::size_t i = 0; i < inputs.seen.size(); ++i) {
    KnownAngles known;
    if (!inputs.known_starts.empty()) known.start = inputs.known_starts[i];
    if (!inputs.known_poses.empty()) known.pose = inputs.known_poses[i];
    frames.push_back(recovery.Next(inputs.seen[i], inputs.marked.empty() || inputs.marked[i], known));
  }
  return frames;
}

std::vector<RecoveredFrame> RepeatLastPose(std::span<const std::optional<RecoveredFrame>> frames) {
  const auto first = std::find_if(frames.begin(), frames.end(), [](const auto& frame) { return frame.has_value(); });
  assert(first != frames.end());
  std::vector<RecoveredFrame> held;
  for (const auto& frame : frames) {
    if (frame) {
      held.push_back(*frame);
    } else {
      held.push_back(held.empty() ? **first : held.back());
      held.back().errors.clear();
    }
  }
  return held;
}

Clip ToClip(const CaptureBody& body, std::span<const RecoveredFrame> frames, double rate_hz, const std::string& name) {
  std::vector<TreeState> states;
  for (const RecoveredFrame& frame : frames) states.push_back(frame.state);
  return ToClip(body, states, rate_hz, name);
}

LiveRecovery::LiveRecovery(const CaptureBody& body, const RecoverOptions& recover, const GapOptions& gaps)
    : gaps_(gaps), recovery_(body, recover) {}

std::optional<RecoveredFrame> LiveRecovery::Next(const FrameMeasurement& measured, const KnownAngles& known) {
  if (latest_.size() > static_cast<std::size_t>(gaps_.max_gap)) latest_.erase(latest_.begin());
  latest_.push_back(measured);
  return recovery_.Next(ExtrapolateLast(latest_, gaps_), /*is_marked=*/true, known);
}

}  // namespace etude
