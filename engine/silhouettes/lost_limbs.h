#pragma once

#include <span>
#include <vector>

#include "engine/silhouettes/fit_silhouettes.h"

namespace etude {

/// Returns the postures that a person is searched with: standing with hanging arms, with raised arms, and on bent legs.
/// The root is at the origin, facing +Z.
std::vector<TreeState> Postures(const SilhouetteBody& body);

/// Returns `state` with one arm or leg elsewhere: the few places that cost least, of a grid over the range of its
/// joints.
std::vector<TreeState> LimbPlaces(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const SilhouetteBody::Limb& limb,
                                  const SilhouetteCostOptions& options);

}  // namespace etude
