#pragma once

#include <vector>

#include "sim/character/outfit.h"
#include "sim/character/pieces.h"

namespace etude {

/// The pieces of a dressed person on the body at rest, by what they are painted with.
struct DressedPieces {
  std::vector<Piece> skin, hair, eyes, top, bottom, shoes;
};

/// Sleeves and trousers are tubes of their own over arms and legs, and end at their hems.
DressedPieces MakeDressedPieces(const Outfit& outfit, const BodyPose& rest);

}  // namespace etude
