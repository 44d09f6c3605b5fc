#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "io/process/forked_copy.h"

namespace etude {

/// The function of the module `etude_clips_assimp.so`: makes a GLB file of the bytes of an FBX file. What it says is
/// that file, or, when it returns false, a complaint.
using GlbOfFbxBytes = bool(std::string_view bytes, std::string& said);

/// True of an FBX file, binary or text.
bool IsFbx(std::string_view bytes);

/// The motion of an FBX file.
struct FbxMotion {
  std::string glb;     ///< a GLB file of its nodes and animations, in metres, the Y axis up
  std::string reader;  ///< the library that read it, and its build ID: "libassimp.so.5 (0f3c…)"
};

/// What a complaint begins with where a file ended its reader; the signal follows.
inline constexpr std::string_view kReaderFell = "a damaged FBX file: its reader ended with signal";

/// Reads the motion of FBX files, one after the other; meshes, materials, cameras and lights are left out. assimp reads
/// them in a child process of limited memory and processor time, for files are a stranger's and may be hostile; one
/// that a file ended is begun anew.
class FbxReader {
 public:
  /// Fails when the module is not there, and when the file is damaged, too large or ends the child.
  Result<FbxMotion> Read(std::string_view bytes, const std::string& path);

 private:
  std::optional<ForkedCopy> child_;
};

/// Reads one file in a child of its own.
Result<FbxMotion> ReadFbx(std::string_view bytes, const std::string& path);

}  // namespace etude
