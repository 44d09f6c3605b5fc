#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// The prefix of the names of built-in moves, acts and songs.
constexpr std::string_view kBuiltinPrefix = "builtin:";

/// A built-in clip: a move, an act of the coach or a song.
struct BuiltinClip {
  BodyMotion motion;
  std::optional<Move> move;  ///< the authored move with its key poses; absent for songs and acts
};

/// Loads a built-in clip by the clip's name without the prefix. The error lists the known names.
Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place);

/// The maximum number of clips that a reference may stand for.
constexpr std::size_t kMaxClips = 1000;
/// The maximum number of clips for a reference whose clips are read one by one. At this maximum, clips of ten seconds
/// last 278 hours in total. This limit only guards against patterns that match a whole disk.
constexpr std::size_t kMaxLibraryClips = 100'000;

/// Lists the clips that a reference stands for, in order. Each entry of the list is a reference to one clip. A
/// reference is a built-in clip ("builtin:clap"; "builtin:*" stands for all moves, "builtin:acts" for all acts,
/// "builtin:songs" for all songs), a clip of a package ("assimp:01_01", "assimp:*"; of Debian's assimp-testmodels), or
/// a file or pattern ("mocap/*.bvh", sorted; `~/` is the home folder), optionally with "#animation". If a file of
/// exactly that name exists, patterns and '#' are not interpreted. Relative names start at the current folder. Fails at
/// `place` if nothing matches, if more than `most` clips match, or if the name of a match is not UTF-8.
Result<std::vector<std::string>> ExpandReference(const std::string& reference, const Place& place,
                                                 std::size_t most = kMaxClips);

/// Lists the clips that all references stand for, in order. Fails if there are more than `most` clips.
Result<std::vector<std::string>> ExpandReferences(const std::vector<std::string>& references,
                                                  std::size_t most = kMaxClips);

/// A reference such as "dance.glb#Jump", split into the file and the animation. If a file exists whose whole name is
/// the reference, the reference is not split.
struct SplitReference {
  std::string path;
  std::optional<std::string> animation;
};
SplitReference Split(const std::string& reference);

/// Returns the file of a reference that has no "#animation": for a package's clip, its file in the package's folder;
/// otherwise the reference itself.
std::string FileOf(const std::string& reference);

}  // namespace etude
