#include "bench/tasks/capture/recover.h"

#include <algorithm>
#include <cassert>

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

double MeanEffectorErrorCm(const IkSolution& solution) {
  constexpr double kCmPerMetre = 100;
  double sum = 0;
  for (const EffectorError& error : solution.errors) sum += kCmPerMetre * error.position;
  return sum / static_cast<double>(solution.errors.size());
}

}  // namespace

std::vector<std::optional<RecoveredFrame>> RecoverFrames(const KinematicTree& body, const LimbLengths& lengths,
                                                         std::span<const std::optional<LimbObservation>> seen,
                                                         const std::vector<bool>& marked, const IkSolver& solver,
                                                         const IkOptions& options) {
  assert(seen.size() == marked.size());
  std::vector<std::optional<RecoveredFrame>> frames(seen.size());
  std::optional<RecoveredFrame> last;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    const std::optional<BodyPose> fixed = FixLimbLengths(*seen[i], lengths);
    if (!fixed) continue;
    const std::optional<TreeState> start = FindStart(body, *fixed, marked[i], last);
    if (!start) continue;
    const IkProblem problem = MakeImageProblem(body, *seen[i], *start);
    const IkSolution solution = solver.solve(body, problem, options);
    if (solution.status == IkStatus::kBadInput) continue;
    TreeState state = *start;
    state.angles = solution.angles;
    const BodyPose pose = ToBodyPose(body, state);
    frames[i] = RecoveredFrame{*fixed, std::move(state), pose, MeanEffectorErrorCm(solution)};
    last = frames[i];
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
      held.back().effector_error_cm.reset();
    }
  }
  return held;
}

}  // namespace etude
