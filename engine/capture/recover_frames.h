#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/capture/bridge_gaps.h"
#include "engine/capture/fit_pose.h"
#include "engine/capture/measure_frames.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

struct RecoverInputs {
  CaptureBody body;  ///< of the person, measured beforehand: PaperBody or FittedBody
  /// The observations, one per frame; nothing in frames of which too little was seen.
  std::span<const std::optional<LimbObservation>> seen;
  /// Tells of each frame whether it was marked itself; empty when all were. The solver starts a marked frame from the
  /// angles that its pictures show, any other from the last frame's angles.
  std::vector<bool> marked = {};
  /// The solver's starts and its answers as the caller knows them without pictures, to see what a stage costs; empty,
  /// or one per frame, each in place of what the stage would find.
  std::vector<TreeState> known_starts = {}, known_poses = {};
};

struct RecoverOptions {
  /// Finds the angles. Not null: one of AllIkSolvers(), or the caller's own.
  const IkSolver* solver = nullptr;
  /// The solver's options. `angle_change_tolerance` bounds how far an angle may move from its start (paper B, section
  /// 3.7.2): set it when limb directions are more exact than the places of the ends.
  IkOptions ik = {};
};

/// One frame of a recovered motion, in the world, metres.
struct RecoveredFrame {
  BodyPose fixed;   ///< with the known limb lengths, before inverse kinematics
  TreeState state;  ///< after it
  BodyPose pose;    ///< the same as twenty joints
  /// The distances from the tree's end effectors to where they were seen, in the tree's order; those not seen are left
  /// out.
  std::vector<EffectorError> errors;
};

/// Recovers a skeleton from what was seen (paper B, chapter 3): limb lengths are fixed, then every end effector brought
/// back by the solver. Lengths of paper B's body are fixed as in its section 3.2 (`FixLimbLengths`), start angles found
/// as in 3.3 (`FindStartState`); another body is brought as near as it can be to all joints that ends and directions
/// lead to (`PoseFitter`), which does both. What an observation lacks comes from the last frame, or a standing body
/// before there is one (`CompleteObservation`), and is no target. A frame without observation, or whose skeleton cannot
/// be computed, stays empty, and so do frames that show no end before the first that does.
std::vector<std::optional<RecoveredFrame>> RecoverFrames(const RecoverInputs& inputs, const RecoverOptions& options);

/// The solver's start and its answer for one frame, as far as the caller knows them without pictures, to see what a
/// stage costs.
struct KnownAngles {
  std::optional<TreeState> start, pose;
};

/// Recovers frame after frame as `RecoverFrames` does, for callers that cannot wait for the next one.
class FrameRecovery {
 public:
  /// `body` must outlive this.
  FrameRecovery(const CaptureBody& body, const RecoverOptions& options);
  FrameRecovery(const FrameRecovery&) = delete;
  FrameRecovery& operator=(const FrameRecovery&) = delete;

  std::optional<RecoveredFrame> Next(const std::optional<LimbObservation>& seen, bool is_marked = true,
                                     const KnownAngles& known = {});

 private:
  std::optional<RecoveredFrame> Solve(const LimbObservation& seen, const TreeState& start,
                                      const std::optional<TreeState>& known_pose) const;

  const CaptureBody& body_;
  const RecoverOptions options_;
  const std::unique_ptr<PreparedIkSolver> solver_;
  const PoseFitter fitter_;
  std::optional<PoseFit> last_fit_;
  std::optional<RecoveredFrame> last_;
};

/// Fills empty frames: each shows the last skeleton before it, leading ones the first. At least one is not empty.
std::vector<RecoveredFrame> HoldFrames(std::span<const std::optional<RecoveredFrame>> frames);

/// Makes a clip of the motion, which WriteBvh writes: metres, Y up. `body` is the one it was recovered with.
Clip ToClip(const CaptureBody& body, std::span<const RecoveredFrame> frames, double rate_hz, const std::string& name);

/// Recovers a motion as it happens: each skeleton from the marks up to its frame alone. What a frame lacks comes from
/// those before it (`BridgeLast`); no later frame corrects it.
class LiveRecovery {
 public:
  /// `body` must outlive this.
  LiveRecovery(const CaptureBody& body, const RecoverOptions& recover, const BridgeOptions& bridge);

  /// Takes the next marked frame and returns its skeleton; nothing while too little was seen.
  std::optional<RecoveredFrame> Next(const FrameMeasurement& measured, const KnownAngles& known = {});

 private:
  const BridgeOptions bridge_;
  FrameRecovery recovery_;
  std::vector<FrameMeasurement> latest_;  ///< as many as can be bridged
};

}  // namespace etude
