#include "bench/tasks/capture/nearest_poses.h"

#include <optional>

#include "engine/base/euler.h"
#include "engine/capture/fit_pose.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

glm::dvec3 MeanGap(const BodyPose& from, const BodyPose& to) {
  glm::dvec3 sum(0);
  for (const Role role : AllRoles()) sum += to[role] - from[role];
  return sum / static_cast<double>(kRoleCount);
}

LimbObservation Observed(const BodyPose& truth) {
  LimbObservation seen{.ends = truth, .directions = {}};
  for (const Role limb : ObservedLimbs()) seen.directions[Index(limb)] = truth[limb] - truth[*ParentOf(limb)];
  return seen;
}

/// Returns a copy of the body with a freely turning joint at its root.
CaptureBody OnTurningRoot(CaptureBody body) {
  std::vector<TreeJoint>& joints = body.tree.joints;
  joints.insert(joints.begin() + 1,
                TreeJoint{.name = "turn", .parent = 0, .first_dof = body.tree.dof_count(), .dof_count = 3});
  for (std::size_t i = 2; i < joints.size(); ++i) ++joints[i].parent;
  for (TreePoint& point : body.roles) ++point.joint;
  for (Effector& effector : body.tree.effectors) ++effector.joint;
  constexpr double kFreely = 10;  // radians, more than a full turn
  for (int axis = 0; axis < 3; ++axis) body.tree.limits.push_back({-kFreely, kFreely});
  return body;
}

/// Fits poses of paper B's body. It alternates between two steps (block coordinate descent): it fits all angles and the
/// root's rotation, and it moves the root to the best position for these angles and this rotation.
class PaperFitter {
 public:
  explicit PaperFitter(const CaptureBody& body) : body_(body), turning_(OnTurningRoot(body)), fitter_(turning_) {}

  TreeState Fit(const BodyPose& truth, const TreeState* last) const {
    const auto fixed = FixLimbLengths(Observed(truth), body_.lengths);
    const auto seen = fixed ? FindStartState(body_.tree, *fixed, body_.tree.limits) : std::nullopt;
    TreeState state = seen ? *seen : last != nullptr ? *last : StandingState(body_.tree);
    state.angles.resize(turning_.tree.limits.size(), 0.0);
    PoseTargets wanted = TargetsAt(truth);
    constexpr int kRounds = 8;
    for (int round = 0; round < kRounds; ++round) {
      state.root_position += MeanGap(ToBodyPose(turning_, state), truth);
      state = fitter_.Improve(wanted, state);
    }
    const std::vector<double> turn(state.angles.end() - 3, state.angles.end());
    state.root_frame = state.root_frame * RotationXyz({turn[0], turn[1], turn[2]});
    state.angles.resize(body_.tree.limits.size());
    return state;
  }

 private:
  const CaptureBody& body_;
  const CaptureBody turning_;
  const PoseFitter fitter_;
};

}  // namespace

std::vector<TreeState> FindNearestPoses(const CaptureBody& body, std::span<const BodyPose> truth) {
  std::vector<TreeState> states;
  if (body.is_paper) {
    const PaperFitter fitter(body);
    for (const BodyPose& pose : truth) states.push_back(fitter.Fit(pose, states.empty() ? nullptr : &states.back()));
    return states;
  }
  const PoseFitter fitter(body);
  std::optional<PoseFit> last;
  for (const BodyPose& pose : truth) {
    const auto found = fitter.Fit(TargetsAt(pose), last);
    states.push_back(found ? found->state : StandingState(body.tree));
    if (found) last = found;
  }
  return states;
}

}  // namespace etude
