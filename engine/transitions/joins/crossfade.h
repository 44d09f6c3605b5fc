#pragma once

#include <array>

#include "engine/transitions/joins/join.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {

/// A rotation vector for each limb, indexed by the role at the limb's end.
using LimbTurns = std::array<LimbTurn, kRoleCount>;
/// Returns the rotations that take the limbs of `to` to those of `from`.
LimbTurns TurnsBack(const BodyPose& from, const BodyPose& to);

/// Returns the pose at fraction `share` of the way from one pose to another, limb by limb; the limbs have the lengths
/// of `to`. `back` is TurnsBack(from, to), which a caller with several shares computes only once.
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, const LimbTurns& back, double share);
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, double share);

struct CrossfadeOptions {
  /// The time until only the new motion is shown, in seconds (default ours). A longer time hides larger differences,
  /// but shows poses of neither clip for longer; 0 is a cut.
  double blend_s = 0.33;
};
const SettingTable<CrossfadeOptions>& CrossfadeSettings();

/// Fades from the old motion to the new one over `blend_s` with the weight 3t² − 2t³ (Kovar, Gleicher and Pighin 2002,
/// section 3.3). The old motion continues to the end of its clip and then holds its last frame.
///
/// The hip centre moves on a straight line, and every limb takes the smallest rotation, so limbs that have the same
/// length in both motions keep it.
Blend Crossfade(const JoinInput& input, const CrossfadeOptions& options = {});

}  // namespace etude
