#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Returns faults that no real person's motion has, as sentences for users: left and right are exchanged
/// (DescribeExchangedJoints), the body is flat, as pixels of a picture are, a joint is torn off its neighbours
/// (FindMotionFaults), or both knees bend backwards. The cause may be wrong names of joints or a mirrored axis. The
/// result includes DescribeFreezes.
/// `frames` are in metres, Y up. A joint that a frame lacks is not judged. Frames before the first one with all needed
/// joints (kNeededJoints) are searched only for exchanged joints.
std::vector<std::string> DoubtsOnBody(std::span<const JointPositions> frames, double rate_hz);

/// Describes the times in which the body freezes (FaultKind::kFreezes), as where lost frames were filled with the last
/// pose; "" if there are none. The arguments are those of DoubtsOnBody.
std::string DescribeFreezes(std::span<const JointPositions> frames, double rate_hz);

/// Returns a doubt if nearly all frames show a body without depth: along one axis, the joints differ by less than 1 %
/// of the body's size, as pixels of a picture do. Even a person who stands still is a twentieth as deep as tall.
/// Returns "" otherwise.
std::string DescribeFlatBody(std::span<const JointPositions> frames);

}  // namespace etude
