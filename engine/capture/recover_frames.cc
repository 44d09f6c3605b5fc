#include "engine/capture/recover_frames.h"

#include <algorithm>
#include <cassert>

#include "engine/kinematics/partial_observation.h"
#include "engine/kinematics/start_angles.h"
#include "engine/kinematics/tree_to_body.h"

namespace etude {
namespace {

// The pose that the solver begins with, or nothing when neither the images nor the last frame give one.
std::optional<TreeState> FindStart(const KinematicTree& body, const BodyPose& fixed, bool is_marked,
                                   const std::optional<RecoveredFrame>& last) {
  std::optional<TreeState> seen = FindStartState(body, fixed, body.limits);
  if (!last || (seen && is_marked)) return seen;
  // The solver does not move the root: its place and frame are always the images'.
  TreeState start = last->state;
  start.root_position = fixed[Role::kLeftFoot];
  if (seen) start.root_frame = seen->root_frame;
  return start;
}

// Of the effectors whose ends were seen.
std::vector<EffectorError> ErrorsSeen(const KinematicTree& body, const LimbObservation& seen,
                                      const std::vector<EffectorError>& errors) {
  std::vector<EffectorError> kept;
  for (std::size_t e = 0; e < errors.size(); ++e) {
    const Role role = BodyTreeLimbs()[body.effectors[e].joint].to;
    if (!seen.lacks_end[Index(role)]) kept.push_back(errors[e]);
  }
  return kept;
}

std::optional<RecoveredFrame> RecoverFrame(const KinematicTree& body, const LimbLengths& lengths,
                                           const LimbObservation& observed, bool is_marked,
                                           const std::optional<RecoveredFrame>& last, const RecoverOptions& options) {
  const BodyPose like = last ? last->pose : ToBodyPose(body, StandingState(body));
  const auto completed = CompleteObservation(observed, lengths, like, last.has_value());
  if (!completed) return std::nullopt;
  const LimbObservation& seen = *completed;
  const std::optional<BodyPose> fixed = FixLimbLengths(seen, lengths);
  if (!fixed) return std::nullopt;
  const std::optional<TreeState> start = FindStart(body, *fixed, is_marked, last);
  if (!start) return std::nullopt;
  IkSolution solution = options.solver->solve(body, MakeImageProblem(body, seen, *start), options.ik);
  if (solution.status == IkStatus::kBadInput) return std::nullopt;
  TreeState state = *start;
  state.angles = std::move(solution.angles);
  const BodyPose pose = ToBodyPose(body, state);
  return RecoveredFrame{*fixed, std::move(state), pose, ErrorsSeen(body, seen, solution.errors)};
}

}  // namespace

std::vector<std::optional<RecoveredFrame>> RecoverFrames(const RecoverInputs& inputs, const RecoverOptions& options) {
  assert(options.solver != nullptr);
  assert(inputs.marked.empty() || inputs.marked.size() == inputs.seen.size());
  const KinematicTree body = MakeBodyTree(inputs.lengths);
  std::vector<std::optional<RecoveredFrame>> frames(inputs.seen.size());
  std::optional<RecoveredFrame> last;
  for (std::size_t i = 0; i < inputs.seen.size(); ++i) {
    if (!inputs.seen[i]) continue;
    const bool is_marked = inputs.marked.empty() || inputs.marked[i];
    frames[i] = RecoverFrame(body, inputs.lengths, *inputs.seen[i], is_marked, last, options);
    if (frames[i]) last = frames[i];
  }
  return frames;
}

std::vector<RecoveredFrame> HoldFrames(std::span<const std::optional<RecoveredFrame>> frames) {
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

Clip ToClip(const LimbLengths& lengths, std::span<const RecoveredFrame> frames, double rate_hz,
            const std::string& name) {
  std::vector<TreeState> states;
  for (const RecoveredFrame& frame : frames) states.push_back(frame.state);
  return ToClip(MakeBodyTree(lengths), states, rate_hz, name);
}

}  // namespace etude
