#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/trc.h"

namespace etude {

/// The points of a C3D file.
struct C3d {
  MarkerMotion markers;  ///< metres; names as the file's labels have them, those without one "point 7"
  std::string unit;      ///< that the file names, such as "mm"; "" = none, taken for millimetres
  char up = 0;           ///< 'Y' or 'Z', where POINT:Y_SCREEN tells it; else 0
  double step_m = 0;     ///< of a file of whole numbers: between two that follow each other; 0 of floats
};

/// Tells whether bytes begin as a C3D file does: a block number and the key 0x50.
bool IsC3d(std::string_view bytes);

/// Reads the points of a C3D file (c3d.org's format): of Intel, DEC and MIPS machines, of whole numbers or floats, with
/// parameters wherever the header says, more than 255 points (LABELS2 …), more than 65,535 frames (TRIAL's fields). A
/// point whose residual is below zero, or that is no finite number, was not seen. Analogue channels, rotations and
/// events are passed over. Refused: what is not C3D, a file cut short, no points, no rate, units other than m, cm, mm,
/// in, ft, more than 10,000 points or 10⁷ frames.
Result<C3d> ReadC3d(std::string_view bytes, const std::string& file);

/// Writes trajectories as a C3D file of an Intel machine: floats, millimetres, Y up on the screen; what was not seen
/// has a residual of −1. Names longer than 127 bytes are cut. At most 65,535 markers.
std::string WriteC3d(const MarkerMotion& motion);
/// Writes a body's joints as such a file, one marker per role.
std::string WriteC3d(const BodyMotion& motion);

}  // namespace etude
