#include <array>

#include "sim/character/characters.h"
#include "sim/character/pieces.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum Role;

// Colours in sRGB: warm hues like the captured performer's, but unlike the room's.
constexpr Rgb8 kWood{208, 192, 170};
constexpr Rgb8 kAccent{206, 92, 52};

// All lengths are in centimetres. The model is an artist's lay figure: turned wood, with balls at the joints.

const Tube kPelvis{.name = "pelvis",
                   .chain = {kHipCentre},
                   .rings = {{-7, 6.5, 7}, {-3, 9.5, 9}, {2, 12, 10.2}, {8, 12.5, 9.8}, {11, 10.5, 8.5}},
                   .first_cap_cm = 3,
                   .last_cap_cm = 2,
                   .around = 16};
const Blob kWaist{.name = "waist", .joint = kSpine, .centre_cm = {0, -6, 0}, .half_cm = {9.5, 7.5, 7.5}};
const Tube kChest{.name = "chest",
                  .chain = {kSpine},
                  .rings = {{-2, 10.5, 8.5},
                            {4, 12.5, 10, 0.3},
                            {14, 15, 11, 0.5},
                            {21, 15, 10.5, 0},
                            {26, 12, 8, -0.3},
                            {29, 8, 6, -0.5}},
                  .first_cap_cm = 2,
                  .last_cap_cm = 2,
                  .around = 16};
/// The neck follows the head, which rotates about the base of the neck in the chest.
const Tube kNeck{.name = "neck",
                 .chain = {kHead},
                 .rings = {{-22, 4.9, 4.9, -1}, {-12, 4.6, 4.6, -0.6}, {-6, 4.5, 4.5}},
                 .first_cap_cm = 2,
                 .last_cap_cm = 1,
                 .around = 10};
const Tube kSkull{.name = "skull",
                  .chain = {kHead},
                  .rings = {{-10, 4, 4.6, 2.4},
                            {-6.5, 5.8, 7, 1.6},
                            {-2, 7.3, 9, 0.6},
                            {3, 8.1, 10, 0},
                            {8, 7.8, 9.6, -0.3},
                            {11.5, 6.3, 7.8, -0.5}},
                  .first_cap_cm = 1.6,
                  .last_cap_cm = 3,
                  .around = 16};
const Blob kNosePiece{.name = "nose",
                 .joint = kHead,
                 .centre_cm = {0, -2, 9.4},
                 .half_cm = {1.2, 2.6, 1.6},
                 .tilt_deg = {-14, 0, 0},
                 .around = 8};
/// The headband is higher in front, which makes the direction of the head visible from afar.
const Tube kBand{.name = "headband",
                 .chain = {kHead},
                 .rings = {{5, 8.25, 10.1, -0.1}, {8, 7.85, 9.7, -0.4}},
                 .first_cap_cm = 0.3,
                 .last_cap_cm = 0.3,
                 .around = 16};

/// The limbs, made as if turned on a lathe: each is rigid, moves with the joint at its start, and is thick in the
/// middle and thin at its ends. Only the collar is not rigid: its skin is blended at the shoulder, because shoulders
/// rise with the arms.
const std::array kLimbs = {
    Tube{.name = "collar",
         .chain = {kShoulderCentre, kLeftShoulder},
         .rings = {{2, 4.6, 4.6}, {8, 4.6, 4.6}, {13, 4.2, 4.2}, {16, 2.6, 2.6}},
         .blend_cm = 5,
         .first_cap_cm = 1,
         .last_cap_cm = 2.2,
         .around = 10},
    Tube{.name = "upper arm",
         .chain = {kLeftShoulder, kLeftElbow},
         .rings = {{3, 4, 4}, {9, 4.9, 5}, {18, 4.3, 4.4}, {27, 3.3, 3.4}},
         .first_cap_cm = 2,
         .last_cap_cm = 1,
         .around = 10},
    Tube{.name = "forearm",
         .chain = {kLeftElbow, kLeftWrist},
         .rings = {{3, 3.3, 3.4}, {8, 4, 4.2}, {15, 3.4, 3.6}, {22.5, 2.4, 2.7}},
         .first_cap_cm = 1,
         .last_cap_cm = 1,
         .around = 10},
    Tube{.name = "hand",
         .chain = {kLeftWrist, kLeftHand},
         .rings = {{2, 1.9, 2.8}, {6, 2.2, 4.2}, {11, 2, 4.1}, {15, 1.5, 3}},
         .first_cap_cm = 1,
         .last_cap_cm = 3,
         .around = 10},
    Tube{.name = "thigh",
         .chain = {kLeftHip, kLeftKnee},
         .rings = {{3, 6.6, 7}, {11, 7.8, 8.4}, {24, 6.6, 7}, {37.5, 4.6, 4.9}},
         .first_cap_cm = 3,
         .last_cap_cm = 1.5,
         .around = 12},
    Tube{.name = "shank",
         .chain = {kLeftKnee, kLeftAnkle},
         .rings = {{4, 4.5, 4.8}, {12, 5.3, 5.8, -0.8}, {24, 4.2, 4.6, -0.4}, {38, 2.9, 3.3}},
         .first_cap_cm = 1.5,
         .last_cap_cm = 1,
         .around = 12},
};
const std::array kBalls = {
    Blob{.name = "shoulder", .joint = kLeftShoulder, .centre_cm = {0, 0, 0}, .half_cm = {5.5, 5.5, 5.5}, .around = 12},
    Blob{.name = "elbow", .joint = kLeftElbow, .centre_cm = {0, 0, 0}, .half_cm = {3.7, 3.7, 3.7}, .around = 10},
    Blob{.name = "wrist", .joint = kLeftWrist, .centre_cm = {0, 0, 0}, .half_cm = {2.6, 2.6, 2.6}, .around = 10},
    Blob{.name = "hip", .joint = kLeftHip, .centre_cm = {0, 0, 0}, .half_cm = {7.6, 7.6, 7.6}, .around = 12},
    Blob{.name = "knee", .joint = kLeftKnee, .centre_cm = {0, 0, 0.3}, .half_cm = {5, 5, 5}, .around = 12},
    Blob{.name = "ankle", .joint = kLeftAnkle, .centre_cm = {0, 0, 0}, .half_cm = {3.5, 3.5, 3.5}, .around = 10},
};
const Blob kFootPiece{.name = "foot",
                 .joint = kLeftAnkle,
                 .centre_cm = {1.3, -4.2, 6},
                 .half_cm = {4.6, 5.4, 13.5},
                 .tilt_deg = {8, 11.5, 0},
                 .sole_cm = 0,
                 .around = 12};

}  // namespace

Character MannequinCharacter() {
  const BodyPose rest = StandingPose();
  CharacterBuilder mannequin("mannequin", rest);
  const int wood = mannequin.AddMaterial("wood", kWood);
  for (const Tube& tube : {kPelvis, kChest, kNeck, kSkull}) mannequin.Add(wood, MakePiece(tube, rest));
  mannequin.Add(wood, MakePiece(kNosePiece, rest));
  for (const Tube& limb : kLimbs) mannequin.AddOnBothSides(wood, MakePiece(limb, rest));
  mannequin.AddOnBothSides(wood, MakePiece(kFootPiece, rest));

  const int accent = mannequin.AddMaterial("accent", kAccent);
  mannequin.Add(accent, MakePiece(kBand, rest));
  mannequin.Add(accent, MakePiece(kWaist, rest));
  for (const Blob& ball : kBalls) mannequin.AddOnBothSides(accent, MakePiece(ball, rest));
  return std::move(mannequin).Take();
}

}  // namespace etude
