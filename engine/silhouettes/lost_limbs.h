#pragma once

#include <span>
#include <vector>

#include "engine/silhouettes/fit_silhouettes.h"

namespace etude {

/// Returns the start postures of a search for a person: standing with hanging arms, with raised arms, and on bent legs.
/// The root is at the origin and faces +Z.
std::vector<TreeState> Postures(const SilhouetteBody& body);

/// Returns two copies of `state` in which one arm or leg has another position: the two positions of lowest cost on a
/// grid over the range of the limb's joints.
std::vector<TreeState> LimbCandidates(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const SilhouetteBody::Limb& limb,
                                  const SilhouetteCostOptions& options);

}  // namespace etude
