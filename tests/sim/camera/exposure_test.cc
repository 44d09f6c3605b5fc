#include "sim/camera/exposure.h"

#include <gtest/gtest.h>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

struct Patch {
  double stops = 0;   ///< brighter than it is
  double warmth = 0;  ///< red against blue, stops
};

// A grey card in the middle of the picture, in linear light.
Patch GreyCard(CameraModel& model, std::size_t frame) {
  const ColourImage picture = ShootFlat(model, {120, 120, 120}, frame);
  double red = 0, green = 0, blue = 0;
  for (int y = 8; y < 24; ++y) {
    for (int x = 8; x < 24; ++x) {
      red += LightAt(picture, x, y, 'r');
      green += LightAt(picture, x, y, 'g');
      blue += LightAt(picture, x, y, 'b');
    }
  }
  return {std::log2(green / 256 / LightOfCodes()[120]), std::log2(red / blue)};
}

Patch GreyCard(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera(32, 32));
  return GreyCard(model, 0);
}

TEST(Exposure, IsRecoveredFromAGreyCard) {
  for (const double stops : {-1.5, -0.4, 0.5, 1.2}) {
    EXPECT_NEAR(GreyCard({.exposure_ev = stops, .noise = 0}).stops, stops, 0.02);
    EXPECT_NEAR(GreyCard({.exposure_ev = stops, .noise = 0}).warmth, 0, 1e-9);
  }
  EXPECT_GT(GreyCard({.exposure_ev = 0.55, .noise = 0}).stops, 0.52) << "another strength is told apart";
}

TEST(WhiteBalance, IsRecoveredFromAGreyCard) {
  for (const double warmth : {-0.8, 0.3, 1.0}) {
    EXPECT_NEAR(GreyCard({.white_balance_ev = warmth, .noise = 0}).warmth, warmth, 0.03);
    EXPECT_NEAR(GreyCard({.white_balance_ev = warmth, .noise = 0}).stops, 0, 1e-9) << "green stays";
  }
  EXPECT_GT(GreyCard({.white_balance_ev = 0.4, .noise = 0}).warmth, 0.36);
}

// Of a minute of pictures of the card: half of the way between the extremes.
template <typename Value>
double SwingOf(const CameraEffects& effects, Value value) {
  CameraModel model = ModelOf(effects, PlainCamera(32, 32));
  double least = 1e9, most = -1e9;
  for (std::size_t frame = 0; frame < 600; frame += 3) {
    const double now = value(GreyCard(model, frame));
    least = std::min(least, now);
    most = std::max(most, now);
  }
  return (most - least) / 2;
}

TEST(Exposure, AndWhiteBalanceWanderAsFarAsTheyShould) {
  const auto stops = [](const Patch& patch) { return patch.stops; };
  const auto warmth = [](const Patch& patch) { return patch.warmth; };
  for (const double drift : {0.2, 0.6}) {
    EXPECT_NEAR(SwingOf({.exposure_drift_ev = drift, .noise = 0}, stops), drift, 0.02);
    EXPECT_NEAR(SwingOf({.white_balance_drift_ev = drift, .noise = 0}, warmth), drift, 0.03);
  }
  EXPECT_LT(SwingOf({.white_balance_drift_ev = 0.6, .noise = 0}, stops), 1e-9);
  EXPECT_GT(SwingOf({.exposure_drift_ev = 0.25, .noise = 0}, stops), 0.225);
}

TEST(Exposure, WandersSlowly) {
  RandomStream exposure(kShotWorld, "e"), balance(kShotWorld, "w");
  const AutomaticToning toning({.exposure_drift_ev = 1, .white_balance_drift_ev = 1}, exposure, balance);
  for (int k = 0; k < 300; ++k) {
    const double step = std::abs(std::log2(toning.At((k + 1) / 30.0).exposure / toning.At(k / 30.0).exposure));
    EXPECT_LT(step, 2 * 3.1416 / 4 / 30 * 1.01) << "never faster than once in four seconds";
  }
}

// Less light for the same picture: the noise tells gain from exposure.
TEST(Gain, LeavesThePictureAsBright) {
  EXPECT_NEAR(GreyCard({.gain_db = 12, .noise = 1}).stops, 0, 0.02);
  EXPECT_EQ(GreyCard({.gain_db = 12, .noise = 0}).stops, GreyCard(NoEffects()).stops);
}

}  // namespace
}  // namespace etude
