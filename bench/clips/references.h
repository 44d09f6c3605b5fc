#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

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
