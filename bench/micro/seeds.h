#pragma once

#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

struct SeedClip {
  std::string name;
  BodyMotion motion;
};

/// Loads the clips of which benchmarks make libraries: the built-in moves and acts, and `files` or else three captured
/// clips of Debian's assimp-testmodels, if installed. Ends the program if a file cannot be read.
std::vector<SeedClip> LoadSeeds(const std::vector<std::string>& files);

}  // namespace etude
