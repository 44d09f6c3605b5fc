#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// What stands in front of the name of a move, an act or a song.
constexpr std::string_view kBuiltinPrefix = "builtin:";

/// A move, an act of the coach or a song.
struct BuiltinClip {
  BodyMotion motion;
  std::optional<Move> move;  ///< when it was authored as one with key poses; songs and acts have none
};

/// `name` without the prefix. The error says which there are.
Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place);

/// More clips than that are refused.
constexpr std::size_t kMostClips = 1000;

/// What a reference stands for, in order, each opened on its own: a built-in clip ("builtin:clap"; "builtin:*" are all
/// moves, "builtin:acts", "builtin:songs"), or a file ("mocap/*.bvh", sorted; `~/` is the home folder), each with the
/// "#animation" of the pattern. A file of that very name comes before what a pattern or '#' would mean. Relative
/// names start at the current folder. Fails at `place` when nothing matches.
Result<std::vector<std::string>> ExpandReference(const std::string& reference, const Place& place);

/// "dance.glb#Jump" is a file and the animation in it. A file that itself holds a '#' is found first.
struct SplitReference {
  std::string path;
  std::optional<std::string> animation;
};
SplitReference Split(const std::string& reference);

}  // namespace etude
