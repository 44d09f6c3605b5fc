#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"
#include "engine/vision/strokes.h"

namespace etude {

/// How exact marks are, as far as a method may know.
struct MarkErrors {
  double mark_error_px = 2;  ///< standard deviation of a stroke's end across the stroke, and of a disc, in u and in v
  /// How far a stroke's end slides along the limb, as a share of the stroke's length (standard deviation): a stroke
  /// says more surely on which line a limb lies than where it begins *(ours)*.
  double slide_share = 0.08;
};

/// What one mark says of a joint.
struct MarkedJoint {
  Role role;
  glm::dvec2 pixel{0};
  glm::dmat2 information{0};  ///< inverse covariance, 1/px²
};

/// What the marks of one picture say of joints: every stroke of both its ends, every disc of its tip, which
/// covers the stroke's end there. A joint that several marks end at was found once, by one hand: they share the
/// information of one.
std::vector<MarkedJoint> MarkedJointsOf(const Marks& marks, const MarkErrors& errors);

}  // namespace etude
