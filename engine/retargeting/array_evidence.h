#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude {

/// Returns the median extent of a frame's joints along an axis, in the file's unit. A NaN is a missing joint. A point
/// is ignored if it is four times as far from the median point as usual, such as a ball or a camera, unless more than a
/// quarter of a frame's points are so far.
double SpreadOf(std::span<const glm::dvec3> positions, std::size_t joints);

/// Returns the unit in which the extent `spread` is a person's, 0.8 to 2.3 m; nullopt if there is no such unit.
std::optional<double> UnitOfSpread(double spread);

/// How a body stands in the array's axes; kNotTold if it stands along Y on its feet, or if this is unknown.
enum class Standing { kNotTold, kAlongMinusY, kOnHands, kAlongZ };
/// Returns how the body stands. The direction from knees to shoulders decides, in at least three quarters of the frames
/// that show these joints. A body that is upside down stands on its hands if its wrists are near the lowest joint and
/// if that joint stays at one height.
Standing HowItStands(std::span<const glm::dvec3> positions, const std::vector<std::string>& names);

}  // namespace etude
