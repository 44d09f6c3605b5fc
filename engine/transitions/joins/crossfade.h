#pragma once

#include "engine/transitions/joins/join.h"

namespace etude {

/// Returns the pose `share` of the way from one to another, limb by limb; the limbs have the lengths of `to`.
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
