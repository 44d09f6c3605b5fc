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
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SkinnedMesh& mesh = character_.meshes[i];
    Surface& surface = still_.emplace_back();
    surface.triangles = mesh.triangles;
    surface.parts = PartsOfTriangles(character_.skeleton, mesh);
    surface.colour = all[i].paint.first;
    surface.paint = all[i].paint;
    for (const SkinnedMesh::Vertex& vertex : mesh.vertices) surface.rest.emplace_back(vertex.position);
  }
}

Figure DressedPerson::At(const BodyPose& pose) const {
  const std::vector<GlobalTransform> globals = FilledGlobals(character_, pose);
  Figure figure;
  figure.surfaces = still_;
  for (std::size_t i = 0; i < still_.size(); ++i) {
    DeformedMesh deformed = Deform(character_.meshes[i], globals);
    figure.surfaces[i].positions = std::move(deformed.positions);
    figure.surfaces[i].normals = std::move(deformed.normals);
  }
  figure.shadow = BodyCapsules(pose);
  return figure;
}

}  // namespace etude
