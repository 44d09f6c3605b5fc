#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// One frame of a recovered motion.
struct RecoveredFrame {
  BodyPose fixed;   ///< with the known limb lengths, before inverse kinematics
  TreeState state;  ///< after it
  BodyPose pose;    ///< the same as twenty joints
  /// From the end effectors to where they were seen, mean; nothing where they were not seen.
  std::optional<double> effector_error_cm;
};

/// From what was seen to a skeleton (paper B, chapter 3): limb lengths fixed, then every end effector brought
/// back by the solver. Where `marked` says so the solver starts from the angles of the images, else from
/// the last frame's. A frame without observation, or whose skeleton cannot be computed, stays empty.
std::vector<std::optional<RecoveredFrame>> RecoverFrames(const KinematicTree& body, const LimbLengths& lengths,
                                                         std::span<const std::optional<LimbObservation>> seen,
                                                         const std::vector<bool>& marked, const IkSolver& solver,
                                                         const IkOptions& options);

/// Every frame: an empty one shows the last skeleton before it, leading ones the first. At least one is not empty.
std::vector<RecoveredFrame> HoldFrames(std::span<const std::optional<RecoveredFrame>> frames);

}  // namespace etude
