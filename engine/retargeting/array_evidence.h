#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude {

/// Returns the median extent of a frame's joints along an axis, in the file's unit. A NaN is a missing joint. Points
/// four times as far from the median point as usual, such as a ball or a camera, are ignored, unless they are more than
/// a quarter of a frame's points.
double SpreadOf(std::span<const glm::dvec3> positions, std::size_t joints);

/// Returns the unit in which this extent is that of a person, 0.8 to 2.3 m; nullopt if there is none.
std::optional<double> UnitOfSpread(double spread);

/// How a body stands if it does not stand along Y on its feet.
enum class Standing { kNotTold, kAlongMinusY, kOnHands, kAlongZ };
/// Returns how the body stands, by the direction from knees to shoulders in at least three quarters of the frames that
/// show them. A body that is upside down stands on its hands if its wrists are near the lowest joint and if that joint
/// stays at one height.
Standing HowItStands(std::span<const glm::dvec3> positions, const std::vector<std::string>& names);

}  // namespace etude
