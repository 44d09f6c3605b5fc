#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// Over what distances a joint's error changes, metres.
struct PoseLengths {
  double own = 0.25;  ///< moving the joint itself, or the next joint of its limb
  double far = 0.8;   ///< moving the arms, for joints of the trunk and legs
};

/// A random function of the pose, for one joint: unit normal along each axis, smooth, and the same whenever the pose
/// comes back. (A sum of random waves over the places of the joint, of its limb and of the arms.)
class PoseField {
 public:
  PoseField(Role role, const PoseLengths& lengths, RandomStream& dice);

  glm::dvec3 At(const BodyPose& pose) const;

 private:
  static constexpr int kWaves = 12;
  static constexpr std::size_t kMostPlaces = 5;
  /// Where one joint is, from another or in the world.
  struct Seen {
    Role joint;
    bool from_shoulders;
    double length;
  };
  struct Wave {
    glm::dvec3 direction;
    std::array<glm::dvec3, kMostPlaces> per_metre;
    double phase;
  };
  std::array<Seen, kMostPlaces> seen_{};
  std::size_t seen_count_ = 0;
  std::array<Wave, kWaves> waves_;
};

}  // namespace etude
