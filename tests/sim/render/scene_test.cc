#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "sim/render/empty_room.h"
#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/smooth_picture.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr auto kShadowLabel = static_cast<std::uint32_t>(Part::kShadow);

class RendererScene : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(made, SharedRenderer());
    renderer_ = *made;
  }
  View Draw(const Room& room, bool with_dancer = true, Targets targets = Targets::kAll) {
    std::vector<Figure> figures;
    if (with_dancer) figures.push_back({Dancer(), PerformerColours()});
    return renderer_->Render(room, figures, camera_, targets);
  }

  Camera camera_ = LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0});
  Renderer* renderer_ = nullptr;
};

glm::dvec3 ToVector(Rgb8 colour) { return {colour.r, colour.g, colour.b}; }

// Returns the hue in degrees by the hexagon formula, not the HSI formula of segmentation.
double Hue(Rgb8 colour) {
  const double y = std::sqrt(3.0) * (colour.g - colour.b), x = 2.0 * colour.r - colour.g - colour.b;
  return Degrees(std::atan2(y, x));
}
double HueGap(Rgb8 a, Rgb8 b) { return std::abs(std::remainder(Hue(a) - Hue(b), 360.0)); }

TEST_F(RendererScene, GivesTheSameBytesAgainWhateverWasDrawnBetween) {
  const View first = Draw({});
  renderer_->Render({.texture_seed = 9}, {}, LookAt({.width = 900, .height = 700}, {2, 1, 3}, {0, 1, 0}),
                    Targets::kAll);
  const View again = Draw({});
  EXPECT_EQ(first.colour.pixels, again.colour.pixels);
  EXPECT_EQ(first.labels.pixels, again.labels.pixels);
  EXPECT_EQ(first.depth.pixels, again.depth.pixels);

  ASSERT_OK(fresh, Renderer::Create());
  renderer_ = fresh->get();
  EXPECT_EQ(first.colour.pixels, Draw({}).colour.pixels);
}

TEST_F(RendererScene, GivesTheSameColoursWithoutLabelsAndDepth) {
  const View colour_only = Draw({}, true, Targets::kColour);
  EXPECT_EQ(colour_only.colour.pixels, Draw({}).colour.pixels);
  EXPECT_TRUE(colour_only.labels.pixels.empty());
  EXPECT_TRUE(colour_only.depth.pixels.empty());
}

TEST_F(RendererScene, LeavesTheBackgroundAloneOutsideThePersonAndItsShadow) {
  const View with = Draw({}), without = Draw({}, false);
  int untouched = 0;
  for (std::size_t i = 0; i < with.labels.pixels.size(); ++i) {
    EXPECT_EQ(without.labels.pixels[i], 0u);
    if (with.labels.pixels[i] != 0) continue;
    ++untouched;
    ASSERT_EQ(with.colour.pixels[i], without.colour.pixels[i]);
    ASSERT_EQ(with.depth.pixels[i], without.depth.pixels[i]);
  }
  EXPECT_GT(untouched, 200000);
}

TEST_F(RendererScene, ShadowsDarkenTheRoomAndKeepItsHue) {
  const View with = Draw({}), without = Draw({}, false);
  int shadows = 0;
  double darkening = 0;
  for (std::size_t i = 0; i < with.labels.pixels.size(); ++i) {
    if (with.labels.pixels[i] != kShadowLabel) continue;
    ++shadows;
    ASSERT_EQ(with.depth.pixels[i], without.depth.pixels[i]) << "a shadow lies on the room's surface";
    const glm::dvec3 dark = ToVector(with.colour.pixels[i]), light = ToVector(without.colour.pixels[i]);
    ASSERT_LE(glm::length(dark), glm::length(light));
    ASSERT_LT(Degrees(AngleBetween(dark, light)), 1.0);
    darkening += glm::length(dark) / glm::length(light);
  }
  EXPECT_GT(shadows, 5000);
  EXPECT_LT(darkening / shadows, 0.8);
}

TEST_F(RendererScene, CastsNoShadowWhenToldSo) {
  const View view = Draw({.casts_shadows = false});
  EXPECT_EQ(std::ranges::count(view.labels.pixels, kShadowLabel), 0);
  EXPECT_GT(std::ranges::count(Draw({}).labels.pixels, kShadowLabel), 0);
}

TEST_F(RendererScene, BrightnessMultipliesEveryChannel) {
  const View normal = Draw({}), dim = Draw({.brightness = 0.8});
  for (std::size_t i = 0; i < normal.colour.pixels.size(); i += 7) {
    const glm::dvec3 gap = ToVector(dim.colour.pixels[i]) - 0.8 * ToVector(normal.colour.pixels[i]);
    ASSERT_LE(std::max({std::abs(gap.x), std::abs(gap.y), std::abs(gap.z)}), 1.0);
  }
}

TEST_F(RendererScene, ThePerformersHuesStandApartFromTheRooms) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const View with = Draw({.texture_seed = seed}), without = Draw({.texture_seed = seed}, false);
    int person = 0, close = 0;
    for (std::size_t i = 0; i < with.labels.pixels.size(); ++i) {
      if (with.labels.pixels[i] < kFirstBodyPart) continue;
      ++person;
      if (HueGap(with.colour.pixels[i], without.colour.pixels[i]) < 85) ++close;
    }
    EXPECT_GT(person, 8000);
    EXPECT_EQ(close, 0);
  }
}

TEST_F(RendererScene, EveryPixelShowsASurfaceWhereverTheCameraStandsInFront) {
  const Intrinsics small{.width = 160, .height = 120, .fx = 150, .fy = 150, .cx = 80, .cy = 60};
  for (const double azimuth_deg : {-55.0, -20.0, 0.0, 35.0, 55.0}) {
    for (const double height : {0.3, 1.5, 3.0}) {
      for (const double away : {3.0, 5.0, 9.0}) {
        const double azimuth = Radians(azimuth_deg);
        const glm::dvec3 eye{away * std::sin(azimuth), height, away * std::cos(azimuth)};
        const View view = renderer_->Render({}, {}, LookAt(small, eye, {0, 1, 0}), Targets::kAll);
        ASSERT_TRUE(std::ranges::all_of(view.depth.pixels, [](float depth) { return depth > 0 && depth < 200; }))
            << azimuth_deg << " degrees, " << height << " m high, " << away << " m away";
      }
    }
  }
}

TEST_F(RendererScene, LeavesOutCapsulesThatAreNotFinite) {
  std::vector<Capsule> shape = Dancer();
  shape.push_back({Part::kHead, {std::numeric_limits<double>::quiet_NaN(), 1, 0}, {0, 1, 0}, 0.2});
  shape.push_back({Part::kHead, {0, 1, 0}, {0, 1, 0}, -1});
  const View view = renderer_->Render({}, {{shape, PerformerColours()}}, camera_, Targets::kAll);
  EXPECT_EQ(view.labels.pixels, Draw({}).labels.pixels);
}

TEST_F(RendererScene, TheSmoothPictureShowsTheSameScene) {
  const std::vector<Figure> figures{{Dancer(), PerformerColours()}};
  const ColourImage smooth = DrawSmooth(*renderer_, figures, camera_);
  const ColourImage plain = renderer_->Render({}, figures, camera_, Targets::kColour).colour;
  ASSERT_EQ(smooth.width, plain.width);
  ASSERT_EQ(smooth.height, plain.height);
  const auto mean_gap = [&](int shift) {
    double sum = 0;
    for (int y = 0; y < plain.height; ++y) {
      for (int x = 0; x + shift < plain.width; ++x) {
        sum += glm::length(ToVector(smooth.At(x, y)) - ToVector(plain.At(x + shift, y)));
      }
    }
    return sum / static_cast<double>(plain.pixels.size());
  };
  EXPECT_LT(mean_gap(0), 1.5);
  EXPECT_GT(mean_gap(1), 1.5 * mean_gap(0)) << "half a pixel of shift would show";
}

TEST(RoomTexture, DependsOnItsSeedAndKeepsSpotsInsideTheirTiles) {
  const RoomTexture texture = MakeRoomTexture(5);
  EXPECT_EQ(texture.floor, MakeRoomTexture(5).floor);
  EXPECT_EQ(texture.wall, MakeRoomTexture(5).wall);
  EXPECT_NE(texture.wall, MakeRoomTexture(6).wall);
  EXPECT_NE(texture.wall, texture.floor);
  for (const TilePattern& pattern : {texture.floor, texture.wall}) {
    for (const glm::vec4& tile : pattern) {
      for (const float centre : {tile.x, tile.y}) {
        EXPECT_GE(centre - tile.z, -1e-6f);
        EXPECT_LE(centre + tile.z, 1 + 1e-6f);
      }
    }
  }
}

}  // namespace
}  // namespace etude
