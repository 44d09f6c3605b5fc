#pragma once

#include <cstdint>
#include <string>

#include "sim/character/dressed_person.h"
#include "sim/render/scene.h"

namespace etude {

/// The clothes of the people on stage. `scene` is the share of the furnished room in a picture: 0 = studio, 1 = room.
enum class Wardrobe {
  kStudio,    ///< the captured performer's warm colours, which become everyday colours as `scene` grows
  kEveryday,  ///< a grey shirt and dark blue trousers at any `scene`
  kCoded,     ///< a tight suit with a different colour for every limb (`CodedSuit`), at any `scene`
};

/// Returns the coded suit. The suit's colours are plain and saturated, and as bright as possible without clipping under
/// the drifting lamp. The hues are 18.5° apart, in the 240° of the circle that are at least 20° away from the hues of
/// the studio's wall and floor (150–230°). The hues of adjacent limbs differ by 92° or more, and the hues of the two
/// limbs of a pair by 129°. Furnished rooms have objects of any hue, but with paler colours (palette.h).
PartColours CodedSuit();

/// Draws the clothes of the person `who` on the stage with this seed. Builds, cuts and patterns depend only on the seed
/// and `who`; colours are interpolated by `colour_share` between the studio's colours (0) and the colours of everyday
/// objects (1).
Outfit MakeOutfit(std::uint64_t seed, const std::string& who, Wardrobe wardrobe, double colour_share);

}  // namespace etude
