#include "sim/stage/wardrobe.h"

#include <array>

#include "sim/random/stream.h"
#include "sim/stage/palette.h"

namespace etude {
namespace {

// The colours of the studio's performer (PerformerColours), and of the hair that is drawn on the head.
constexpr Rgb8 kStudioSkin{232, 168, 128}, kStudioTop{230, 92, 66}, kStudioBottom{150, 46, 88};
constexpr Rgb8 kStudioShoes{240, 186, 76}, kStudioHair{66, 33, 20};

SurfacePaint Cloth(const Hsv& first, const Hsv& second, Pattern pattern, double size) {
  return {.first = ToRgb(first), .second = ToRgb(second), .pattern = pattern, .size = size, .is_cloth = true};
}

SurfacePaint Plain(const Hsv& colour) {
  const Rgb8 rgb = ToRgb(colour);
  return {.first = rgb, .second = rgb};
}

// The colour of a garment, and the second colour of the garment's pattern.
struct Dye {
  Hsv first, second;
};

Dye DrawDye(RandomStream& random, Rgb8 studio, double share) {
  const Hsv from = ToHsv(studio), first = DrawColour(random), second = DrawColour(random);
  const double lighter = random.Uniform(0.55, 1.35);
  const Hsv studio_second{from.hue, from.saturation * 0.8, from.value * (lighter > 0.95 ? 0.7 : lighter)};
  return {Mixed(from, first, share), Mixed(studio_second, second, share)};
}

SurfacePaint DrawTop(RandomStream& random, double share) {
  const Dye dye = DrawDye(random, kStudioTop, share);
  constexpr std::array kPatterns = {Pattern::kPlain, Pattern::kBands, Pattern::kChecks, Pattern::kTwoTone,
                                    Pattern::kStripes};
  const Pattern pattern = kPatterns[random.IndexBelow(kPatterns.size())];
  const double width = random.Uniform(0.05, 0.12), seam_height = random.Uniform(1.12, 1.28);
  SurfacePaint top = Cloth(dye.first, dye.second, pattern, pattern == Pattern::kTwoTone ? seam_height : width);
  const bool has_logo = random.Chance(0.5);
  const glm::dvec2 half{random.Uniform(0.04, 0.09), random.Uniform(0.03, 0.07)};
  if (has_logo && pattern != Pattern::kChecks) {
    top.patch = {0.02, 1.29};
    top.patch_half = half;
  }
  return top;
}

SurfacePaint DrawBottom(RandomStream& random, double share) {
  const Dye dye = DrawDye(random, kStudioBottom, share);
  constexpr std::array kPatterns = {Pattern::kPlain, Pattern::kPlain, Pattern::kChecks, Pattern::kStripes};
  const Pattern pattern = kPatterns[random.IndexBelow(kPatterns.size())];
  return Cloth(dye.first, dye.second, pattern, random.Uniform(0.06, 0.14));
}

SurfacePaint DrawSkin(RandomStream& random, double share) {
  const double depth = random.Uniform();
  const Hsv tone{random.Uniform(14, 28), 0.28 + 0.32 * depth, 0.95 - 0.55 * depth};
  return Plain(Mixed(ToHsv(kStudioSkin), tone, share));
}

SurfacePaint DrawHair(RandomStream& random, double share) {
  const double light = random.Uniform();
  const Hsv tone{random.Uniform(15, 42), random.Uniform(0.25, 0.6), 0.12 + 0.6 * light * light};
  SurfacePaint hair = Plain(Mixed(ToHsv(kStudioHair), tone, share));
  hair.second = {static_cast<std::uint8_t>(hair.first.r * 3 / 4), static_cast<std::uint8_t>(hair.first.g * 3 / 4),
                 static_cast<std::uint8_t>(hair.first.b * 3 / 4)};
  hair.pattern = Pattern::kStripes;
  hair.size = 0.012;
  return hair;
}

void DressEveryday(Outfit& outfit) {
  outfit.top.first = {190, 190, 190};
  outfit.top.second = {165, 165, 168};
  outfit.bottom.first = {35, 45, 80};
  outfit.bottom.second = {30, 38, 66};
  outfit.shoes = {.first = {50, 45, 45}, .second = {50, 45, 45}};
}

void DressCoded(Outfit& outfit) {
  outfit.sleeve_cm = 55;
  outfit.leg_cm = 83;
  outfit.is_skirt = outfit.has_long_hair = false;
  outfit.suit = CodedSuit();
}

}  // namespace

PartColours CodedSuit() {
  using enum Part;
  constexpr std::array kOrder = {kTrunk,       kLeftThigh,     kLeftShank,    kLeftFoot,   kLeftUpperArm,
                                 kLeftForearm, kLeftHand,      kHead,         kRightThigh, kRightShank,
                                 kRightFoot,   kRightUpperArm, kRightForearm, kRightHand};
  constexpr double kFirstHue = 250, kHues = 240;  // degrees: hues from 250 through 360 to 130
  constexpr std::size_t kStep = 5;                // number of hues between consecutive limbs of kOrder
  PartColours suit{};
  for (std::size_t i = 0; i < kOrder.size(); ++i) {
    const auto hue = static_cast<double>(kStep * i % kOrder.size());
    suit[static_cast<std::size_t>(kOrder[i])] = ToRgb({kFirstHue + kHues * hue / (kOrder.size() - 1), 1, 0.82});
  }
  return suit;
}

Outfit MakeOutfit(std::uint64_t seed, const std::string& who, Wardrobe wardrobe, double colour_share) {
  const WorldKey key{seed, "stage", 0};
  RandomStream cut(key, who + "/cut"), skin(key, who + "/skin"), hair(key, who + "/hair");
  RandomStream top(key, who + "/top"), bottom(key, who + "/bottom"), shoes(key, who + "/shoes");
  Outfit outfit;
  constexpr std::array kBuilds = {Build::kMedium, Build::kSlim, Build::kStout, Build::kChild, Build::kTall};
  outfit.build = kBuilds[cut.IndexBelow(kBuilds.size())];
  constexpr std::array kSleeves = {2.0, 14.0, 22.0, 38.0, 54.0};
  outfit.sleeve_cm = kSleeves[cut.IndexBelow(kSleeves.size())];
  constexpr std::array kLegs = {24.0, 36.0, 60.0, 80.0, 80.0, 80.0};
  outfit.leg_cm = kLegs[cut.IndexBelow(kLegs.size())];
  outfit.is_skirt = cut.Chance(0.2);
  outfit.skirt_cm = cut.Uniform(30, 58);
  outfit.has_long_hair = cut.Chance(0.4);
  outfit.skin = DrawSkin(skin, colour_share);
  outfit.hair = DrawHair(hair, colour_share);
  outfit.top = DrawTop(top, colour_share);
  outfit.bottom = DrawBottom(bottom, colour_share);
  outfit.shoes = Plain(DrawDye(shoes, kStudioShoes, colour_share).first);
  if (wardrobe == Wardrobe::kEveryday) DressEveryday(outfit);
  if (wardrobe == Wardrobe::kCoded) DressCoded(outfit);
  return outfit;
}

}  // namespace etude
