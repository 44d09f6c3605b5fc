#pragma once

#include <array>

#include "engine/transitions/joins/join.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {

/// A rotation vector for each limb, indexed by the role at the limb's outer end.
using LimbTurns = std::array<LimbTurn, kRoleCount>;
/// Returns, for each limb, the rotation from the limb's direction in `to` to its direction in `from`.
LimbTurns TurnsBack(const BodyPose& from, const BodyPose& to);

/// Interpolates limb by limb between two poses; `share` is 0 at `from` and 1 at `to`. The limbs have the lengths of
/// `to`. `back` is TurnsBack(from, to); a caller that needs several shares computes it once.
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, const LimbTurns& back, double share);
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, double share);

struct CrossfadeOptions {
  /// The time until only the new motion is shown, in seconds (the default is ours). A longer time hides larger
  /// differences, but shows poses that are in neither clip for a longer time; 0 is a cut.
  double blend_s = 0.33;
};
const SettingTable<CrossfadeOptions>& CrossfadeSettings();

/// Fades from the old motion to the new one over `blend_s` with the weight 3t² − 2t³ (Kovar, Gleicher and Pighin 2002,
/// section 3.3). The old motion continues to the end of its clip and then repeats its last frame.
///
/// The hip centre is interpolated linearly and every limb by its smallest rotation, so limbs with equal lengths in both
/// motions keep their lengths.
Blend Crossfade(const JoinInput& input, const CrossfadeOptions& options = {});

}  // namespace etude
