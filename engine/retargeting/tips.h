#pragma once

#include "engine/retargeting/role_places.h"

namespace etude {

/// Finds hands, feet and head that are not taught, when all other roles have their places: the farthest descendant of
/// wrist, ankle and head at a believable distance, else composed in the proportions of paper B's body. No thumb is the
/// tip of a hand; of equally far tips (within 10⁻⁴) the middle finger is taken, then index, ring and little finger,
/// then the skeleton's first, on the left as on the right. A head joint that was found by name stands in the head's
/// role; it becomes the tip's carrier.
void FindTips(RolePlaces& places, const std::array<bool, kRoleCount>& is_taught);

/// Whether a wrist or ankle is moved by a control of its own instead of by any limb.
bool IsFree(const RolePlaces& places, Role end);

}  // namespace etude
