#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// A point Q, fixed to a tree's limb L, that pictures show.
struct BodyPoint {
  int joint = 0;       ///< whose limb it is fixed to
  glm::dvec3 p_LQ{0};  ///< metres
};

/// The share of a length in an offset of the body: the offset grows by `per_metre` for every metre of the length.
struct LengthShare {
  int index = 0;   ///< of the joint whose p_PJ, or of the point whose p_LQ it is
  int length = 0;  ///< index of the length
  glm::dvec3 per_metre{0};
};

/// A body whose pose and lengths can be estimated from pictures of its points: offsets grow linearly with a few
/// lengths, which both sides may share.
struct MeasurableBody {
  KinematicTree tree;
  std::vector<BodyPoint> points;
  /// The lengths that the offsets of `tree` and `points` are made with, metres; empty when none is to be estimated.
  std::vector<double> lengths;
  std::vector<LengthShare> joint_shares, point_shares;
};

/// Returns the body with other lengths: as many, metres.
MeasurableBody WithLengths(const MeasurableBody& body, std::span<const double> lengths);

/// The places of a body's points in one pose, and their Jacobian. Column by column, three numbers for each point: what
/// its place in the world gains (metres) when the root is shifted along x, y, z (metres), when the whole body turns
/// about the root about the world's x, y, z (radians), per angle (radians), per length (metres).
struct PlacedPoints {
  std::vector<glm::dvec3> positions;  ///< p_WQ, metres
  int columns = 0;                    ///< 6 + angles + lengths
  std::vector<glm::dvec3> gains;      ///< [point · columns + column]

  const glm::dvec3* gains_of(int point) const { return gains.data() + static_cast<std::size_t>(point) * columns; }
};

/// Fills `out`, which keeps its memory; without `wants_gains` only the positions. `body` has its lengths
/// (`WithLengths`).
void PlacePoints(const MeasurableBody& body, const TreeState& state, bool wants_gains, PlacedPoints& out);

}  // namespace etude
