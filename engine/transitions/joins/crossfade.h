#pragma once

#include <array>

#include "engine/transitions/joins/join.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {

/// A turn for each limb, by the role at its end.
using LimbTurns = std::array<LimbTurn, kRoleCount>;
/// Returns the turns that lay the limbs of `to` onto those of `from`.
LimbTurns TurnsBack(const BodyPose& from, const BodyPose& to);

/// Returns the pose `share` of the way from one to another, limb by limb; the limbs have the lengths of `to`. `back`:
/// TurnsBack of the two, for who asks for several shares.
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, const LimbTurns& back, double share);
BodyPose PoseBetween(const BodyPose& from, const BodyPose& to, double share);

struct CrossfadeOptions {
  /// Seconds until the new motion is shown alone. Ours. Longer ones hide wider gaps, and show poses of neither clip for
  /// longer; 0 is a cut.
  double blend_s = 0.33;
};
const SettingTable<CrossfadeOptions>& CrossfadeSettings();

/// The old motion fades into the new one over `blend_s`, by the weight 3t² − 2t³ (Kovar, Gleicher and Pighin 2002,
/// section 3.3). The old motion goes on as far as its clip does and then holds its last frame.
///
/// The hip centre goes straight from the one to the other and every limb turns the shortest way, so that limbs which
/// are equally long in both keep their lengths.
Blend Crossfade(const JoinInput& input, const CrossfadeOptions& options = {});

}  // namespace etude
