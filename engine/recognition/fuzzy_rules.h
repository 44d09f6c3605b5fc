#pragma once

#include <memory>
#include <span>

#include "engine/fuzzy/membership.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"
#include "engine/recognition/weighting.h"

namespace etude {

struct FuzzyRulesOptions {
  /// For how many seen frames in a row a rule must hold, as of key poses.
  int hold_frames = 3;
};

/// How far a frame belongs to a key pose, in [0, 1], by a rule of paper A's fuzzy system: "RH is as taught AND LH is as
/// taught AND …", AND being the minimum. A feature is as taught as far as its grades in the frame and at the taught
/// angle overlap: Σ min(μ, μ′) / Σ max(μ, μ′) over its terms. With adaptive weights, a feature that counts w is held
/// against the pose only as far as w: max(overlap, 1 − w) (Yager 1981). 0 when no feature has any weight.
double RuleStrength(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
                    const Memberships& memberships);

/// Paper A's features with fuzzy rules over time (ours): one rule per key pose, and one per move, "first this pose,
/// then that, within one performance", again by the minimum. Knows table 1's terms, not the key poses' tolerances.
std::unique_ptr<Recogniser> MakeFuzzyRulesRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                     const FuzzyRulesOptions& options);

}  // namespace etude
