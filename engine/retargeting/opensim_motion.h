#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a body's motion as joint angles in OpenSim's .mot: the header "Coordinates" … "endheader", a line of names, a
/// line of degrees (translations: metres) a frame. OpenSim's axes: X forward, Y up, Z to the body's right.
///
/// The header also tells the model that the angles are of (*ours*; OpenSim passes these lines over), a part for each of
/// the nineteen limbs and one for the pelvis:
///     part right_knee after right_hip bone 0 -0.4165 0 turns +Z hip_flexion_r +X hip_adduction_r +Y hip_rotation_r
///     limit hip_flexion_r -30 120
/// A part begins where the part `after` which it stands ends, turns against that one's axes by R = Rz Rx Ry, signs as
/// told, and ends at R · bone. Flexion, adduction, inversion and inner rotation are positive on both sides, extension
/// of the trunk and the neck too. Names are those of OpenSim's models where a part is theirs. Limits are those of
/// LimitSet::kAdult; an angle without a line has none. Angles go on from frame to frame without jumps of whole turns.
///
/// `rest` is the pose in which nothing turns; the limbs keep its lengths, those of the motion are lost: bones point
/// where the motion's do. `name` is told in the header, control characters as '_'.
std::string WriteOpenSimMotion(const BodyMotion& motion, const BodyPose& rest, std::string name);

/// Says whether these bytes are a .mot file that tells the model which its angles are of.
bool HasModelOfAngles(std::string_view bytes);

/// Reads such a .mot through its own model: where the twenty parts end, metres, Y up. The rate is that of the times,
/// which stand evenly; of a single row 30 Hz. Angles are degrees, or radians after "inDegrees=no". Refused, with the
/// line: over 64 MB, parts that are not the twenty roles, each once and after the one that it follows, angles or places
/// without a column, rows of another length, numbers beyond ±10⁹, no rows, uneven times.
Result<BodyMotion> ReadOpenSimMotion(std::string_view bytes, const std::string& file);

}  // namespace etude
