#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/trc.h"

namespace etude {

/// The points of a C3D file.
struct C3d {
  /// Positions in metres; names are the file's labels, or, without a label, for example "point 7".
  MarkerMotion markers;
  std::string unit;  ///< the file's unit, for example "mm"; "" if the file gives none, which means millimetres
  char up = 0;       ///< up axis 'X', 'Y' or 'Z' if POINT:Y_SCREEN gives it, else 0
  bool is_up_negative = false;  ///< true if the axis `up` points down
  double step_m = 0;  ///< smallest difference of two coordinates if they are stored as whole numbers; 0 for floats
};

/// Returns true if bytes begin like a C3D file: a block number and the key 0x50.
bool IsC3d(std::string_view bytes);

/// Reads the points of a C3D file (c3d.org's format). Accepted are files of Intel, DEC and MIPS machines, whole numbers
/// and floats, parameters at any block, more than 255 points (LABELS2 …) and more than 65,535 frames (TRIAL's fields,
/// LONG_FRAMES). POINT:FRAMES is the number of frames; without it, TRIAL or the header states it. The markers' `remark`
/// states if data follow the last frame, if these numbers differ, or if the header's rate differs from POINT:RATE.
/// Points that are listed as angles, forces, moments, powers, scalars or reactions (POINT:ANGLES … and lists of such a
/// type in POINT:TYPE_GROUPS) are not positions and are left out. A point with a negative residual or without finite
/// coordinates counts as not seen. Analogue channels, rotations and events are ignored. Joint widths, which Vicon
/// writes in millimetres as PROCESSING:LKNEEWIDTH and so on, become the markers' `sizes_m`. Returns an error if the
/// file is not C3D or is truncated, has no points or no rate, has a unit other than m, cm, mm, in, ft, or has more than
/// 10,000 points or 10⁷ frames.
Result<C3d> ReadC3d(std::string_view bytes, const std::string& file);

/// Returns the start time, in seconds, that WriteC3d states for a motion that begins at `start_s`: C3D counts whole
/// frames from 0 s, up to 4·10⁹.
double StartInC3d(double start_s, double rate_hz, std::size_t frames);

/// Writes trajectories as a C3D file of an Intel machine, as floats in millimetres; POINT:Y_SCREEN states that Y points
/// up, and the number of the first frame states the start time (StartInC3d). A marker that was not seen is written with
/// the residual −1. Names longer than 127 bytes are cut. Precondition: at most 65,535 markers.
std::string WriteC3d(const MarkerMotion& motion);
/// Writes a body's joints as a C3D file with one marker per role.
std::string WriteC3d(const BodyMotion& motion);

}  // namespace etude
