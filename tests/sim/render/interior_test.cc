// Renders furnished rooms and compares them with the ray caster, pixel by pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/body/shape.h"
#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr auto kFurnitureLabel = static_cast<std::uint32_t>(Part::kFurniture);

// A table in front of the dancer's legs, a cupboard behind, a shelf at the side, each at a different heading.
Interior Furnished() {
  Interior room;
  room.low = {-2.9, 0, -2.2};
  room.high = {2.6, 2.95, 5};
  room.floor = {.first = {150, 120, 90}, .second = {140, 110, 85}, .pattern = Pattern::kPlanks};
  room.wall = {.first = {170, 180, 160}, .second = {160, 175, 155}, .pattern = Pattern::kStripes};
  room.ceiling = {.first = {230, 230, 225}, .second = {230, 230, 225}};
  room.lights.key = {-1.2, 2.7, 3.4};
  room.furniture = {{{0.5, 0.35, 1.3}, {0.4, 0.35, 0.2}, 0.4, {}},
                    {{-0.9, 0.9, -1.9}, {0.5, 0.9, 0.2}, 0, {}},
                    {{1.9, 0.6, -0.4}, {0.3, 0.6, 0.5}, -1.2, {}},
                    {{0.2, 0.05, 0.2}, {0.5, 0.05, 0.5}, 0.1, {}}};
  return room;
}

class RenderedInterior : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_OK(made, SharedRenderer());
    renderer_ = *made;
  }
  View Draw(const Interior& interior, const std::vector<Figure>& figures, const Camera& camera) {
    return renderer_->Render({.interior = &interior}, figures, camera, Targets::kAll);
  }

  Renderer* renderer_ = nullptr;
};

TEST_F(RenderedInterior, AgreesWithARayCasterOnEveryLabelAndDepth) {
  const Interior room = Furnished();
  for (const Camera& camera : TestCameras()) {
    const View view = Draw(room, {{Dancer(), PerformerColours()}}, camera);
    const Comparison result = Compare(view, {camera, Dancer(), {}, &room});
    EXPECT_GT(result.compared, 8000);
    EXPECT_EQ(result.wrong_labels, 0);
    EXPECT_LT(result.worst_depth, 1e-3);
    EXPECT_LT(result.on_outlines, result.compared / 300);
    EXPECT_GT(std::ranges::count(view.labels.pixels, kFurnitureLabel), 3000);
    EXPECT_GT(std::ranges::count(view.labels.pixels, 1u), 500);
  }
}

TEST_F(RenderedInterior, WouldBeCaughtWithABoxOutOfPlace) {
  const Interior room = Furnished();
  Interior moved = room;
  moved.furniture[0].centre.x += 0.03;
  moved.furniture[2].heading += 0.05;
  const Camera camera = TestCameras().front();
  const View view = Draw(room, {{Dancer(), PerformerColours()}}, camera);
  EXPECT_GT(Compare(view, {camera, Dancer(), {}, &moved}).wrong_labels, 50);
}

TEST_F(RenderedInterior, HidesPeopleBehindFurnitureAndLeavesTheRestOfTheRoomAlone) {
  const Interior room = Furnished();
  const Camera camera = TestCameras().front();
  const View with = Draw(room, {{Dancer(), PerformerColours()}}, camera), without = Draw(room, {}, camera);
  int hidden = 0, untouched = 0;
  const View alone = renderer_->Render({}, {{Dancer(), PerformerColours()}}, camera, Targets::kAll);
  for (std::size_t i = 0; i < with.labels.pixels.size(); ++i) {
    if (IsPerformer(alone.labels.pixels[i]) && with.labels.pixels[i] == kFurnitureLabel) ++hidden;
    if (with.colour.pixels[i] == without.colour.pixels[i]) ++untouched;
  }
  EXPECT_GT(hidden, 300);
  EXPECT_GT(untouched, 200000);
}

TEST_F(RenderedInterior, DrawsTheSameRowsAloneAsInAWholePicture) {
  const Interior interior = Furnished();
  const Room room{.interior = &interior};
  const Camera camera = TestCameras().front();
  const std::vector<Figure> figures = {{Dancer(), PerformerColours()}};
  const View whole = renderer_->Render(room, figures, camera, Targets::kAll);
  for (int first = 0; first < whole.colour.height; first += 37) {
    const RowRange rows{first, std::min(first + 37, whole.colour.height)};
    const View band = renderer_->RenderRows(room, figures, camera, Targets::kAll, rows);
    ASSERT_EQ(band.colour.height, rows.end - rows.first);
    for (int y = rows.first; y < rows.end; ++y) {
      for (int x = 0; x < whole.colour.width; ++x) {
        ASSERT_EQ(band.colour.At(x, y - first), whole.colour.At(x, y));
        ASSERT_EQ(band.labels.At(x, y - first), whole.labels.At(x, y));
        ASSERT_EQ(band.depth.At(x, y - first), whole.depth.At(x, y));
      }
    }
  }
}

TEST_F(RenderedInterior, HEAVY_IsTheSameAfterAPictureOfColoursOnly) {
  const std::vector<Figure> dancer{{Dancer(), PerformerColours()}};
  const Interior interior = Furnished();
  const Room room{.interior = &interior};
  const Camera camera = TestCameras().front();
  const auto first = Renderer::Create(), second = Renderer::Create();
  ASSERT_TRUE(first && second);
  // The room is drawn at its first use; masks left by the previous picture must not matter.
  (*second)->Render({}, dancer, camera, Targets::kColour);
  const View direct = (*first)->Render(room, dancer, camera, Targets::kColourAndLabels);
  const View after = (*second)->Render(room, dancer, camera, Targets::kColourAndLabels);
  EXPECT_EQ(direct.labels.pixels, after.labels.pixels);
  EXPECT_EQ(direct.colour.pixels, after.colour.pixels);
}

TEST_F(RenderedInterior, LabelsAFigureAsOneThingWhenToldSo) {
  const Interior room = Furnished();
  Figure bystander{Dancer(), PerformerColours()};
  bystander.seen_as = Part::kBystander;
  const View view = Draw(room, {bystander}, TestCameras().front());
  EXPECT_EQ(std::ranges::count_if(view.labels.pixels, IsPerformer), 0);
  EXPECT_GT(std::ranges::count(view.labels.pixels, static_cast<std::uint32_t>(Part::kBystander)), 4000);
}

TEST_F(RenderedInterior, FeetDarkenTheFloorThatTheyNearlyTouch) {
  Interior room = Furnished();
  room.furniture.clear();
  room.lights.key_colour = glm::dvec3(0);  // without the lamp only contact shading remains
  const Camera camera = LookAt({}, {0, 2.0, 2.5}, {0, 0, 0});
  const auto darkest_beside = [&](double height) {
    const Capsule foot{Part::kLeftFoot, {0, height, 0}, {0, height, 0.15}, 0.045};
    const View with = Draw(room, {{{foot}, PerformerColours()}}, camera), without = Draw(room, {}, camera);
    double least = 1;
    for (std::size_t i = 0; i < with.labels.pixels.size(); ++i) {
      if (IsPerformer(with.labels.pixels[i])) continue;
      least = std::min(least, (1.0 + with.colour.pixels[i].g) / (1.0 + without.colour.pixels[i].g));
    }
    return least;
  };
  EXPECT_LT(darkest_beside(0.045), 0.75);
  EXPECT_GT(darkest_beside(0.045 + 0.2), 0.98);
}

}  // namespace
}  // namespace etude
