#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/rest_body.h"
#include "engine/motion/statistics.h"

namespace etude {

/// Says in plain words what no person does, so that the file or how it is read is likely at fault (ours): a fastest
/// joint of over 10 m/s in the median frame, joints (finger tips aside) over 5 cm below the floor, nothing within
/// 15 cm above the floor for over a second. `motion` is in metres with its floor at y = 0. Empty: nothing of the kind.
std::vector<std::string> RemarksOn(const BodyMotion& motion, const MotionStatistics& statistics);

/// Says how far a skeleton whose limbs keep their lengths stays off a motion whose joints slide, from 2 mm on in the
/// mean (`MeasureRigidMisfit`): so much no capture by such a skeleton can mend. Nothing below.
/// @param rest who moves
std::optional<std::string> RemarkOnSliding(const BodyMotion& motion, const RestBody& rest);

}  // namespace etude
