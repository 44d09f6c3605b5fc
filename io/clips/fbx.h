#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/process/forked_copy.h"

namespace etude {

/// Two keys are near if they are at most this many seconds apart; between them, every curve is nearly straight.
inline constexpr double kFbxNearKeys_s = 0.1;

/// Properties of a file's keys that the module measured.
struct FbxKeyFacts {
  /// The longest time, seconds, between two consecutive keys that differ: keys of one property, or of one axis whose
  /// curve is not straight.
  double longest_s = 0;
  double step_s = 0;     ///< the longest time, seconds, for which a stepped key holds the value of one axis
  double turn_deg = 0;   ///< largest change of an angle between two keys that are not near; 0 if none is 180° or more
  double cut_s = 0;      ///< the longest time, seconds, of keys that lie outside the time span of their animation
  int empty_spans = 0;   ///< animations whose time span contains none of their keys; all of their keys are used
};

/// The function of the module `etude_clips_assimp.so`. It converts the bytes of an FBX file, prepared by PrepareTakes,
/// to a GLB file. On success it returns true; `said` then holds the GLB bytes, and `facts` describe the keys. On
/// failure it returns false, and `said` holds an error message.
using GlbOfFbxBytes = bool(std::string_view bytes, std::string& said, FbxKeyFacts& facts);

/// Returns true if `bytes` begin like a binary or text FBX file.
bool IsFbx(std::string_view bytes);

/// The motion of an FBX file.
struct FbxMotion {
  std::string glb;          ///< a GLB file with the nodes and animations of the FBX file, in metres, Y up
  std::string reader;       ///< the library that read the file, and its build ID: "libassimp.so.5 (0f3c…)"
  std::string remark = "";  ///< parts of the file that were left out or replaced; "" if nothing
};

/// The beginning of the error message about a file that crashed its reader; the number of the signal is appended.
inline constexpr std::string_view kReaderCrashed = "the FBX file is damaged: its reader ended with signal";

/// Reads the motion of FBX files, one after the other; meshes, materials, cameras and lights are left out. Files may be
/// hostile, so assimp reads them in a child process with limited memory and processor time. If the child dies on a
/// file, the next file gets a new child.
class FbxReader {
 public:
  /// Fails if the module is missing, if the file is damaged or too large, or if the child process dies while it reads
  /// the file.
  Result<FbxMotion> Read(std::string_view bytes, const std::string& path);

 private:
  std::optional<ForkedCopy> child_;
};

/// Reads one file in a child process of its own.
Result<FbxMotion> ReadFbx(std::string_view bytes, const std::string& path);

}  // namespace etude
