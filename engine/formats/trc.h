#pragma once

#include <string>

#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as a TRC file (Track Row Column, Motion Analysis), which OpenSim and others read as marker
/// trajectories: one marker per role, millimetres, Y up, five decimals; frames count from 1, time from 0 s. `name` is
/// told in the file's first line, with '_' for tabs and line ends.
std::string WriteTrc(const BodyMotion& motion, std::string name);

}  // namespace etude
