#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Returns faults that no real person's motion has, as sentences for users: left and right are exchanged
/// (DescribeExchangedJoints), a joint is torn off its neighbours (FindMotionFaults), or both knees bend backwards.
/// The cause may be wrong names of joints or a mirrored axis. `frames` are in metres, Y up. A joint that a frame
/// lacks is not judged. Frames before the first one with all needed joints (kNeededJoints) are searched only for
/// exchanged joints.
std::vector<std::string> DoubtsOnBody(std::span<const JointPositions> frames, double rate_hz);

}  // namespace etude
