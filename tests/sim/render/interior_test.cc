// Furnished rooms, pixel by pixel, against a ray caster of their own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/body/shape.h"
#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

constexpr auto kFurnitureLabel = static_cast<std::uint32_t>(Part::kFurniture);

Cuboid AsBox(const FurnitureBox& box) { return {box.centre, box.half_size, box.heading}; }

// A table before the dancer's legs, a cupboard behind, a shelf at the side, each turned otherwise.
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

// One viewing ray at a time, in double precision, with sim/body's HitDistance.
class InteriorCaster {
 public:
  InteriorCaster(const Camera& camera, const Interior& room, std::vector<Capsule> shape)
      : camera_(camera), room_(room), shape_(std::move(shape)) {}

  Sight Cast(double u, double v) const {
    const Intrinsics& in = camera_.intrinsics;
    const double y = (v - in.cy) / in.fy, x = (u - in.cx - in.skew * y) / in.fx;
    const glm::dvec3 along = glm::transpose(camera_.R_CW) * glm::dvec3(x, y, 1);
    const double stretch = glm::length(along);
    const glm::dvec3 direction = along / stretch;

    double nearest = std::numeric_limits<double>::infinity();
    Sight sight;
    const auto meet = [&](double distance, std::uint32_t label) {
      if (distance >= nearest) return;
      nearest = distance;
      sight = {label, distance / stretch};
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double low = room_.low[axis] - camera_.p_WC[axis], high = room_.high[axis] - camera_.p_WC[axis];
      if (low < 0 && direction[axis] < 0) meet(low / direction[axis], 0);
      if (high > 0 && direction[axis] > 0) meet(high / direction[axis], 0);
    }
    for (const FurnitureBox& box : room_.furniture) {
      meet(HitDistance(AsBox(box), camera_.p_WC, direction), kFurnitureLabel);
    }
    for (const Capsule& capsule : shape_) {
      meet(HitDistance(capsule, camera_.p_WC, direction), static_cast<std::uint32_t>(capsule.part));
    }
    if (sight.label == 0 && IsInShadow(camera_.p_WC + nearest * direction)) sight.label = 1;
    return sight;
  }

  // Whether the label is the same all around (u, v), `margin` pixels away.
  bool IsClear(double u, double v, double margin) const {
    const std::uint32_t label = Cast(u, v).label;
    for (const double du : {-margin, 0.0, margin}) {
      for (const double dv : {-margin, 0.0, margin}) {
        if (Cast(u + du, v + dv).label != label) return false;
      }
    }
    return true;
  }

 private:
  bool IsInShadow(const glm::dvec3& point) const {
    const glm::dvec3 to_lamp = room_.lights.key - point;
    const double distance = glm::length(to_lamp);
    return std::ranges::any_of(
        shape_, [&](const Capsule& capsule) { return HitDistance(capsule, point, to_lamp / distance) < distance; });
  }

  const Camera& camera_;
  const Interior& room_;
  std::vector<Capsule> shape_;
};

Comparison CompareAll(const View& view, const InteriorCaster& caster) {
  Comparison result;
  for (int y = 0; y < view.labels.height; y += 3) {
    for (int x = 0; x < view.labels.width; x += 3) {
      ++result.compared;
      const Sight expected = caster.Cast(x + 0.5, y + 0.5);
      const double difference = std::abs(view.depth.At(x, y) - expected.depth);
      const bool same_label = view.labels.At(x, y) == expected.label;
      if (same_label && difference <= result.worst_depth) continue;
      if (!caster.IsClear(x + 0.5, y + 0.5, 0.05)) {
        ++result.on_outlines;
      } else if (!same_label) {
        ++result.wrong_labels;
      } else {
        result.worst_depth = difference;
      }
    }
  }
  return result;
}

class RenderedInterior : public testing::Test {
 protected:
  void SetUp() override {
    const auto made = SharedRenderer();
    ASSERT_TRUE(made) << ToString(made.error());
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
    const Comparison result = CompareAll(view, {camera, room, Dancer()});
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
  EXPECT_GT(CompareAll(view, {camera, moved, Dancer()}).wrong_labels, 50);
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

TEST_F(RenderedInterior, IsTheSameAfterAPictureOfColoursOnly) {
  const std::vector<Figure> dancer{{Dancer(), PerformerColours()}};
  const Interior interior = Furnished();
  const Room room{.interior = &interior};
  const Camera camera = TestCameras().front();
  const auto first = Renderer::Create(), second = Renderer::Create();
  ASSERT_TRUE(first && second);
  // The room is drawn when it is first asked for, with whatever masks the last picture left.
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
  room.lights.key_colour = glm::dvec3(0);  // no lamp, no shadow: only what the foot keeps off is missing
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
