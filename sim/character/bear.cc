#include "sim/character/character_builder.h"
#include "sim/character/characters.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

using enum Role;

// Colours, sRGB.
constexpr Rgb8 kFur{222, 155, 72};
constexpr Rgb8 kLightFur{250, 224, 178};
constexpr Rgb8 kDark{58, 36, 28};
constexpr Rgb8 kBlush{240, 138, 112};
constexpr Rgb8 kShine{255, 255, 255};
constexpr Rgb8 kRibbon{32, 150, 170};

// Centimetres throughout. The skeleton is an adult's, the head of a toy's size.

/// From under the seat to the throat, which the head hides. A low seat makes an adult's long legs look short.
const Tube kTrunk{.name = "trunk",
                  .chain = {kHipCentre, kSpine, kShoulderCentre},
                  .rings = {{-24, 13, 12.5, 0.5},
                            {-18, 18.6, 16.3, 0.5},
                            {-9, 21.5, 18.8, 1.4},
                            {3, 21.9, 19.5, 2.3},
                            {15, 19.8, 17.6, 2.5},
                            {28, 17.2, 14, 1.2},
                            {39, 16.8, 11.8, 0.2},
                            {46, 17, 10, 0},
                            {50, 14.5, 9, 0},
                            {53.5, 10, 7.5, 0.5}},
                  .blend_cm = 12,
                  .first_cap_cm = 3,
                  .last_cap_cm = 3,
                  .around = 16};
const Patch kTummy{.name = "tummy", .along_cm = 0, .half_along_cm = 18, .half_angle_deg = 52, .lift_cm = 0.8};
const Blob kTail{.name = "tail", .joint = kHipCentre, .centre_cm = {0, -9, -18.5}, .half_cm = {6, 6, 6}, .around = 10};

const Tube kArm{
    .name = "arm",
    .chain = {kLeftShoulder, kLeftElbow, kLeftWrist},
    .rings = {{0, 7.2, 7.2}, {22, 7.1, 7.1}, {30, 6.9, 6.9}, {38, 7.2, 7.2}, {48, 7.7, 7.7}, {64, 7.6, 8.2, 0.5}},
    .blend_cm = 7,
    .first_cap_cm = 7.2,
    .last_cap_cm = 8,
    .around = 12};
const Blob kPalm{
    .name = "palm", .joint = kLeftWrist, .centre_cm = {-6.6, -9, 0.4}, .half_cm = {1.8, 4.8, 4.8}, .around = 8};

const Tube kLeg{.name = "leg",
                .chain = {kLeftHip, kLeftKnee, kLeftAnkle},
                .rings = {{0, 11.2, 12.2}, {34, 10.4, 11}, {41.5, 10.2, 10.8}, {49, 10.3, 10.8}, {76, 10.6, 10.8}},
                .blend_cm = 8,
                .first_cap_cm = 10,
                .last_cap_cm = 4,
                .around = 12};
const Blob kFoot{.name = "foot",
                 .joint = kLeftAnkle,
                 .centre_cm = {1.5, -1.6, 7},
                 .half_cm = {11.4, 11, 19},
                 .tilt_deg = {0, 11.5, 0},
                 .sole_cm = 0,
                 .around = 14};
const Blob kSole{.name = "sole",
                 .joint = kLeftAnkle,
                 .centre_cm = {2, -6.3, 8},
                 .half_cm = {6, 0.7, 9},
                 .tilt_deg = {0, 11.5, 0},
                 .around = 8};

const Tube kHeadShape{.name = "head",
                      .chain = {kHead},
                      .rings = {{-14, 13, 11.5, 1},
                                {-9, 19.6, 16.8, 1},
                                {-2, 23, 19.4, 1},
                                {6, 22, 19.6, 0.5},
                                {13, 18.6, 17.4, 0},
                                {18, 13, 12.8, 0}},
                      .first_cap_cm = 3,
                      .last_cap_cm = 3.5,
                      .around = 20};
const Blob kEar{.name = "ear",
                .joint = kHead,
                .centre_cm = {16.4, 18.8, -1},
                .half_cm = {8.4, 8.4, 4.6},
                .tilt_deg = {0, 12, 0},
                .around = 12};
const Blob kInnerEar{.name = "inner ear",
                     .joint = kHead,
                     .centre_cm = {16.8, 18.8, 1.8},
                     .half_cm = {5.4, 5.4, 2.6},
                     .tilt_deg = {0, 12, 0},
                     .around = 12};

const Blob kMuzzle{
    .name = "muzzle", .joint = kHead, .centre_cm = {0, -5.6, 17}, .half_cm = {10.4, 7.6, 7.8}, .around = 14};
const Blob kNose{.name = "nose", .joint = kHead, .centre_cm = {0, -2, 23.6}, .half_cm = {4, 2.8, 2.4}, .around = 10};
const Rope kLip{.name = "lip", .joint = kHead, .points_cm = {{0, -4, 24.6}, {0, -7.6, 24.5}}, .radius_cm = 0.42};
const Rope kSmile{.name = "smile",
                  .joint = kHead,
                  .points_cm = {{0, -7.6, 24.6}, {2, -8.6, 24.1}, {4, -8.4, 23.6}, {5.6, -6.9, 23.4}},
                  .radius_cm = 0.42};
const Blob kEye{.name = "eye",
                .joint = kHead,
                .centre_cm = {8.8, 4.6, 17.6},
                .half_cm = {2.9, 3.8, 2.1},
                .tilt_deg = {0, 22, 0},
                .around = 10};
const Blob kGlint{
    .name = "glint", .joint = kHead, .centre_cm = {9.2, 6.3, 19.2}, .half_cm = {1.2, 1.2, 0.8}, .around = 8};
const Blob kCheek{.name = "cheek",
                  .joint = kHead,
                  .centre_cm = {15.4, -3.6, 14.4},
                  .half_cm = {3.6, 2.7, 1},
                  .tilt_deg = {0, 46, 0},
                  .around = 10};

const Blob kBow{.name = "bow",
                .joint = kShoulderCentre,
                .centre_cm = {6, -7, 12},
                .half_cm = {5.8, 4.2, 2.4},
                .tilt_deg = {0, 15, 14},
                .around = 10};
const Blob kKnot{
    .name = "knot", .joint = kShoulderCentre, .centre_cm = {0, -7, 12.6}, .half_cm = {2.3, 2.6, 2.5}, .around = 8};

}  // namespace

Character BearCharacter() {
  const BodyPose rest = StandingPose();
  CharacterBuilder bear("bear", rest);

  const int fur = bear.AddMaterial("fur", kFur);
  for (const Tube& tube : {kTrunk, kHeadShape}) bear.Add(fur, MakePiece(tube, rest));
  for (const Tube& tube : {kArm, kLeg}) bear.AddOnBothSides(fur, MakePiece(tube, rest));
  for (const Blob& blob : {kFoot, kEar}) bear.AddOnBothSides(fur, MakePiece(blob, rest));

  const int light = bear.AddMaterial("light fur", kLightFur);
  bear.Add(light, MakePiece(kTummy, kTrunk, rest));
  for (const Blob& blob : {kMuzzle, kTail}) bear.Add(light, MakePiece(blob, rest));
  for (const Blob& blob : {kInnerEar, kPalm, kSole}) bear.AddOnBothSides(light, MakePiece(blob, rest));

  const int dark = bear.AddMaterial("dark", kDark);
  bear.Add(dark, MakePiece(kNose, rest));
  bear.Add(dark, MakePiece(kLip, rest));
  bear.AddOnBothSides(dark, MakePiece(kSmile, rest));
  bear.AddOnBothSides(dark, MakePiece(kEye, rest));

  bear.AddOnBothSides(bear.AddMaterial("blush", kBlush), MakePiece(kCheek, rest));
  bear.AddOnBothSides(bear.AddMaterial("shine", kShine), MakePiece(kGlint, rest));

  const int ribbon = bear.AddMaterial("ribbon", kRibbon);
  bear.AddOnBothSides(ribbon, MakePiece(kBow, rest));
  bear.Add(ribbon, MakePiece(kKnot, rest));
  return std::move(bear).Take();
}

}  // namespace etude
