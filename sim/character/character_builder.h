#pragma once

#include <string>

#include "engine/base/image.h"
#include "engine/motion/character.h"
#include "sim/character/pieces.h"

namespace etude {

/// Puts pieces together to a character bound to BodySkeleton(rest): one mesh per material, normals smoothed within
/// each piece.
class CharacterBuilder {
 public:
  CharacterBuilder(std::string name, const BodyPose& rest);

  /// A paint, as seen on a screen (sRGB); the number to add pieces with.
  int AddMaterial(std::string name, Rgb8 colour);
  void Add(int material, const Piece& piece);
  /// The piece and its mirror image on the other side.
  void AddOnBothSides(int material, const Piece& piece);

  Character Take() && { return std::move(character_); }

 private:
  BodyPose rest_;
  Character character_;
};

}  // namespace etude
