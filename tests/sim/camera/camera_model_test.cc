#include "sim/camera/camera_model.h"

#include <gtest/gtest.h>

#include "tests/sim/camera/shots.h"

namespace etude {
namespace {

// Returns a pattern with flat parts, edges, and parts that move with time.
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

// Each of these effects makes the model compute in linear light. If the effect is too weak to be seen, the bytes must
// stay the same.
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

constexpr int kWidth = 640, kHeight = 96;

/// Returns a painter of a scene that is bright left of column `edge(frame)`, and dark right of it.
Painter MovingEdge(const std::function<double(double)>& edge) {
  return [edge](int x, int, double frame) { return x + 0.5 < edge(frame) ? Rgb8{230, 230, 230} : Rgb8{30, 30, 30}; };
}

/// Returns the edge's position in a row: the sum of the pixels' relative brightness.
double EdgeInRow(const ColourImage& picture, int y) {
  const double dark = LightOfCodes()[30], bright = LightOfCodes()[230];
  double sum = 0;
  for (int x = 0; x < picture.width; ++x) sum += (LightAt(picture, x, y) - dark) / (bright - dark);
  return sum;
}

CameraModel Wide(const CameraEffects& effects, bool is_reference = true) {
  return ModelOf(effects, PlainCamera(kWidth, kHeight), is_reference);
}

// A moving vertical edge becomes slanted; the slant shows the time between rows.
double ReadOutMs(double effect_ms) {
  constexpr double kPixelsPerFrame = 300;
  CameraModel model = Wide({.rolling_shutter_ms = effect_ms, .noise = 0});
  const ColourImage picture =
      Shoot(model, MovingEdge([](double frame) { return 320 + kPixelsPerFrame * (frame - 4); }), 4);
  std::vector<std::pair<double, double>> middles;  // (row, edge) per band; each band is read out at its middle row
  for (int band = 0; band < Shutter::kBands; ++band) {
    const int rows = kHeight / Shutter::kBands;
    middles.push_back({band * rows + rows / 2.0, EdgeInRow(picture, band * rows + rows / 2)});
  }
  return FitLine(middles).slope * kHeight / kPixelsPerFrame / 30 * 1000;
}

TEST(RollingShutter, IsRecoveredFromTheSlantOfAMovingEdge) {
  for (const double effect_ms : {5.0, 15.0, 30.0}) EXPECT_NEAR(ReadOutMs(effect_ms) / effect_ms, 1, 0.03);
  EXPECT_NEAR(ReadOutMs(0), 0, 1e-9);
  EXPECT_GT(ReadOutMs(16), 15.5);
}

TEST(RollingShutter, IsExactInEachOfItsBands) {
  CameraModel model = Wide({.rolling_shutter_ms = 30, .noise = 0});
  const auto edge = [](double frame) { return 320 + 300 * (frame - 4); };
  const ColourImage picture = Shoot(model, MovingEdge(edge), 4);
  const std::vector<Shutter::Band> bands = model.shutter().BandsOf(4, kHeight);
  ASSERT_EQ(bands.size(), 8u);
  int next = 0;
  for (const Shutter::Band& band : bands) {
    EXPECT_EQ(band.rows.first, next);
    next = band.rows.end;
    for (int y = band.rows.first; y < band.rows.end; ++y) EXPECT_NEAR(EdgeInRow(picture, y), edge(band.time), 0.51);
  }
  EXPECT_EQ(next, kHeight);
}

// Motion blur turns a moving edge into a ramp, which is as wide as the distance that the edge moves during the
// exposure. The ramp has nine equal steps; its width is computed from their standard deviation.
double BlurPixels(double blur, double pixels_per_frame) {
  CameraModel model = Wide({.motion_blur = blur, .noise = 0});
  const ColourImage picture =
      Shoot(model, MovingEdge([=](double frame) { return 320 + pixels_per_frame * (frame - 4); }), 4);
  const auto value = [&](int x) { return LightAt(picture, x, 10); };
  double sum = 0, first = 0, second = 0;
  for (int x = 1; x < kWidth; ++x) {
    const double step = value(x - 1) - value(x);
    sum += step;
    first += step * x;
    second += step * x * x;
  }
  const double variance = second / sum - first * first / sum / sum;
  const double subframes = Shutter::kSubframes;
  return std::sqrt(12 * variance / (1 - 1 / (subframes * subframes)));
}

TEST(MotionBlur, IsRecoveredFromAMovingEdge) {
  for (const double blur : {0.25, 0.5, 1.0}) EXPECT_NEAR(BlurPixels(blur, 160) / (blur * 160), 1, 0.02) << blur;
  EXPECT_NEAR(BlurPixels(0.5, 80) / 40, 1, 0.03) << "half as fast, half as wide";
  EXPECT_EQ(BlurPixels(0, 160), 0);
}

// Nine equally spaced levels of light; averaging codes would give equally spaced codes.
TEST(MotionBlur, IsAMeanOfLightAndNotOfCodes) {
  CameraModel model = Wide({.motion_blur = 1, .noise = 0});
  const ColourImage picture = Shoot(model, MovingEdge([](double frame) { return 320 + 180 * (frame - 4); }), 4);
  const double dark = LightOfCodes()[30], bright = LightOfCodes()[230];
  for (int level = 0; level <= 9; ++level) {
    const int x = 230 + 20 * level;  // the sub-frames' edges are at 240, 260, … 400
    EXPECT_NEAR(LightAt(picture, x, 5), bright + (dark - bright) * level / 9, 0.004);
  }
  EXPECT_GT(picture.At(310, 5).g - (230 - (230 - 30) * 4 / 9), 20) << "the mean of codes is darker";
}

// --- Two cameras that see the same motion.

double Dance(double frame) {
  return 320 + 120 * std::sin(frame / 5.9) + 60 * std::sin(frame / 2.3 + 1) + 30 * std::sin(frame / 17.0);
}

std::vector<double> Seen(const CameraEffects& effects, bool is_reference, std::size_t frames) {
  CameraModel model = ModelOf(effects, PlainCamera(kWidth, 4), is_reference);
  std::vector<double> edges;
  for (std::size_t k = 0; k < frames; ++k) edges.push_back(EdgeInRow(Shoot(model, MovingEdge(Dance), k), 1));
  return edges;
}

double Between(const std::vector<double>& values, double at) {
  const auto k = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(k), u = 1 - t;
  return u * u * (1 + 2 * t) * values[k] + t * t * (3 - 2 * t) * values[k + 1] +
         t * u * u * 0.5 * (values[k + 1] - values[k - 1]) - t * t * u * 0.5 * (values[k + 2] - values[k]);
}

// Returns by how many frames `other` is ahead of `reference` within frames from…to: the shift of largest correlation.
double LagOf(const std::vector<double>& reference, const std::vector<double>& other, std::size_t from, std::size_t to) {
  double best = -2, best_lag = 0;
  for (double lag = -8; lag <= 8; lag += 0.01) {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t k = from; k < to; ++k) {
      const double x = Between(reference, static_cast<double>(k) + lag), y = other[k];
      n += 1;
      a += x;
      b += y;
      aa += x * x;
      bb += y * y;
      ab += x * y;
    }
    const double correlation = (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b));
    if (correlation <= best) continue;
    best = correlation;
    best_lag = lag;
  }
  return best_lag;
}

double LagMs(double effect_ms) {
  const CameraEffects effects{.sync_offset_ms = effect_ms, .noise = 0};
  return std::abs(LagOf(Seen(effects, true, 120), Seen(effects, false, 120), 12, 100)) / 30 * 1000;
}

TEST(SyncOffset, IsRecoveredByCrossCorrelationOfWhatBothCamerasSee) {
  for (const double effect_ms : {8.0, 40.0, 100.0}) EXPECT_NEAR(LagMs(effect_ms), effect_ms, 0.7);
  EXPECT_NEAR(LagMs(0), 0, 0.2);
  EXPECT_GT(LagMs(10), 8.7) << "told apart from 8 ms";
}

// Returns the drift of the lag, from one-second windows.
double DriftPpm(double effect_ppm) {
  const CameraEffects effects{.clock_drift_ppm = effect_ppm, .noise = 0};
  const std::vector<double> reference = Seen(effects, true, 330), other = Seen(effects, false, 330);
  std::vector<std::pair<double, double>> lags;
  for (std::size_t k = 10; k + 70 <= 320; k += 30) {
    lags.push_back({static_cast<double>(k) + 29.5, LagOf(reference, other, k, k + 60)});
  }
  return std::abs(FitLine(lags).slope) * 1e6;
}

TEST(ClockDrift, IsRecoveredByRegressionOfTheLag) {
  for (const double effect_ppm : {4000.0, 15000.0}) EXPECT_NEAR(DriftPpm(effect_ppm) / effect_ppm, 1, 0.05);
  EXPECT_LT(DriftPpm(0), 50);
  EXPECT_GT(DriftPpm(4600), 4250);
}

TEST(Shutter, LeavesTheReferenceClockAlone) {
  RandomStream random(kShotWorld, "clock");
  const Shutter shutter({.sync_offset_ms = 50, .clock_drift_ppm = 9000}, 30, true, random);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(shutter.TimeOf(k), static_cast<double>(k));
}

TEST(Shutter, ThrowsTheSignsOfOffsetAndDriftAndNothingElse) {
  int late = 0, slow = 0;
  for (int trial = 0; trial < 200; ++trial) {
    RandomStream random({1, "signs", trial}, "clock");
    const Shutter shutter({.sync_offset_ms = 50, .clock_drift_ppm = 9000}, 30, false, random);
    const double offset = shutter.TimeOf(0), drift = shutter.TimeOf(1) - shutter.TimeOf(0) - 1;
    EXPECT_NEAR(std::abs(offset), 1.5, 1e-12);
    EXPECT_NEAR(std::abs(drift), 0.009, 1e-12);
    late += offset > 0;
    slow += drift > 0;
  }
  EXPECT_NEAR(late, 100, 35);
  EXPECT_NEAR(slow, 100, 35);
}

}  // namespace

}  // namespace etude
