#include "sim/character/dressed_person.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/angles.h"
#include "sim/body/shape.h"
#include "sim/character/pieces.h"
#include "sim/character/posed.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum Role;

/// The pieces of a dressed person for the body at rest, grouped by paint.
struct DressedPieces {
  std::vector<Piece> skin, hair, eyes, top, bottom, shoes;
};

// The widths of a build's parts, relative to the medium build.
struct Girth {
  double trunk, belly, limbs, head;
};

Girth GirthOf(Build build) {
  switch (build) {
    case Build::kMedium:
      return {1, 1, 1, 1};
    case Build::kSlim:
      return {0.9, 0.86, 0.86, 0.97};
    case Build::kStout:
      return {1.12, 1.32, 1.2, 1.03};
    case Build::kChild:
      return {0.94, 1, 0.9, 1.14};
    case Build::kTall:
      return {0.95, 0.92, 0.9, 0.9};
  }
  return {1, 1, 1, 1};
}

// All lengths are in centimetres, on the standing body.
using Rings = std::vector<Tube::Ring>;

Rings Scaled(Rings rings, double by, double margin_cm = 0) {
  for (Tube::Ring& ring : rings) {
    ring.side_cm = ring.side_cm * by + margin_cm;
    ring.front_cm = ring.front_cm * by + margin_cm;
  }
  return rings;
}

// Returns the rings of a tube that is cut off at `end_cm`, where the last ring is interpolated.
Rings CutOff(const Rings& rings, double end_cm) {
  Rings cut;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (rings[i].along_cm >= end_cm) {
      if (i == 0) break;
      const Tube::Ring &a = rings[i - 1], &b = rings[i];
      const double t = (end_cm - a.along_cm) / (b.along_cm - a.along_cm);
      cut.push_back({end_cm, std::lerp(a.side_cm, b.side_cm, t), std::lerp(a.front_cm, b.front_cm, t),
                     std::lerp(a.ahead_cm, b.ahead_cm, t)});
      return cut;
    }
    cut.push_back(rings[i]);
  }
  return cut;
}

const Rings kArmRings{{-3, 4.6, 4.8}, {3, 5, 5.2},  {10, 4.9, 5},   {19, 4.3, 4.5}, {27, 3.7, 3.9},
                      {31, 3.7, 3.9}, {38, 4, 4.2}, {46, 3.4, 3.6}, {53, 2.7, 2.9}, {56, 2.6, 2.9}};
const Rings kLegRings{{-4, 8, 8.6},   {4, 8.4, 9},        {14, 8, 8.6},         {27, 6.7, 7.2}, {37, 5.6, 5.9},
                      {43, 5.3, 5.7}, {53, 5.5, 6, -0.7}, {65, 4.5, 4.9, -0.4}, {78, 3.5, 3.8}, {84, 3.4, 3.8}};

// Adds a piece and its mirror image.
void AddBoth(std::vector<Piece>& pieces, const Piece& left) {
  pieces.push_back(left);
  pieces.push_back(MirrorImage(left));
}

Tube ArmTube(Rings rings, double first_cap, double last_cap) {
  return {.name = "arm",
          .chain = {kLeftShoulder, kLeftElbow, kLeftWrist},
          .rings = std::move(rings),
          .blend_cm = 4,
          .first_cap_cm = first_cap,
          .last_cap_cm = last_cap,
          .around = 10};
}

Tube LegTube(Rings rings, double first_cap, double last_cap) {
  return {.name = "leg",
          .chain = {kLeftHip, kLeftKnee, kLeftAnkle},
          .rings = std::move(rings),
          .blend_cm = 5,
          .first_cap_cm = first_cap,
          .last_cap_cm = last_cap,
          .around = 12};
}

void AddHead(const Girth& girth, bool long_hair, const BodyPose& rest, DressedPieces& pieces) {
  const double g = girth.head;
  // Make skull, neck, nose and eyes.
  const Tube skull{.name = "skull",
                   .chain = {kHead},
                   .rings = Scaled({{-10, 4, 4.6, 2.4},
                                    {-6.5, 5.8, 7, 1.6},
                                    {-2, 7.3, 9, 0.6},
                                    {3, 8.1, 10, 0},
                                    {8, 7.8, 9.6, -0.3},
                                    {11.5, 6.3, 7.8, -0.5}},
                                   g),
                   .first_cap_cm = 1.6,
                   .last_cap_cm = 3,
                   .around = 16};
  const Tube neck{.name = "neck",
                  .chain = {kHead},
                  .rings = {{-22, 5.4, 5.4, -1}, {-12, 5, 5, -0.6}, {-6, 4.9, 4.9}},
                  .first_cap_cm = 2,
                  .last_cap_cm = 1,
                  .around = 10};
  pieces.skin.push_back(MakePiece(skull, rest));
  pieces.skin.push_back(MakePiece(neck, rest));
  pieces.skin.push_back(MakePiece(Blob{.name = "nose",
                                       .joint = kHead,
                                       .centre_cm = glm::dvec3(0, -2, 9.4) * g,
                                       .half_cm = glm::dvec3(1.2, 2.4, 1.5) * g,
                                       .tilt_deg = {-14, 0, 0},
                                       .around = 8},
                                  rest));
  AddBoth(pieces.eyes, MakePiece(Blob{.name = "eye",
                                      .joint = kHead,
                                      .centre_cm = glm::dvec3(3.1, 1.2, 8.9) * g,
                                      .half_cm = glm::dvec3(1.1, 0.8, 0.8) * g,
                                      .around = 8},
                                 rest));
  // Make a cap of hair that leaves the face free: lower rings are farther back.
  pieces.hair.push_back(MakePiece(Tube{.name = "hair",
                                       .chain = {kHead},
                                       .rings = Scaled({{-3, 6.6, 5.4, -4.6},
                                                        {1.5, 8.3, 7.2, -3.4},
                                                        {6, 8.7, 9.4, -1.6},
                                                        {9, 8.2, 10, -0.6},
                                                        {12.5, 6.4, 8, -0.6}},
                                                       g),
                                       .first_cap_cm = 2,
                                       .last_cap_cm = 3,
                                       .around = 16},
                                  rest));
  // Make long hair: a flat tube behind the neck.
  if (!long_hair) return;
  pieces.hair.push_back(MakePiece(Tube{.name = "long hair",
                                       .chain = {kHead},
                                       .rings = Scaled({{-24, 6.6, 2, -8}, {-12, 8, 3.4, -7}, {0, 8.2, 5, -5}}, g),
                                       .first_cap_cm = 3,
                                       .last_cap_cm = 2,
                                       .around = 12},
                                  rest));
}

void AddTrunk(const Girth& girth, const BodyPose& rest, DressedPieces& pieces) {
  const double g = girth.trunk, b = girth.belly;
  Rings rings{{-3, 15.8, 11.4},      {4, 15.2, 11.6},       {12, 14.4, 11, 0.3},
              {21, 14.8, 11.2, 0.4}, {31, 16.4, 11.8, 0.6}, {38, 17, 11.4, 0.2},
              {44, 15.6, 9.8, -0.2}, {48.5, 11, 7.4, -0.6}, {51, 7, 6, -0.8}};
  for (Tube::Ring& ring : rings) {
    // Rings up to 12 cm get the belly's width, rings from 36 cm the trunk's. A wide belly also moves forward.
    const double low = std::clamp((36 - ring.along_cm) / 24, 0.0, 1.0);
    ring.side_cm *= std::lerp(g, b, low);
    ring.front_cm *= std::lerp(g, b, low);
    ring.ahead_cm += 5 * (b - 1) * low;
  }
  pieces.top.push_back(MakePiece(Tube{.name = "shirt",
                                      .chain = {kHipCentre, kSpine, kShoulderCentre},
                                      .rings = std::move(rings),
                                      .blend_cm = 7,
                                      .first_cap_cm = 0.4,
                                      .last_cap_cm = 1.5,
                                      .around = 20},
                                 rest));
  // Make collars and shoulders.
  AddBoth(pieces.top, MakePiece(Tube{.name = "collar",
                                     .chain = {kShoulderCentre, kLeftShoulder},
                                     .rings = Scaled({{2, 5.4, 5.6}, {8, 5.8, 6}, {13, 5.6, 5.8}, {17, 5, 5.2}}, g),
                                     .blend_cm = 5,
                                     .first_cap_cm = 1,
                                     .last_cap_cm = 2.2,
                                     .around = 10},
                                rest));
  const double ball = 5.9 * std::lerp(1.0, girth.limbs, 0.7);
  AddBoth(pieces.top, MakePiece(Blob{.name = "shoulder",
                                     .joint = kLeftShoulder,
                                     .centre_cm = {-0.5, -0.3, 0},
                                     .half_cm = glm::dvec3(ball),
                                     .around = 12},
                                rest));
}

void AddArms(const Girth& girth, double sleeve_cm, const BodyPose& rest, DressedPieces& pieces) {
  const double g = girth.limbs;
  AddBoth(pieces.skin, MakePiece(ArmTube(Scaled(kArmRings, g), 1, 1), rest));
  AddBoth(pieces.skin,
          MakePiece(Tube{.name = "hand",
                         .chain = {kLeftWrist, kLeftHand},
                         .rings = {{-1, 2.3, 2.8}, {3, 2.3, 3.6}, {8, 2.4, 4.4}, {13, 2.1, 4.2}, {17, 1.7, 3.2}},
                         .first_cap_cm = 1,
                         .last_cap_cm = 3.5,
                         .around = 10},
                    rest));
  // Make no sleeves below 4 cm: the arm is then bare up to the shoulder.
  if (sleeve_cm < 4) return;
  const double loose = sleeve_cm < 40 ? 1.4 : 0.9;
  AddBoth(pieces.top, MakePiece(ArmTube(Scaled(CutOff(kArmRings, std::min(sleeve_cm, 55.0)), g, loose), 1, 0.2), rest));
}

/// Makes a skirt around both legs, from the waist down. Each side of the skirt follows the leg on this side.
Piece MakeSkirt(const Girth& girth, double length_cm, const BodyPose& rest) {
  Piece skirt;
  constexpr int kAround = 28, kRings = 7;
  const double waist = 15.4 * girth.belly, hem = waist + 5 + 0.16 * length_cm;
  const glm::dvec3 centre = rest[kHipCentre];
  // Add a vertex. At the waist, a vertex follows the hips; below, it follows a mix of the two legs.
  const auto add = [&](double down_cm, double side_cm, double front_cm, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Piece::Vertex vertex;
    vertex.position = centre + glm::dvec3(side_cm * c, -down_cm, front_cm * s) * 0.01;
    if (down_cm < 3) {
      vertex.joints = {kHipCentre, kHipCentre};
    } else {
      const double left = std::clamp(0.5 + 0.9 * c, 0.0, 1.0);
      vertex.joints = {kLeftHip, kRightHip};
      vertex.weights = {left, 1 - left};
    }
    skirt.vertices.push_back(vertex);
  };
  // Make rings from the waist to the hem, between two poles.
  add(-7, 0, 0, 0);
  for (int ring = 0; ring < kRings; ++ring) {
    const double t = static_cast<double>(ring) / (kRings - 1), down = std::lerp(-6.0, length_cm, t);
    const double wide = ring == 0 ? waist - 1 : std::lerp(waist + 1, hem, t);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * kPi * i / kAround, fold = 1 + 0.05 * t * std::cos(7 * angle);
      add(down, wide * fold, 0.78 * wide * fold, angle);
    }
  }
  add(length_cm, 0, 0, 0);
  // Connect the rings.
  const auto last = static_cast<std::uint32_t>(skirt.vertices.size() - 1);
  const auto at = [&](int ring, int i) { return static_cast<std::uint32_t>(1 + ring * kAround + i % kAround); };
  for (int i = 0; i < kAround; ++i) {
    skirt.triangles.push_back({0, at(0, i + 1), at(0, i)});
    for (int ring = 0; ring + 1 < kRings; ++ring) {
      skirt.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
      skirt.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
    }
    skirt.triangles.push_back({last, at(kRings - 1, i), at(kRings - 1, i + 1)});
  }
  return skirt;
}

void AddLegs(const Outfit& outfit, const Girth& girth, const BodyPose& rest, DressedPieces& pieces) {
  const double g = girth.limbs, b = girth.belly;
  pieces.bottom.push_back(MakePiece(
      Tube{.name = "pelvis",
           .chain = {kHipCentre},
           .rings = Scaled({{-10, 11, 9.5}, {-5, 15, 10.8}, {0, 15.6, 11.2}, {5, 14.6, 10.8}, {8, 13, 9.5}}, b),
           .first_cap_cm = 3,
           .last_cap_cm = 1,
           .around = 16},
      rest));
  // Make the shoes.
  AddBoth(pieces.shoes, MakePiece(Blob{.name = "shoe",
                                       .joint = kLeftAnkle,
                                       .centre_cm = {1.3, -4, 6},
                                       .half_cm = glm::dvec3(4.9, 5.6, 13.8),
                                       .tilt_deg = {8, 11.5, 0},
                                       .sole_cm = 0,
                                       .around = 12},
                                  rest));
  // Make a skirt or trousers, and the skin of the bare part of the leg.
  const double leg_cm = outfit.is_skirt ? 0 : std::min(outfit.leg_cm, 83.0);
  if (leg_cm < 70) AddBoth(pieces.skin, MakePiece(LegTube(Scaled(kLegRings, g), 2, 1), rest));
  if (outfit.is_skirt) {
    pieces.bottom.push_back(MakeSkirt(girth, outfit.skirt_cm, rest));
    return;
  }
  const double loose = leg_cm < 50 ? 1.6 : 0.9;
  AddBoth(pieces.bottom, MakePiece(LegTube(Scaled(CutOff(kLegRings, leg_cm), g, loose), 3, 0.2), rest));
  // Add a bare ankle between hem and shoe.
  if (leg_cm >= 70) {
    AddBoth(pieces.skin, MakePiece(Blob{.name = "ankle",
                                        .joint = kLeftAnkle,
                                        .centre_cm = {0, 1, 0},
                                        .half_cm = glm::dvec3(3.6 * g, 6, 3.9 * g),
                                        .around = 10},
                                   rest));
  }
}

/// Makes all pieces. Sleeves and trousers are separate tubes over arms and legs. These tubes end at the hems.
DressedPieces MakeDressedPieces(const Outfit& outfit, const BodyPose& rest) {
  const Girth girth = GirthOf(outfit.build);
  DressedPieces pieces;
  AddHead(girth, outfit.has_long_hair, rest, pieces);
  AddTrunk(girth, rest, pieces);
  AddArms(girth, outfit.sleeve_cm, rest, pieces);
  AddLegs(outfit, girth, rest, pieces);
  return pieces;
}

struct PaintedPieces {
  std::string name;
  SurfacePaint paint;
  std::vector<Piece> pieces;
};

}  // namespace

DressedPerson::DressedPerson(const Outfit& outfit) {
  const BodyPose rest = StandingPose();
  // Make the pieces, grouped by their paint.
  DressedPieces made = MakeDressedPieces(outfit, rest);
  const SurfacePaint eyes{.first = {40, 30, 28}, .second = {40, 30, 28}};
  std::vector<PaintedPieces> all;
  all.push_back({"skin", outfit.skin, std::move(made.skin)});
  all.push_back({"hair", outfit.hair, std::move(made.hair)});
  all.push_back({"eyes", eyes, std::move(made.eyes)});
  all.push_back({"top", outfit.top, std::move(made.top)});
  all.push_back({"bottom", outfit.bottom, std::move(made.bottom)});
  all.push_back({"shoes", outfit.shoes, std::move(made.shoes)});

  // Bind the pieces to the skeleton, one mesh per paint.
  CharacterBuilder builder("dressed person", rest);
  for (const PaintedPieces& painted : all) {
    const int material = builder.AddMaterial(painted.name, painted.paint.first);
    for (const Piece& piece : painted.pieces) builder.Add(material, piece);
  }
  character_ = std::move(builder).Take();
  // Prepare the data that do not depend on the pose.
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
