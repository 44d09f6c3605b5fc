#include "engine/retargeting/role_places.h"

#include <algorithm>

namespace etude {

bool RolePlaces::IsComposed(Role role) const { return std::ranges::find(map_.composed, role) != map_.composed.end(); }

void RolePlaces::Set(Role role, int joint) {
  map_.points[Index(role)] = {.joint = joint};
  rest_[Index(role)] = tree_.RestOf(joint);
}

void RolePlaces::Compose(Role role, int joint, const glm::dvec3& rest) {
  map_.points[Index(role)] = {.joint = joint, .offset = tree_.InFrameOf(joint, rest)};
  rest_[Index(role)] = rest;
  map_.composed.push_back(role);
}

}  // namespace etude
