#include "sim/character/characters.h"
#include "sim/character/pieces.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum Role;

// Colours in sRGB.
constexpr Rgb8 kFur{222, 155, 72};
constexpr Rgb8 kLightFur{250, 224, 178};
constexpr Rgb8 kDark{58, 36, 28};
constexpr Rgb8 kBlush{240, 138, 112};
constexpr Rgb8 kShine{255, 255, 255};
constexpr Rgb8 kRibbon{32, 150, 170};

// All lengths are in centimetres. The skeleton has an adult's proportions, and the head a toy's.

/// The trunk reaches from below the seat to the throat, which the head covers. A low seat makes an adult's long legs
/// look short.
const Tube kTrunk{.name = "trunk",
                  .chain = {kHipCentre, kSpine, kShoulderCentre},
                  .rings = {{-33.5, 14, 13, 1},
                            {-28, 20.8, 18.8, 1},
                            {-19, 24.6, 22.2, 1.6},
                            {-7, 25.6, 23.4, 2.6},
                            {4, 25, 23.4, 3.2},
                            {15, 22.4, 21, 3.2},
                            {28, 18.6, 16, 1.6},
                            {39, 17.2, 12.6, 0.3},
                            {46, 17, 10, 0},
                            {50, 14.5, 9, 0},
                            {53.5, 10, 7.5, 0.5}},
                  .blend_cm = 12,
                  .first_cap_cm = 3,
                  .last_cap_cm = 3,
                  .around = 16};
const Patch kTummy{.name = "tummy", .along_cm = -4, .half_along_cm = 21, .half_angle_deg = 54, .lift_cm = 0.8};
const Blob kTail{.name = "tail", .joint = kHipCentre, .centre_cm = {0, -15, -22}, .half_cm = {7, 7, 7}, .around = 10};

const Tube kArm{
    .name = "arm",
    .chain = {kLeftShoulder, kLeftElbow, kLeftWrist},
    .rings = {{0, 7.6, 7.6}, {22, 7.6, 7.6}, {30, 7.4, 7.4}, {38, 7.7, 7.7}, {48, 8.3, 8.3}, {62, 8.3, 8.8, 0.5}},
    .blend_cm = 7,
    .first_cap_cm = 7.6,
    .last_cap_cm = 8,
    .around = 12};
const Blob kPalm{
    .name = "palm", .joint = kLeftWrist, .centre_cm = {-7.2, -8, 0.4}, .half_cm = {1.9, 5.2, 5.2}, .around = 8};

const Tube kLeg{.name = "leg",
                .chain = {kLeftHip, kLeftKnee, kLeftAnkle},
                .rings = {{0, 12, 13}, {34, 11.6, 12}, {41.5, 11.4, 11.6}, {49, 11.6, 11.8}, {76, 12.2, 12.4}},
                .blend_cm = 8,
                .first_cap_cm = 10,
                .last_cap_cm = 4,
                .around = 12};
const Blob kFoot{.name = "foot",
                 .joint = kLeftAnkle,
                 .centre_cm = {2.4, -0.6, 8},
                 .half_cm = {13, 12.4, 21},
                 .tilt_deg = {0, 11.5, 0},
                 .sole_cm = 0,
                 .around = 14};
const Blob kSole{.name = "sole",
                 .joint = kLeftAnkle,
                 .centre_cm = {2.8, -6.3, 9},
                 .half_cm = {7, 0.7, 10},
                 .tilt_deg = {0, 11.5, 0},
                 .around = 8};

const Tube kHeadShape{.name = "head",
                      .chain = {kHead},
                      .rings = {{-16.1, 14.9, 13.2, 1.1},
                                {-10.3, 22.5, 19.3, 1.1},
                                {-2.3, 26.4, 22.3, 1.1},
                                {6.9, 25.3, 22.5, 0.6},
                                {14.9, 21.4, 20, 0},
                                {20.7, 14.9, 14.7, 0}},
                      .first_cap_cm = 3.4,
                      .last_cap_cm = 4,
                      .around = 20};
const Blob kEar{.name = "ear",
                .joint = kHead,
                .centre_cm = {18.9, 21.6, -1.1},
                .half_cm = {9.7, 9.7, 5.3},
                .tilt_deg = {0, 12, 0},
                .around = 12};
const Blob kInnerEar{.name = "inner ear",
                     .joint = kHead,
                     .centre_cm = {19.3, 21.6, 2.1},
                     .half_cm = {6.2, 6.2, 3},
                     .tilt_deg = {0, 12, 0},
                     .around = 12};

const Blob kMuzzle{
    .name = "muzzle", .joint = kHead, .centre_cm = {0, -6.4, 19.5}, .half_cm = {12, 8.7, 9}, .around = 14};
const Blob kNose{
    .name = "nose", .joint = kHead, .centre_cm = {0, -2.3, 27.1}, .half_cm = {4.6, 3.2, 2.8}, .around = 10};
const Rope kLip{.name = "lip", .joint = kHead, .points_cm = {{0, -4.6, 28.3}, {0, -8.7, 28.2}}, .radius_cm = 0.5};
const Rope kSmile{.name = "smile",
                  .joint = kHead,
                  .points_cm = {{0, -8.7, 28.3}, {2.3, -9.9, 27.7}, {4.6, -9.7, 27.1}, {6.4, -7.9, 26.9}},
                  .radius_cm = 0.5};
const Blob kEye{.name = "eye",
                .joint = kHead,
                .centre_cm = {10.3, 4.2, 20.6},
                .half_cm = {3.6, 4.8, 2.6},
                .tilt_deg = {0, 22, 0},
                .around = 10};
const Blob kGlint{
    .name = "glint", .joint = kHead, .centre_cm = {10.9, 6.3, 22.6}, .half_cm = {1.5, 1.5, 1}, .around = 8};
const Blob kCheek{.name = "cheek",
                  .joint = kHead,
                  .centre_cm = {17.7, -4.1, 16.6},
                  .half_cm = {4.1, 3.1, 1.1},
                  .tilt_deg = {0, 46, 0},
                  .around = 10};

const Blob kBow{.name = "bow",
                .joint = kShoulderCentre,
                .centre_cm = {6, -9.5, 14},
                .half_cm = {5.8, 4.2, 2.4},
                .tilt_deg = {0, 15, 14},
                .around = 10};
const Blob kKnot{
    .name = "knot", .joint = kShoulderCentre, .centre_cm = {0, -9.5, 14.6}, .half_cm = {2.3, 2.6, 2.5}, .around = 8};

}  // namespace

Character BearCharacter() {
  const BodyPose rest = StandingPose();
  CharacterBuilder bear("bear", rest);

  // Body and ears.
  const int fur = bear.AddMaterial("fur", kFur);
  for (const Tube& tube : {kTrunk, kHeadShape}) bear.Add(fur, MakePiece(tube, rest));
  for (const Tube& tube : {kArm, kLeg}) bear.AddOnBothSides(fur, MakePiece(tube, rest));
  for (const Blob& blob : {kFoot, kEar}) bear.AddOnBothSides(fur, MakePiece(blob, rest));

  // Light fur on belly, muzzle, tail, inner ears, palms and soles.
  const int light = bear.AddMaterial("light fur", kLightFur);
  bear.Add(light, MakePiece(kTummy, kTrunk, rest));
  for (const Blob& blob : {kMuzzle, kTail}) bear.Add(light, MakePiece(blob, rest));
  for (const Blob& blob : {kInnerEar, kPalm, kSole}) bear.AddOnBothSides(light, MakePiece(blob, rest));

  // Face.
  const int dark = bear.AddMaterial("dark", kDark);
  bear.Add(dark, MakePiece(kNose, rest));
  bear.Add(dark, MakePiece(kLip, rest));
  bear.AddOnBothSides(dark, MakePiece(kSmile, rest));
  bear.AddOnBothSides(dark, MakePiece(kEye, rest));

  bear.AddOnBothSides(bear.AddMaterial("blush", kBlush), MakePiece(kCheek, rest));
  bear.AddOnBothSides(bear.AddMaterial("shine", kShine), MakePiece(kGlint, rest));

  // Bow tie.
  const int ribbon = bear.AddMaterial("ribbon", kRibbon);
  bear.AddOnBothSides(ribbon, MakePiece(kBow, rest));
  bear.Add(ribbon, MakePiece(kKnot, rest));
  return std::move(bear).Take();
}

}  // namespace etude
