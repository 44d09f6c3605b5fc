#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// A skeleton from Acclaim's ASF format, which CMU's recordings use. Each bone becomes a joint at the bone's beginning;
/// bones without children get an end site. In the rest pose, the axes of all joints are parallel to the world's.
struct AcclaimSkeleton {
  /// One number per frame of a motion: a bone's translation along X, Y or Z, or its rotation about X, Y or Z.
  struct Channel {
    bool turns = true;
    int axis = 0;
  };
  Skeleton skeleton;  ///< "root" comes first; lengths are in the file's unit
  /// For each joint: its channels, in the order of their values in a motion file.
  std::vector<std::vector<Channel>> channels;
  std::vector<glm::dquat> axes;  ///< per joint: rotation from the axes of the joint's channels to the joint's frame
  bool in_degrees = true;
  std::string remark = "";  ///< message about angles that are impossible in the stated unit; "" if there are none
};

/// Returns true if `text` begins with a line ":FULLY-SPECIFIED", ":DEGREES" or ":RADIANS" in any case, or if its lines
/// that begin with ':' are followed by the number of a frame, as in a motion file (AMC). Lines of comments are ignored.
bool IsAcclaimMotion(std::string_view text);

/// Facts about a motion file that its clip does not have.
struct AcclaimFacts {
  bool has_rate = false;  ///< true if the file states its rate
  std::vector<std::string> remarks = {};
};

/// Reads an ASF file. If an angle exceeds 4π radians, all angles are read as degrees, whatever unit the file states.
/// Returns an error with file:line:column if the text is not an ASF file, if bone lengths are channels, if a bone is
/// defined twice or not connected, if a number is beyond ±10⁹, or if there are more than 1,000 bones.
Result<AcclaimSkeleton> ReadAcclaimSkeleton(std::string_view text, const std::string& file);

/// Reads an AMC file for a skeleton of ReadAcclaimSkeleton. A line :SAMPLES-PER-SECOND states the rate; without it,
/// 120 Hz is assumed, the rate of CMU's recordings. Angles have the unit that the file states, otherwise the skeleton's
/// unit. If an angle of a bone below the root exceeds 4π radians, all angles are read as degrees. `facts` (may be null)
/// receives the skeleton's remark, a sentence if the unit was changed or may be wrong, and the names of unknown lines
/// with ':'. Returns an error for bones that the skeleton lacks, a wrong number of values, frames that are not numbered
/// consecutively, no frames, or frames that take more than 1 GB in total.
Result<Clip> ReadAcclaimMotion(std::string_view text, const AcclaimSkeleton& skeleton, const std::string& file,
                               AcclaimFacts* facts = nullptr);

}  // namespace etude
