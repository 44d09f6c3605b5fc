// The golden value of pictures: limbs recognised by the colours of a suit. The other tests of this folder check that
// results are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/vision/limb_colours.h"
#include "tests/engine/vision/pen.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

std::uint8_t LevelFrom(double level) { return static_cast<std::uint8_t>(std::clamp(level, 0.0, 255.0)); }

/// Returns `colour` in some light, with noise of `noise` levels.
Rgb8 Noisy(testing::Dice& dice, Rgb8 colour, double light, double noise) {
  const auto seen = [&](int level) { return LevelFrom(level * light + noise * dice.Signed() + 0.5); };
  const std::uint8_t r = seen(colour.r), g = seen(colour.g);
  return {r, g, seen(colour.b)};
}

void AddRegion(Fingerprint& print, const Region& region) {
  for (const PixelRun& run : region.runs) print.Add(run.y).Add(run.x0).Add(run.x1);
  print.Add(region.pixels).Add(region.middle).Add(region.is_cut).Add(region.contrast);
}

void AddEvidence(Fingerprint& print, const PictureEvidence& seen) {
  for (const auto& limb : seen.limbs) {
    print.Add(limb.has_value());
    if (!limb) continue;
    print.Add(limb->line.a).Add(limb->line.b).Add(limb->seen_share).Add(limb->contrast).Add(limb->half_width);
  }
  print.Add(seen.joints);
}

/// Returns colours whose hues are a fourteenth of the circle apart.
LimbColours SuitOfHues() {
  const auto hue = [](std::size_t i) {
    const auto channel = [&](double from) {
      const double off = std::abs(std::remainder(360.0 / 14 * static_cast<double>(5 * i % 14) - from, 360.0));
      return LevelFrom(200 * std::clamp(2 - off / 60, 0.0, 1.0));
    };
    return Rgb8{channel(0), channel(120), channel(240)};
  };
  LimbColours suit{.trunk = hue(0), .limbs = {}};
  for (std::size_t i = 0; i < kStrokeCount; ++i) suit.limbs[i] = hue(i + 1);
  return suit;
}

struct SuitPicture {
  ColourImage picture{119, 142, {90, 90, 90}};
  Mask person{119, 142};
};

/// Returns a person in a suit, in any pose and place. Limbs cover each other in any order, are thin or thick, and may
/// be missing. The picture has noise, and spots in colours of the suit; the mask has holes.
SuitPicture AnyoneInSuit(testing::Dice& dice, bool is_flat) {
  SuitPicture made;
  const LimbColours suit = SuitOfHues();
  const glm::dvec2 hip = glm::dvec2(60, 75) + 30.0 * glm::dvec2{dice.Signed(), dice.Signed()};
  const glm::dvec2 up = glm::normalize(glm::dvec2(0.3 * dice.Signed(), -1)), aside(-up.y, up.x), neck = hip + 38.0 * up;
  struct Part {
    glm::dvec2 a, b;
    double radius;
    Rgb8 colour;
  };
  std::vector<Part> parts = {{hip, neck, 10 + 3 * dice.Signed(), suit.trunk}};
  const double size = 1 + 0.3 * dice.Signed();
  for (std::size_t chain = 0; chain < 5; ++chain) {
    const bool is_arm = chain / 2 == 1;
    glm::dvec2 from = chain == 4 ? neck : (is_arm ? neck : hip) + (chain % 2 ? 8.0 : -8.0) * aside;
    for (std::size_t i = 3 * chain; i < std::min(3 * chain + 3, kStrokeCount); ++i) {
      const double length = size * (chain == 4 ? 8 : i % 3 == 2 ? 11 : is_arm ? 18 : 25);
      const double radius = size * (chain == 4 ? 7 : 5.5 - 0.9 * (i % 3) - is_arm) + dice.Signed();
      const glm::dvec2 out = chain == 4 ? up : glm::dvec2{dice.Signed(), is_arm ? dice.Signed() : 1.0};
      const glm::dvec2 to = from + length * (0.55 + 0.45 * dice.Signed()) * glm::normalize(out);
      if (dice.Below(12) != 0) parts.push_back({from, to, radius, suit.limbs[i]});
      from = to;
    }
  }
  for (std::size_t i = parts.size(); i-- > 1;) std::swap(parts[i], parts[dice.Below(i + 1)]);
  for (const Part& part : parts) {
    DrawPen(made.picture.width, made.picture.height, part.a, part.b, part.radius, is_flat, [&](int x, int y, double) {
      made.picture.At(x, y) = Noisy(dice, part.colour, 0.7 + 0.003 * x, 9);
      made.person.At(x, y) = dice.Below(9) != 0;
    });
  }
  for (int spot = 0; spot < 6; ++spot) {
    const int width = 4 + static_cast<int>(dice.Below(4)), height = 4 + static_cast<int>(dice.Below(4));
    const int left = static_cast<int>(dice.Below(119 - width)), top = static_cast<int>(dice.Below(142 - height));
    const Rgb8 colour = spot == 0 ? suit.trunk : suit.limbs[dice.Below(kStrokeCount)];
    for (int y = top; y < top + height; ++y) {
      for (int x = left; x < left + width; ++x) made.picture.At(x, y) = colour, made.person.At(x, y) = 1;
    }
  }
  return made;
}

TEST(VisionGolden, LimbsOfColouredSuits) {
  testing::Dice dice(3);
  const LimbColours suit = SuitOfHues();
  Fingerprint print;
  for (int k = 0; k < 60; ++k) {
    LimbColourOptions options;
    const bool is_flat = k % 2;
    if (is_flat) options.look = {.figure = FigureKind::kDressed, .head_below_crown = 1.1};
    if (k % 5 == 1) options.margin_px = 1, options.reach = 0.06, options.darkest = 150;
    if (k % 5 == 2) options.piece_share = 0.6, options.min_piece_px = 45, options.min_side_px = 2;
    if (k % 5 == 3) options.border_px = 0, options.margin_px = 0, options.piece_share = 0, options.min_piece_px = 6;
    const SuitPicture made = AnyoneInSuit(dice, is_flat);
    LimbRegions found = FindColouredLimbs(made.picture, made.person, suit, options);
    print.Add(found.width).Add(found.height);
    AddRegion(print, found.trunk);
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      AddRegion(print, found.limbs[i]);
      print.Add(found.borders[i]);
      found.limbs[i].contrast = 10 + 5 * dice.Signed();
    }
    AddEvidence(print, FindLimbEvidence(found, options.look));
    const Marks marks = ReadLimbColours(made.picture, made.person, suit, options);
    for (const auto& stroke : marks.strokes) {
      print.Add(stroke.has_value());
      if (stroke) print.Add(stroke->a).Add(stroke->b);
    }
    print.Add(marks.effectors);
    // Cover regions that lack some limbs, some borders or the trunk.
    for (int variant = 0; variant < 4; ++variant) {
      LimbRegions less = found;
      for (std::size_t i = 0; i < kStrokeCount; ++i) {
        if (dice.Below(3) == 0) less.borders[i].clear();
        if (dice.Below(4) == 0) less.limbs[i] = {};
        if (dice.Below(4) == 0) less.borders[i].resize(std::min<std::size_t>(less.borders[i].size(), dice.Below(6)));
      }
      if (variant % 2) less.trunk = {};
      AddEvidence(print, FindLimbEvidence(less, options.look));
    }
  }
  EXPECT_TRUE(print.Is(66878, -3167.84249411));
}

}  // namespace
}  // namespace etude
