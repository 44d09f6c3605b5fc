#include "engine/transitions/joins/foot_contacts.h"

#include <algorithm>

namespace etude {

FootContacts FindFootContacts(std::span<const BodyPose> poses, double rate_hz, const ContactRules& rules) {
  FootContacts contacts;
  const std::size_t count = poses.size();
  for (std::size_t side = 0; side < kLegs.size(); ++side) {
    const Role foot = kLegs[side].foot;
    bool stands = false;
    for (std::size_t f = 0; f < count; ++f) {
      const std::size_t next = std::min(f + 1, count - 1), here = next > 0 ? next - 1 : 0;
      const double speed = rate_hz * glm::distance(poses[next][foot], poses[here][foot]);
      const double height = poses[f][foot].y;
      stands = stands ? height <= rules.lift_height && speed <= rules.lift_speed
                      : height <= rules.plant_height && speed <= rules.plant_speed;
      contacts[side].push_back(stands);
    }
  }
  return contacts;
}

}  // namespace etude
