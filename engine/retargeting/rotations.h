#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace etude {

/// The shortest rotation that brings `from`'s direction into `to`'s. Where there is none to choose (opposite
/// directions) it turns about an axis across `from`; no direction at all (a zero vector) turns nothing.
glm::dquat ShortestTurn(const glm::dvec3& from, const glm::dvec3& to);

/// The orientation whose X axis points along `x` and whose Y axis lies in the plane of `x` and `y`, on `y`'s side.
/// Where both are parallel or of no length, X is turned there by the shortest way.
glm::dquat Orientation(const glm::dvec3& x, const glm::dvec3& y);

}  // namespace etude
