#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// A visible point Q that is fixed to a limb L of a tree.
struct BodyPoint {
  int joint = 0;       ///< index of the limb's joint in the tree
  glm::dvec3 p_LQ{0};  ///< position of the point in the limb's frame, metres
};

/// The linear dependence of an offset on a length: the offset grows by `per_metre` for every metre of the length.
struct LengthShare {
  int index = 0;   ///< index of the joint (whose offset is p_PJ) or of the point (whose offset is p_LQ)
  int length = 0;  ///< index in `MeasurableBody::lengths`
  glm::dvec3 per_metre{0};
};

/// A body whose pose and lengths can be estimated from pictures of its points. Its offsets depend linearly on a few
/// lengths; left and right limbs may share a length.
struct MeasurableBody {
  KinematicTree tree;
  std::vector<BodyPoint> points;
  /// The lengths from which the offsets of `tree` and `points` were made, metres; empty if none is to be estimated.
  std::vector<double> lengths;
  std::vector<LengthShare> joint_shares, point_shares;
};

/// Returns the body with the given lengths, metres, in place of `body.lengths`. The number of lengths must be the same.
MeasurableBody WithLengths(const MeasurableBody& body, std::span<const double> lengths);

/// The positions of a body's points in one pose, and their Jacobian. Each column holds the derivative of a point's
/// world position with respect to one parameter: the root's translation along the world's x, y, z (metres), the
/// rotation of the whole body about the line through the root in each of these directions (radians), each angle
/// (radians), and each length (metres).
struct PlacedPoints {
  std::vector<glm::dvec3> positions;  ///< p_WQ, metres
  int columns = 0;                    ///< number of columns: 6 + angles + lengths
  /// The Jacobian: the derivative of point `point` for column `column` is at [point · columns + column].
  std::vector<glm::dvec3> gains;

  const glm::dvec3* gains_of(int point) const { return gains.data() + static_cast<std::size_t>(point) * columns; }
};

/// Fills `out`, whose memory is reused; if `wants_gains` is false, it fills only the positions. The offsets of `body`
/// must match its lengths (`WithLengths`).
void PlacePoints(const MeasurableBody& body, const TreeState& state, bool wants_gains, PlacedPoints& out);

}  // namespace etude
