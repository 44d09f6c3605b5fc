#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"
#include "io/clips/clip_file.h"

namespace etude {

/// A clip as the clip's file stores it.
struct SourceClip {
  /// The file's name without folder and extension, and the animation: "01_01", "Med_General#Dance"; or "builtin:clap".
  std::string name;
  std::string source;  ///< the reference that opens the clip again: "mocap/01_01.bvh", "path.glb#Dance", "builtin:clap"
  ClipFormat format = ClipFormat::kBvh;
  Clip clip;
  /// The file's figure, if the file has meshes. The clip uses the figure's skeleton, and all clips of the file share
  /// the figure.
  std::shared_ptr<const Character> character;
  std::optional<Ground> ground = {};  ///< the floor and up axis that all clips of the file share; empty for one clip
  std::optional<MadeBody> made = {};  ///< how the body was made, if the clip is a body already (metres, Y up)
  /// Repairs made while reading the file; UnderstandClip appends them to BodyConversion::changes.
  std::vector<std::string> remarks = {};
  std::optional<JointMapOverrides> roles = {};     ///< roles that the file assigns; OpenOptions::roles has priority
  std::set<std::string> skinned = {};              ///< ClipFile::skinned
  std::shared_ptr<const RawMotion> shown = {};     ///< this clip's entry of ClipFile::shown; null if there is none
};

/// Returns the time from the first frame of the file to the first frame of the clip, seconds. It is above 0 if markers
/// show the whole body only later.
double HiddenStart(const SourceClip& source);

/// Reads the clips of one file or built-in name (as ExpandReference returns them): the one clip of a BVH, all
/// animations of a glTF, or the animation named after '#'. The animation's name may omit the prefix that exporters
/// write ("Jump" for "Armature|Jump"). If the animation does not exist, the error lists the animations of the file.
/// `options` may override the frame rate; its roles, unit and up axis are used to find the ground.
Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options = {});
/// Reads the only clip that a reference names. Fails if the reference names several clips, and the error lists these
/// clips.
Result<SourceClip> ReadOneClip(const std::string& reference, const OpenOptions& options);

/// A clip, the roles of its joints, and the motion of its body.
struct OpenedClip {
  SourceClip source;
  JointMap map;
  BodyConversion body;
};

/// Finds the roles and the body motion of a clip. Built-in clips are bodies already: they are already in metres, and
/// their position is not changed.
Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options);

}  // namespace etude
