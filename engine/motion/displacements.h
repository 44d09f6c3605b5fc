#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// A stretch of frames, both ends included.
struct FrameRange {
  int first = 0, last = 0;
};

/// Returns all runs of frames in which `is_marked` is true, each as long as possible, in order.
std::vector<FrameRange> RangesOf(const std::vector<bool>& is_marked);

/// A displacement that all joints share, between the frames `before` and `after`.
struct Displacement {
  int before = 0, after = 0;
  glm::dvec3 lasting{0};  ///< metres; displacement of all frames from `after` on
  glm::dvec3 largest{0};  ///< metres; largest displacement of a single frame in (`before`, `after`]
  /// Metres. Of `largest` and the largest displacement relative to frame `after`, the longer vector, or the shorter one
  /// if their lengths nearly agree. A motion played backwards gives the same length.
  glm::dvec3 size{0};
};

/// A displacement of one joint alone.
struct Pop {
  FrameRange frames;
  Role joint = Role::kHipCentre;
  double size = 0;  ///< distance, metres: the length of Displacement::size
};

/// A sudden change of the velocity along the floor, from one frame to the next, that all joints share.
struct VelocityStep {
  int frame = 0;         ///< the last frame with the old velocity
  glm::dvec2 change{0};  ///< x and z, metres per second
};

/// The displacements in a motion: changes from frame to frame that no real body makes.
struct Displacements {
  std::vector<FrameRange> frozen;    ///< frames that keep the pose of their first frame (FaultRules, "freezes")
  std::vector<Displacement> common;  ///< none where a frozen stretch begins or ends
  std::vector<Pop> pops;             ///< none where a frozen stretch begins or ends
  std::vector<VelocityStep> steps;   ///< none where a frozen stretch begins or ends
};

/// Finds displacements by third differences; FaultRules states the rules. A displacement has the same size in every
/// step, the first and the last included. The motion must have at least eight frames. `unseen`: see
/// FaultOptions::unseen.
Displacements FindDisplacements(const BodyMotion& motion, std::span<const JointSet> unseen = {});

}  // namespace etude
