#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/formats/trc.h"

namespace etude {

/// Returns the largest of a frame's extents along x, y and z, as a median over the frames, in the file's unit. A NaN is
/// a missing joint. Points far from the body, such as a ball or a camera, are ignored. A point is far if its distance
/// from the frame's median point exceeds four times the median of these distances. If more than a quarter of the points
/// are far, all points are used.
double SpreadOf(std::span<const glm::dvec3> positions, std::size_t joints);

/// Returns the length in metres of the unit (m, cm or mm) in which the extent `spread` is a person's, 0.8 to 2.3 m;
/// nullopt if there is no such unit.
std::optional<double> UnitOfSpread(double spread);

/// Converts positions in an unknown unit to metres by UnitOfSpread, and states this in `remark`. Does nothing if no
/// unit gives a person's size.
void ScaleToPerson(MarkerMotion& markers);

/// The direction of a standing body in the array's axes; kUnknown if it stands along Y on its feet, or if its direction
/// is not known.
enum class Standing { kUnknown, kAlongMinusY, kOnHands, kAlongZ };
/// Returns the direction in which the body stands: from knees to shoulders or, for −Y only, alternatively the sum of
/// the directions of trunk and shanks, because the thighs of people who sit are horizontal. The direction must be the
/// same in at least three quarters of the frames that show these joints. A body that is upside down stands on its hands
/// if a wrist is near the lowest joint in most frames and if that joint stays at one height.
Standing FindStanding(std::span<const glm::dvec3> positions, const std::vector<std::string>& names);

}  // namespace etude
