#include "engine/vision/limb_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "tests/engine/vision/pen.h"

namespace etude {
namespace {

enum Stroke : std::size_t { kThigh, kShank, kFoot };  // indices in StrokeMarks, left leg
constexpr glm::dvec2 kNowhere(-1);

Rgb8 Pure(double hue_deg, double value = 200) {
  const auto channel = [&](double from) {
    const double off = std::abs(std::remainder(hue_deg - from, 360.0));
    return static_cast<std::uint8_t>(std::lround(value * std::clamp(2 - off / 60, 0.0, 1.0)));
  };
  return {channel(0), channel(120), channel(240)};
}

/// Returns hues a seventeenth of the circle apart; adjacent limbs get distant hues.
LimbColours Suit() {
  LimbColours suit{.trunk = Pure(0), .limbs = {}};
  for (std::size_t i = 0; i < kStrokeCount; ++i)
    suit.limbs[i] = Pure(360.0 / 17 * static_cast<double>(5 * (i + 1) % 17));
  return suit;
}

struct Canvas {
  ColourImage picture{200, 240, {90, 90, 90}};
  Mask person{200, 240, 1};

  /// Sets every pixel whose centre is within `radius` of the segment; with flat ends, none before a or behind b.
  void Draw(const glm::dvec2& a, const glm::dvec2& b, double radius, Rgb8 colour, bool has_flat_ends = false) {
    DrawPen(picture.width, picture.height, a, b, radius, has_flat_ends,
            [&](int x, int y, double) { picture.At(x, y) = colour; });
  }
  Marks Read() const { return ReadLimbColours(picture, person, Suit()); }
};

/// A leg of capsules. Thicker limbs are in front of thinner ones, and both joints are bent by 60° or more, so that
/// thigh and shank visibly end a radius beyond the joint. The trunk covers the thigh down to 0.94 thigh radii below
/// the hip, as a spherical pelvis with 1.37 times the thigh's radius does (√(1.37² − 1) = 0.94).
struct Leg {
  static constexpr double kThighRadius = 10, kShankRadius = 7, kFootRadius = 5;
  glm::dvec2 hip, knee, ankle, toe, down;

  explicit Leg(double turn_deg = 0) {
    const auto way = [&](double deg) {
      return glm::dvec2(std::sin(Radians(deg + turn_deg)), std::cos(Radians(deg + turn_deg)));
    };
    down = way(0);
    hip = {100, 120};
    knee = hip + 55.0 * way(0);
    ankle = knee + 45.0 * way(-65);
    toe = ankle + 25.0 * way(20);
  }

  void Draw(Canvas& canvas, const LimbColours& suit, bool has_shank = true) const {
    canvas.Draw(ankle, toe, kFootRadius, suit.limbs[kFoot]);
    if (has_shank) canvas.Draw(knee, ankle, kShankRadius, suit.limbs[kShank]);
    canvas.Draw(hip, knee, kThighRadius, suit.limbs[kThigh]);
    canvas.Draw(hip - 50.0 * down, hip + 0.94 * kThighRadius * down, 24, suit.trunk, /*has_flat_ends=*/true);
  }
};

/// Returns the largest error of the leg's stroke ends and disc; none may be missing.
double FarthestOff(const Marks& marks, const Leg& leg) {
  double off = 0;
  const std::array joints = {leg.hip, leg.knee, leg.ankle, leg.toe};
  for (const std::size_t limb : {kThigh, kShank, kFoot}) {
    if (!marks.strokes[limb]) return 1e9;
    off = std::max({off, glm::distance(marks.strokes[limb]->a, joints[limb]),
                    glm::distance(marks.strokes[limb]->b, joints[limb + 1])});
  }
  return std::max(off, glm::distance(marks.effectors[0].value_or(kNowhere), leg.toe));
}

std::size_t CountMarks(const Marks& marks) {
  const auto is_there = [](const auto& mark) { return mark.has_value(); };
  return static_cast<std::size_t>(std::ranges::count_if(marks.strokes, is_there) +
                                  std::ranges::count_if(marks.effectors, is_there));
}

TEST(ReadLimbColours, FindsTheJointsOfPaintedCapsules) {
  for (const double turn : {-40.0, -10.0, 0.0, 25.0, 45.0}) {
    Canvas canvas;
    const Leg leg(turn);
    leg.Draw(canvas, Suit());
    const Marks marks = canvas.Read();
    EXPECT_LT(FarthestOff(marks, leg), 1.5) << turn;
    EXPECT_EQ(CountMarks(marks), 4u) << "and nothing of what is not there";
  }
}

// At a straight joint, two capsules of equal radius are divided by a cut through the joint.
TEST(ReadLimbColours, PutsAStraightJointWhereTwoCapsulesMeet) {
  Canvas canvas;
  const LimbColours suit = Suit();
  const glm::dvec2 hip(60.3, 60.2), knee(82, 110), ankle = knee + (knee - hip);
  canvas.Draw(hip, ankle, 8, suit.limbs[kShank]);
  canvas.Draw(hip, knee, 8, suit.limbs[kThigh], /*has_flat_ends=*/true);
  canvas.Draw(hip + hip - knee, hip, 8, suit.trunk, /*has_flat_ends=*/true);
  const Marks marks = canvas.Read();
  ASSERT_TRUE(marks.strokes[kThigh] && marks.strokes[kShank]);
  EXPECT_LT(glm::distance(marks.strokes[kThigh]->b, knee), 1.2);
  EXPECT_EQ(marks.strokes[kThigh]->b, marks.strokes[kShank]->a) << "both limbs of a joint end in the same place";
  EXPECT_FALSE(marks.strokes[kFoot]);
}

TEST(ReadLimbColours, IsNotMisledByShadingNoiseOrMixedEdges) {
  Canvas plain;
  const Leg leg(15);
  leg.Draw(plain, Suit());
  Canvas spoilt = plain;
  for (int y = 0; y < spoilt.picture.height; ++y) {
    for (int x = 0; x < spoilt.picture.width; ++x) {
      const auto lit = [&](std::uint8_t light, std::uint8_t beside) {
        const double light_here = 0.35 + 0.85 * (x + y) / 440.0;  // a lamp at the lower right
        const int noise = (x * 31 + y * 17 + light) % 7 - 3;
        return static_cast<std::uint8_t>(std::clamp((0.7 * light + 0.3 * beside) * light_here + noise, 0.0, 255.0));
      };
      const Rgb8 a = plain.picture.At(x, y), b = plain.picture.At(std::max(0, x - 1), y);
      spoilt.picture.At(x, y) = {lit(a.r, b.r), lit(a.g, b.g), lit(a.b, b.b)};
    }
  }
  EXPECT_LT(FarthestOff(spoilt.Read(), leg), 2);
  EXPECT_EQ(CountMarks(spoilt.Read()), 4u);
}

TEST(ReadLimbColours, LeavesOutALimbThatIsHiddenAndReadsTheOthers) {
  Canvas canvas;
  const Leg leg;
  leg.Draw(canvas, Suit(), /*has_shank=*/false);
  const Marks marks = canvas.Read();
  EXPECT_FALSE(marks.strokes[kShank]);
  ASSERT_TRUE(marks.strokes[kThigh]);
  EXPECT_LT(glm::distance(marks.strokes[kThigh]->a, leg.hip), 1.5);
  EXPECT_TRUE(marks.strokes[kFoot]) << "its far end is told by the trunk";
}

// A forearm that crosses the thigh leaves two pieces with one common line.
TEST(ReadLimbColours, ReadsALimbInPiecesWhereAnotherOneCrossesIt) {
  Canvas canvas;
  const Leg leg;
  leg.Draw(canvas, Suit());
  const glm::dvec2 middle = 0.5 * (leg.hip + leg.knee);
  canvas.Draw(middle - glm::dvec2(40, 4), middle + glm::dvec2(40, 4), 6, Suit().limbs[10]);
  EXPECT_LT(FarthestOff(canvas.Read(), leg), 1.7);
}

// Between red and yellow a blurred camera shows an orange line, too thin for a limb.
TEST(ReadLimbColours, TakesNoLineOfMixedColoursForALimb) {
  LimbColours suit = Suit();
  suit.trunk = {200, 0, 0};
  suit.limbs[kThigh] = {200, 200, 0};
  suit.limbs[12] = {200, 100, 0};  // the head's colour
  Canvas canvas;
  canvas.Draw({100, 20}, {100, 100}, 30, suit.trunk, true);
  canvas.Draw({100, 100}, {100, 180}, 10, suit.limbs[kThigh], true);
  canvas.Draw({100, 99}, {100, 101}, 30, suit.limbs[12], true);
  const Marks marks = ReadLimbColours(canvas.picture, canvas.person, suit);
  EXPECT_TRUE(marks.strokes[kThigh]);
  EXPECT_EQ(CountMarks(marks), 1u);
  // The control: a line as thick as a head is one.
  canvas.Draw({100, 5}, {100, 35}, 15, suit.limbs[12], true);
  EXPECT_EQ(CountMarks(ReadLimbColours(canvas.picture, canvas.person, suit)), 3u);
}

TEST(ReadLimbColours, ReadsNothingOfOtherColoursOrOffThePerson) {
  LimbColours pale = Suit();
  const auto fade = [](Rgb8& c) {  // half-way to grey
    const int grey = (c.r + c.g + c.b) / 3;
    c = {static_cast<std::uint8_t>((c.r + grey) / 2), static_cast<std::uint8_t>((c.g + grey) / 2),
         static_cast<std::uint8_t>((c.b + grey) / 2)};
  };
  fade(pale.trunk);
  for (Rgb8& limb : pale.limbs) fade(limb);
  Canvas other;
  Leg().Draw(other, pale);
  EXPECT_EQ(CountMarks(other.Read()), 0u);

  Canvas nobody;
  Leg().Draw(nobody, Suit());
  nobody.person = Mask(200, 240);
  EXPECT_EQ(CountMarks(nobody.Read()), 0u);
  // Pixels within a few pixels of the person still belong to it.
  nobody.person = Mask(200, 240);
  Canvas eaten = nobody;
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 200; ++x) eaten.person.At(x, y) = nobody.picture.At(x, y) != Rgb8{90, 90, 90} && x % 7 == 0;
  }
  EXPECT_LT(FarthestOff(eaten.Read(), Leg()), 1.5);
}

TEST(ReadLimbColours, OfALimbThatThePictureCutsOffHasNoDisc) {
  Canvas canvas;
  const LimbColours suit = Suit();
  canvas.Draw({100, 60}, {100, 150}, 24, suit.trunk, true);
  canvas.Draw({100, 150}, {100, 205}, 10, suit.limbs[kThigh], true);
  canvas.Draw({100, 205}, {100, 225}, 9, suit.limbs[kShank], true);
  canvas.Draw({100, 222}, {100, 300}, 8, suit.limbs[kFoot], true);
  const Marks marks = canvas.Read();
  EXPECT_TRUE(marks.strokes[kThigh]);
  EXPECT_FALSE(marks.effectors[0]);
}

}  // namespace
}  // namespace etude
