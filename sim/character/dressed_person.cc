#include "sim/character/dressed_person.h"

#include <utility>

#include "sim/body/shape.h"
#include "sim/character/character_builder.h"
#include "sim/character/dressed_pieces.h"
#include "sim/character/posed.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

struct PaintedPieces {
  std::string name;
  SurfacePaint paint;
  std::vector<Piece> pieces;
};

}  // namespace

DressedPerson::DressedPerson(const Outfit& outfit) {
  const BodyPose rest = StandingPose();
  DressedPieces made = MakeDressedPieces(outfit, rest);
  const SurfacePaint eyes{.first = {40, 30, 28}, .second = {40, 30, 28}};
  std::vector<PaintedPieces> all;
  all.push_back({"skin", outfit.skin, std::move(made.skin)});
  all.push_back({"hair", outfit.hair, std::move(made.hair)});
  all.push_back({"eyes", eyes, std::move(made.eyes)});
  all.push_back({"top", outfit.top, std::move(made.top)});
  all.push_back({"bottom", outfit.bottom, std::move(made.bottom)});
  all.push_back({"shoes", outfit.shoes, std::move(made.shoes)});

  CharacterBuilder builder("dressed person", rest);
  for (const PaintedPieces& painted : all) {
    const int material = builder.AddMaterial(painted.name, painted.paint.first);
    for (const Piece& piece : painted.pieces) builder.Add(material, piece);
  }
  character_ = std::move(builder).Take();
  still_ = StillSurfaces(character_, PartsOfJoints(character_.skeleton));
  for (std::size_t i = 0; i < all.size(); ++i) {
    Surface& surface = still_[i];
    surface.is_closed = true;
    surface.by_part = outfit.suit;
    if (outfit.suit) continue;
    surface.paint = all[i].paint;
    for (const SkinnedMesh::Vertex& vertex : character_.meshes[i].vertices) surface.rest.emplace_back(vertex.position);
  }
}

Figure DressedPerson::At(const BodyPose& pose) const {
  Figure figure = FigureAt(character_, still_, FilledGlobals(character_, pose));
  figure.shadow = BodyCapsules(pose);
  return figure;
}

}  // namespace etude
