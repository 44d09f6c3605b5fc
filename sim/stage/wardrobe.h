#pragma once

#include <cstdint>
#include <string>

#include "sim/character/outfit.h"

namespace etude {

/// How people are dressed.
enum class Wardrobe {
  kStudio,    ///< the captured performer's warm colours, which give way to everyday ones as `scene` grows
  kEveryday,  ///< a grey shirt and dark blue trousers at any `scene`
};

/// What `who` wears on the stage of this seed. Builds, cuts and patterns are the seed's alone; the colours lie
/// `colour_share` of the way from the studio's to those of everyday things.
Outfit MakeOutfit(std::uint64_t seed, const std::string& who, Wardrobe wardrobe, double colour_share);

}  // namespace etude
