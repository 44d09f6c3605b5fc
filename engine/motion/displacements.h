#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// A stretch of frames, both ends included.
struct FrameRange {
  int first = 0, last = 0;
};

/// Returns the longest stretches of frames in which `is_marked` is true, in order.
std::vector<FrameRange> RangesOf(const std::vector<bool>& is_marked);

/// A displacement of all joints alike between the frames `before` and `after`.
struct Displacement {
  int before = 0, after = 0;
  glm::dvec3 lasting{0};  ///< of the frames from `after` on, metres
  glm::dvec3 largest{0};  ///< of a frame after `before` up to `after`, metres
};

/// A displacement of one joint alone.
struct Pop {
  FrameRange frames;
  Role joint = Role::kHipCentre;
  double size = 0;  ///< metres
};

/// A change of the velocity of all joints alike, along the floor, that happens from one frame to the next.
struct VelocityStep {
  int frame = 0;         ///< the last frame with the velocity before
  glm::dvec2 change{0};  ///< x and z, metres per second
};

/// The displacements in a motion: changes between frames that are not movements of a body.
struct Displacements {
  std::vector<FrameRange> frozen;    ///< frames that repeat the pose of the first one, for 0.9 s or more
  std::vector<Displacement> common;  ///< none at either end of a frozen stretch
  std::vector<Pop> pops;             ///< none there either
  std::vector<VelocityStep> steps;   ///< none there either
};

/// Finds displacements by third differences, as FindMotionFaults states. The motion must have at least eight frames.
/// `unseen`: FaultOptions::unseen.
Displacements FindDisplacements(const BodyMotion& motion, std::span<const JointSet> unseen = {});

}  // namespace etude
