#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"

namespace etude {

/// How many other poses a solver that got stuck begins at, before it gives up.
inline constexpr int kRestarts = 20;

/// The pose to begin at anew: around `start`, up to 1.5 rad from it in every angle, within `ranges`. A different one
/// for every number ≥ 1 and every start, the same at every call: no dice are thrown, and along a motion, with few
/// iterations a frame, every frame tries new ones.
void ScatterAround(std::span<const double> start, std::span<const AngleRange> ranges, int number,
                   std::vector<double>& angles);

}  // namespace etude
