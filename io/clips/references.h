#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// The prefix of the name of a move, an act or a song.
constexpr std::string_view kBuiltinPrefix = "builtin:";

/// A built-in clip: a move, an act of the coach or a song.
struct BuiltinClip {
  BodyMotion motion;
  std::optional<Move> move;  ///< when it was authored as one with key poses; songs and acts have none
};

/// Loads the built-in clip of a name, given without the prefix. The error lists the known ones.
Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place);

/// The most clips that a reference may stand for.
constexpr std::size_t kMostClips = 1000;

/// Lists the clips that a reference stands for, in order, each opened on its own: a built-in clip ("builtin:clap";
/// "builtin:*" are all moves, "builtin:acts", "builtin:songs"), a clip of a package ("assimp:01_01", "assimp:*"; of
/// Debian's assimp-testmodels), or a file ("mocap/*.bvh", sorted; `~/` is the home
/// folder), each with the "#animation" of the pattern. A file of that very name comes before what a pattern or '#'
/// would mean. Relative names start at the current folder. Fails at `place` when nothing matches.
Result<std::vector<std::string>> ExpandReference(const std::string& reference, const Place& place);

/// Lists the clips that all references stand for, in order. Fails above `kMostClips`.
Result<std::vector<std::string>> ExpandReferences(const std::vector<std::string>& references);

/// A reference such as "dance.glb#Jump", split into the file and the animation in it. A file whose name holds a '#' is
/// found first.
struct SplitReference {
  std::string path;
  std::optional<std::string> animation;
};
SplitReference Split(const std::string& reference);

/// The file that a reference without an animation names: that of a package's clip, else itself.
std::string FileOf(const std::string& reference);

}  // namespace etude
