#pragma once

#include <string>

#include "engine/motion/body.h"

namespace etude {

/// Writes a motion as comma-separated values with one line of headings: `frame` (from 0), `time_s`, then
/// `hip_centre_x_m`, `hip_centre_y_m`, … of every role. Metres, Y up, every digit kept.
std::string WriteJointCsv(const BodyMotion& motion);

}  // namespace etude
