#pragma once

#include <span>
#include <string_view>

#include "sim/choreography/controls.h"

namespace etude {

/// Two poses that anyone tells apart, and paper A's distance hardly does: its features know how far a limb is raised,
/// not in which direction, and their membership functions are flat where nothing was thought to happen.
struct BlindSpot {
  std::string_view name;  ///< "arm forward or sideways"
  Controls a, b;          ///< performed by the body of the built-in moves
};

/// Eight of them.
std::span<const BlindSpot> BlindSpots();

}  // namespace etude
