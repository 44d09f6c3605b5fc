#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/capture/fit_pose.h"
#include "engine/capture/interpolate_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

struct RecoverInputs {
  CaptureBody body;  ///< the body of the person, from PaperBody or FittedBody
  /// One observation per frame; nullopt for frames in which too little was seen.
  std::span<const std::optional<LimbObservation>> seen;
  /// One flag per frame: true if the frame itself was marked; empty if all frames were. In a marked frame the solver
  /// starts at the angles that the pictures show, in any other frame at the angles of the last recovered frame.
  std::vector<bool> marked = {};
  /// The true start angles or true poses, one per frame, if known; otherwise empty. Known start angles replace the
  /// computed start angles, and known poses replace the solver's result. The error that remains in the recovered motion
  /// then comes from the other computations.
  std::vector<TreeState> known_starts = {}, known_poses = {};
};

struct RecoverOptions {
  /// The solver, which must be set: one of AllIkSolvers(), or the caller's own.
  const IkSolver* solver = nullptr;
  /// The options of the solver. Set `angle_change_tolerance`, which limits how far an angle may move from its start
  /// (paper B, section 3.7.2), if limb directions are more accurate than the end effectors' positions.
  IkOptions ik = {};
};

/// One frame of a recovered motion; world coordinates, metres.
struct RecoveredFrame {
  BodyPose fixed;   ///< joints with the known limb lengths, before inverse kinematics
  TreeState state;  ///< the pose after inverse kinematics
  BodyPose pose;    ///< the same pose as twenty joints
  /// The errors of the end effectors that were seen, in the tree's order; the others are left out.
  std::vector<EffectorError> errors;
};

/// Recovers a skeleton in every frame from its observation (paper B, chapter 3): fix the limb lengths, then move every
/// end effector back to its observed position with the solver. For paper B's body, lengths are fixed as in section 3.2
/// (`FixLimbLengths`), and start angles are found as in 3.3 (`FindStartState`). For another body, `PoseFitter` replaces
/// these two functions: it fits the body to all joints that the end effectors and the limbs' directions determine.
/// Values that an observation lacks are taken from the last frame, or at the beginning from a standing body
/// (`CompleteObservation`); these values are not used as targets. A frame stays empty if it has no observation, if its
/// skeleton cannot be computed, or if no end effector was seen in this frame or an earlier one.
std::vector<std::optional<RecoveredFrame>> RecoverFrames(const RecoverInputs& inputs, const RecoverOptions& options);

/// The true start or true pose of one frame, if known, as in RecoverInputs.
struct KnownAngles {
  std::optional<TreeState> start, pose;
};

/// Recovers the frames one by one, for callers that need each frame immediately. The results equal those of
/// `RecoverFrames`.
class FrameRecovery {
 public:
  /// `body` must outlive this object.
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

/// Gives each empty frame the last skeleton before this frame; a frame before the first skeleton gets the first
/// skeleton. At least one frame must not be empty.
std::vector<RecoveredFrame> RepeatLastPose(std::span<const std::optional<RecoveredFrame>> frames);

/// Converts the motion to a clip that WriteBvh can write: metres, Y up. `body` must be the body with which `frames`
/// were recovered.
Clip ToClip(const CaptureBody& body, std::span<const RecoveredFrame> frames, double rate_hz, const std::string& name);

/// Recovers a motion live: each skeleton is computed from the marks up to its frame. Values that a frame lacks come
/// from the frames before it (`ExtrapolateLast`); later frames do not change the skeleton.
class LiveRecovery {
 public:
  /// `body` must outlive this object.
  LiveRecovery(const CaptureBody& body, const RecoverOptions& recover, const GapOptions& gaps);

  /// Takes the next marked frame and returns its skeleton; nullopt as long as too little of the body has been seen.
  std::optional<RecoveredFrame> Next(const FrameMeasurement& measured, const KnownAngles& known = {});

 private:
  const GapOptions gaps_;
  FrameRecovery recovery_;
  std::vector<FrameMeasurement> latest_;  ///< the last frames, as many as ExtrapolateLast uses
};

}  // namespace etude
