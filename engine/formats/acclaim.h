#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// A skeleton of Acclaim's ASF, as CMU's recordings have it. A bone is a joint where the bone begins; bones that
/// nothing follows end in an end site. All joints of the rest pose have the world's axes.
struct AcclaimSkeleton {
  /// A number that a motion tells of a bone: a move along or a turn about X, Y or Z.
  struct Channel {
    bool turns = true;
    int axis = 0;
  };
  Skeleton skeleton;                           ///< "root" first; the file's unit
  std::vector<std::vector<Channel>> channels;  ///< of each joint, in the order in which a motion tells them
  std::vector<glm::dquat> axes;                ///< of each joint: in which its turns are told
  bool in_degrees = true;
};

/// Tells whether a text begins like a motion (AMC): after remarks, a line ":FULLY-SPECIFIED" or ":DEGREES".
bool IsAcclaimMotion(std::string_view text);

/// Reads an ASF. Refused, with file:line:column: what is not Acclaim's, lengths of bones as channels, bones that are
/// told twice or hang on none, numbers beyond ±10⁹, more than 1,000 bones.
Result<AcclaimSkeleton> ReadAcclaimSkeleton(std::string_view text, const std::string& file);

/// Reads an AMC on such a skeleton. The file tells no rate: CMU's have 120 Hz. Refused: bones that the skeleton lacks,
/// another count of numbers than its channels, frames that are not numbered one after the other, no frames.
Result<Clip> ReadAcclaimMotion(std::string_view text, const AcclaimSkeleton& skeleton, const std::string& file);

}  // namespace etude
