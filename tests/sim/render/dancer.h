#pragma once

#include <vector>

#include "sim/body/shape.h"

namespace etude {

/// Returns a dancer of capsules in the middle of a move, facing +Z. Arms and legs are at different heights, and the
/// left forearm is in front of the trunk, so that parts hide each other. The dancer is written by hand, independent of
/// sim/body.
inline std::vector<Capsule> Dancer() {
  return {{Part::kTrunk, {0, 0.98, 0}, {0.02, 1.38, -0.02}, 0.13},
          {Part::kHead, {0.03, 1.58, 0}, {0.03, 1.66, 0}, 0.10},
          {Part::kLeftUpperArm, {0.20, 1.40, -0.02}, {0.36, 1.16, 0.08}, 0.05},
          {Part::kLeftForearm, {0.36, 1.16, 0.08}, {0.13, 1.18, 0.22}, 0.042},
          {Part::kLeftHand, {0.13, 1.18, 0.22}, {0.02, 1.20, 0.24}, 0.04},
          {Part::kRightUpperArm, {-0.17, 1.40, -0.02}, {-0.43, 1.50, 0}, 0.05},
          {Part::kRightForearm, {-0.43, 1.50, 0}, {-0.52, 1.74, 0.04}, 0.042},
          {Part::kRightHand, {-0.52, 1.74, 0.04}, {-0.54, 1.86, 0.05}, 0.04},
          {Part::kLeftThigh, {0.10, 0.93, 0}, {0.26, 0.54, 0.10}, 0.08},
          {Part::kLeftShank, {0.26, 0.54, 0.10}, {0.30, 0.11, 0.02}, 0.058},
          {Part::kLeftFoot, {0.30, 0.06, 0.02}, {0.32, 0.045, 0.19}, 0.045},
          {Part::kRightThigh, {-0.10, 0.93, 0}, {-0.14, 0.50, 0.04}, 0.08},
          {Part::kRightShank, {-0.14, 0.50, 0.04}, {-0.15, 0.11, 0}, 0.058},
          {Part::kRightFoot, {-0.15, 0.06, 0}, {-0.19, 0.045, 0.17}, 0.045}};
}

}  // namespace etude
