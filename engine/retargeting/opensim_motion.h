#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/body.h"

namespace etude {

/// Writes a body's motion as joint angles in OpenSim's .mot format: the header "Coordinates" … "endheader", a line of
/// column names, and one line for each frame (angles in degrees, translations in metres). OpenSim's axes are X forward,
/// Y up, Z to the body's right.
///
/// The header also contains the model to which the angles belong (*ours*; OpenSim ignores these lines), with one part
/// for the pelvis and one for each of the body's nineteen bones:
///     part right_knee after right_hip bone 0 -0.4165 0 turns +Z hip_flexion_r +X hip_adduction_r +Y hip_rotation_r
///     limit hip_flexion_r -30 120
/// A part begins at the end of the part named after `after`, is rotated relative to that part by R = Rz Rx Ry with the
/// given signs, and ends at R · bone from there. Flexion, adduction, inversion and internal rotation are positive on
/// both sides, and so is extension of the trunk and the neck. An angle that also exists in OpenSim's models has the
/// name that it has there. Limits come from LimitSet::kAdult; an angle without a limit line has no limits. Angles are
/// continuous from frame to frame, without jumps of full turns.
///
/// All rotations are the identity in `rest`. The limbs have the directions of the motion's limbs but the lengths of
/// `rest`. `name` is written to the header with control characters replaced by '_'. Times count from `start_s`.
std::string WriteOpenSimMotion(const BodyMotion& motion, const BodyPose& rest, std::string name, double start_s = 0);

/// Returns true if these bytes are a .mot file that contains the model of its angles.
bool HasModelOfAngles(std::string_view bytes);

/// Reads a .mot file that contains the model of its angles, as WriteOpenSimMotion writes it. Returns the positions of
/// the twenty parts' ends as joints, metres, Y up. `LayOnClock` resamples rows to a constant rate by their times, and
/// `note` states what was changed; a single row has 30 Hz. `start_s` becomes the time of the first row. Angles are
/// degrees after "inDegrees=yes" and radians after "inDegrees=no", in any case and with blanks. Without this line they
/// are radians if the largest is 0.5 to 2π, else degrees, and `note` says so; it also says if angles after
/// "inDegrees=yes" are as small. Fails, with the line, for more than 64 MB, parts that are not the twenty
/// roles (each once, after its parent), angles or translations without a column, rows of another length, numbers beyond
/// ±10⁹, no rows, and times that run backwards.
Result<BodyMotion> ReadOpenSimMotion(std::string_view bytes, const std::string& file, std::string* note = nullptr,
                                     double* start_s = nullptr);

}  // namespace etude
