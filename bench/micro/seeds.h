#pragma once

#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

struct SeedClip {
  std::string name;
  BodyMotion motion;
};

/// Loads the clips from which benchmarks make libraries: the built-in moves and acts, and the clips in `files`. If
/// `files` is empty, three captured clips of Debian's assimp-testmodels are added instead, if installed. Ends the
/// program if a file cannot be read.
std::vector<SeedClip> LoadSeeds(const std::vector<std::string>& files);

}  // namespace etude
