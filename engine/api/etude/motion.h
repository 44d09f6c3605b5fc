#pragma once

#include <etude/base.h>

#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude::engine {

using Pose = BodyPose;
using Motion = BodyMotion;

/// The user's statements about a motion file.
struct ReadingOptions {
  bool keep_floor = false;  ///< true: the body keeps the height above the floor that the file gives
  /// 'y' or 'z' overrules all other evidence; with 0, the file, its format and the body's posture decide.
  char up = 0;
  /// Metres in one unit of the file; 0: the file's own unit, or a unit derived from the body's height.
  double metres_per_unit = 0;
  std::string marker_set = "";  ///< name of the marker set for marker files, such as "opencap"; "": the best one
};

/// Reads a motion file and returns the motion of the twenty joints at `rate_hz`, in metres, Y up, with the feet on the
/// floor unless `keep_floor` is set. The content decides the format: BVH, AMASS's and Etude's own .npz, C3D, TRC,
/// Etude's own CSV, Motive's CSV. Joints are identified by their names. Unless `options` give the unit, it is the
/// file's own or is derived from the body's height. `file` is the file's name in error messages. `changes` receives one
/// sentence for users about each finding and each change that was made (unit, axis, floor, rate, composed joints).
/// Throws BadInput for other formats, for bodies without some limbs, and for markers of several people.
ETUDE_API BodyMotion ReadMotion(std::string_view bytes, const std::string& file, double rate_hz = 30,
                                const ReadingOptions& options = {}, std::vector<std::string>* changes = nullptr);

}  // namespace etude::engine
