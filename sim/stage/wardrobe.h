#pragma once

#include <cstdint>
#include <string>

#include "sim/character/dressed_person.h"
#include "sim/render/scene.h"

namespace etude {

/// The clothes of the people on the stage.
enum class Wardrobe {
  kStudio,    ///< the captured performer's warm colours, which give way to everyday ones as `scene` grows
  kEveryday,  ///< a grey shirt and dark blue trousers at any `scene`
  kCoded,     ///< a tight suit of which every limb has a colour of its own (`CodedSuit`), at any `scene`
};

/// Returns the coded suit: plain colours as pure and as bright as a lamp that wanders leaves them unclipped, their hues
/// 18.5° apart on the two thirds of the circle that the studio's wall and floor (150–230°) leave, with 20° of air.
/// Limbs that hang together are 92° and more apart, the two of a pair 120°. Furnished rooms have things of any hue, but
/// paler ones (palette.h).
PartColours CodedSuit();

/// Draws what `who` wears on the stage of this seed. Builds, cuts and patterns are the seed's alone; the colours lie
/// `colour_share` of the way from the studio's to those of everyday things.
Outfit MakeOutfit(std::uint64_t seed, const std::string& who, Wardrobe wardrobe, double colour_share);

}  // namespace etude
