#include "bench/tasks/ik/stretched.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

double LengthOf(const KinematicTree& tree, BodyTreeJoint upper_end) { return glm::length(tree.joints[upper_end].p_PJ); }

/// Bends both legs in their plane: the shanks lean forward by `shank`, the thighs backward by `thigh`.
void BendLegs(const KinematicTree& tree, double shank, double thigh, std::vector<double>& angles) {
  constexpr int kZ = 2;
  const auto set = [&](BodyTreeJoint joint, int axis, double angle) {
    angles[static_cast<std::size_t>(tree.joints[joint].first_dof + axis)] = angle;
  };
  set(kTreeLeftAnkle, 0, -shank);
  set(kTreeLeftKnee, 0, shank + thigh);
  set(kTreeLeftHip, kZ, -thigh);
  set(kTreeRightHip, 0, thigh);
  set(kTreeRightKnee, 0, -(shank + thigh));
  set(kTreeRightAnkle, 0, shank);
}

}  // namespace

TreeState CrouchBeneathStandingHands(const KinematicTree& tree, RandomStream& dice) {
  TreeState state = StandingState(tree);
  const double shank = LengthOf(tree, kTreeLeftKnee), thigh = LengthOf(tree, kTreeLeftHip);
  const double lean = Radians(dice.Uniform(8, 19));  // the ankle allows 20° in every set of limits
  const double counter = std::asin(shank * std::sin(lean) / thigh);
  BendLegs(tree, lean, counter, state.angles);
  const double drop = shank * (1 - std::cos(lean)) + thigh * (1 - std::cos(counter));

  // Shoulder, elbow and wrist are a triangle; the hand hangs on beneath the shoulder.
  const double upper = LengthOf(tree, kTreeLeftElbow), fore = LengthOf(tree, kTreeLeftWrist);
  const double span = upper + fore - 1.5 * drop;
  const double back = std::acos((upper * upper + span * span - fore * fore) / (2 * upper * span));
  const double forward = std::acos((fore * fore + span * span - upper * upper) / (2 * fore * span));
  for (const BodyTreeJoint shoulder : {kTreeLeftShoulder, kTreeRightShoulder}) {
    const auto first = [&](int offset) { return static_cast<std::size_t>(tree.joints[shoulder + offset].first_dof); };
    state.angles[first(0)] = -back;
    state.angles[first(1)] = back + forward;
    state.angles[first(2)] = -forward;
  }
  return state;
}

}  // namespace etude
