#pragma once

#include "engine/retargeting/role_places.h"

namespace etude {

/// Finds hands, feet and head that are not taught, when all other roles have their places: the farthest descendant of
/// wrist, ankle and head at a believable distance, else composed in the proportions of paper B's body. A head joint
/// that was found by name stands in the head's role; it becomes the tip's carrier.
void FindTips(RolePlaces& places, const std::array<bool, kRoleCount>& is_taught);

/// Whether a wrist or ankle is moved by a control of its own instead of by any limb.
bool IsFree(const RolePlaces& places, Role end);

}  // namespace etude
