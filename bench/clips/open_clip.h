#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/to_body.h"

namespace etude {

/// What a reference to a clip may be told beside its name.
struct OpenOptions {
  std::optional<TaughtRoles> roles;  ///< of --joint-map
  BodyOptions body;
};

/// A clip as its file has it.
struct SourceClip {
  std::string name;  ///< "01_01", "Med_General#Dance": the file's name without folder and extension, and the animation
  std::string source;  ///< what opens it again: a path, or "path.glb#Dance"
  Clip clip;
  std::optional<Character> character;  ///< the file's own figure, when it has meshes; its skeleton is the clip's
};

/// Reads every clip of a file: one of a BVH, all animations of a glTF, or the one behind '#'. A file name that itself
/// holds a '#' is found first. Told by content, not by extension. Over 500 MB: refused before reading.
Result<std::vector<SourceClip>> ReadClipFile(const std::string& reference);

/// A clip with its roles found and its body's motion.
struct OpenedClip {
  SourceClip source;
  JointMap map;
  BodyConversion body;
};

Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options);

}  // namespace etude
