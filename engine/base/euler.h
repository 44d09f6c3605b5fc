#pragma once

#include <glm/glm.hpp>

namespace etude {

/// Returns the rotation about the unit vector `axis` by `angle` radians (right-hand rule).
glm::dmat3 AxisRotation(const glm::dvec3& axis, double angle);

/// Returns Rx(x) · Ry(y) · Rz(z), angles in radians: the convention of tree joints and cameras (paper B, sections 3.3
/// and 2.2).
glm::dmat3 RotationXyz(const glm::dvec3& angles);

/// Returns the angles for which `RotationXyz` gives `rotation`: x and z in (−π, π], y in [−π/2, π/2]. At y = ±π/2 only
/// the sum or difference of x and z is determined; some pair that reproduces `rotation` is returned.
glm::dvec3 AnglesXyz(const glm::dmat3& rotation);

/// Returns the smallest rotation that turns the unit vector `from` into the unit vector `to`; for opposite vectors,
/// half a turn about some axis normal to them.
glm::dmat3 SmallestRotation(const glm::dvec3& from, const glm::dvec3& to);

/// Returns the component of `v` normal to the unit vector `axis`, normalised. `v` must not be parallel to `axis`.
glm::dvec3 UnitNormalPart(const glm::dvec3& v, const glm::dvec3& axis);

}  // namespace etude
