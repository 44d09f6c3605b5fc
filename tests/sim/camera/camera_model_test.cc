#include "sim/camera/camera_model.h"

#include <gtest/gtest.h>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

// Something of everything: flat parts, edges, what moves with time.
Rgb8 Pattern(int x, int y, double frame) {
  const int shift = static_cast<int>(8 * frame);
  if ((x + shift) / 40 % 2 == y / 40 % 2) return {210, 190, 40};
  return {static_cast<std::uint8_t>(x % 256), static_cast<std::uint8_t>(y % 256), 90};
}

struct Effect {
  const char* name;
  double CameraEffects::*strength;
  double on;
};
const Effect kEffects[] = {{"sync", &CameraEffects::sync_offset_ms, 20},
                           {"drift", &CameraEffects::clock_drift_ppm, 50000},
                           {"rolling", &CameraEffects::rolling_shutter_ms, 20},
                           {"blur", &CameraEffects::motion_blur, 0.5},
                           {"radial", &CameraEffects::radial_distortion, -0.05},
                           {"tangential", &CameraEffects::tangential_distortion, 0.02},
                           {"defocus", &CameraEffects::defocus_px, 1},
                           {"vignette", &CameraEffects::vignette, 1},
                           {"dust", &CameraEffects::dust, 0.5},
                           {"exposure", &CameraEffects::exposure_ev, 0.3},
                           {"exposure drift", &CameraEffects::exposure_drift_ev, 0.5},
                           {"gain", &CameraEffects::gain_db, 6},
                           {"white balance", &CameraEffects::white_balance_ev, 0.3},
                           {"white balance drift", &CameraEffects::white_balance_drift_ev, 0.5},
                           {"bayer", &CameraEffects::bayer, 1},
                           {"noise", &CameraEffects::noise, 1},
                           {"jpeg", &CameraEffects::jpeg_loss, 30}};

constexpr std::size_t kFrame = 5;

ColourImage ShotWith(const CameraEffects& effects) {
  CameraModel model = ModelOf(effects, PlainCamera(160, 120), /*is_reference=*/false);
  return Shoot(model, Pattern, kFrame);
}

TEST(CameraModel, WithoutEffectsGivesTheSceneItself) {
  const ColourImage seen = ShotWith(NoEffects());
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) ASSERT_EQ(seen.At(x, y), Pattern(x, y, kFrame));
  }
}

TEST(CameraModel, IsChangedByEachEffectAndByNoneOfStrengthZero) {
  const ColourImage plain = ShotWith({.noise = 1});
  for (const Effect& effect : kEffects) {
    CameraEffects effects{.noise = 1};
    if (effect.strength == &CameraEffects::noise) effects.noise = 2;
    if (effect.strength != &CameraEffects::noise) effects.*effect.strength = effect.on;
    EXPECT_NE(ShotWith(effects).pixels, plain.pixels) << effect.name;
    effects.*effect.strength = effect.strength == &CameraEffects::noise ? 1 : 0;
    EXPECT_EQ(ShotWith(effects).pixels, plain.pixels) << effect.name;
  }
}

// The way through linear light, which any effect there opens, must itself change nothing: an effect too weak to be
// seen leaves the bytes of the short way.
TEST(CameraModel, TheWayThroughLightGivesTheBytesOfTheShortWay) {
  const ColourImage plain = ShotWith({.noise = 1});
  for (double CameraEffects::*strength : {&CameraEffects::vignette, &CameraEffects::exposure_ev,
                                          &CameraEffects::white_balance_ev, &CameraEffects::dust}) {
    CameraEffects effects{.noise = 1};
    effects.*strength = 1e-12;
    EXPECT_EQ(ShotWith(effects).pixels, plain.pixels);
  }
}

TEST(CameraModel, RepeatsItselfAndThrowsAnewForEveryFrameAndCamera) {
  CameraEffects all;
  for (const Effect& effect : kEffects) all.*effect.strength = effect.on;
  EXPECT_EQ(ShotWith(all).pixels, ShotWith(all).pixels);
  CameraModel model = ModelOf({.noise = 1});
  EXPECT_NE(ShootFlat(model, {99, 99, 99}, 1).pixels, ShootFlat(model, {99, 99, 99}, 2).pixels);
  CameraModel other(PlainCamera(), {.noise = 1}, 30, {kShotWorld, "another", true});
  EXPECT_NE(ShootFlat(other, {99, 99, 99}, 1).pixels, ShootFlat(model, {99, 99, 99}, 1).pixels);
}

TEST(CameraModel, ReusesBuffersWithoutATraceOfThePictureBefore) {
  CameraEffects all;
  for (const Effect& effect : kEffects) all.*effect.strength = effect.on;
  CameraModel used = ModelOf(all, PlainCamera(160, 120)), fresh = ModelOf(all, PlainCamera(160, 120));
  ShootFlat(used, {250, 3, 77}, 4);
  EXPECT_EQ(Shoot(used, Pattern, 9).pixels, Shoot(fresh, Pattern, 9).pixels);
}

TEST(CameraModel, ShowsTheBackgroundWithDiceOfItsOwn) {
  CameraModel model = ModelOf({.noise = 1}), faultless = ModelOf(NoEffects());
  const auto grey = [](int, int, double) { return Rgb8{90, 90, 90}; };
  EXPECT_NE(model.ShootBackground(SceneOf(model, grey)).pixels, Shoot(model, grey, 0).pixels);
  EXPECT_EQ(faultless.ShootBackground(SceneOf(faultless, grey)).pixels, Shoot(faultless, grey, 0).pixels);
}

}  // namespace
}  // namespace etude
