#include <gtest/gtest.h>

#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

struct Comparison {
  int compared = 0;
  int on_outlines = 0;     // differ, where the outline runs through the pixel's centre
  int wrong_labels = 0;    // differ, and no outline explains it
  double worst_depth = 0;  // metres, away from outlines
};

// Every third pixel of every third row. An outline within a 20th of a pixel excuses a difference.
Comparison Compare(const View& view, const RayCaster& caster) {
  constexpr double kMargin = 0.05;
  Comparison result;
  for (int y = 0; y < view.labels.height; y += 3) {
    for (int x = 0; x < view.labels.width; x += 3) {
      ++result.compared;
      const double u = x + 0.5, v = y + 0.5;
      const Sight expected = caster.Cast(u, v);
      const double difference = std::abs(view.depth.At(x, y) - expected.depth);
      const bool same_label = view.labels.At(x, y) == expected.label;
      if (same_label && difference <= result.worst_depth) continue;
      if (!caster.IsClear(u, v, kMargin)) {
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

std::vector<Camera> Cameras() {
  Intrinsics skewed{.width = 501, .height = 377, .fx = 480, .fy = 455, .cx = 230.25, .cy = 201.5, .skew = 14};
  Intrinsics close{.width = 320, .height = 240, .fx = 300, .fy = 300, .cx = 160, .cy = 120};
  return {LookAt({}, {-1.2, 1.4, 3.9}, {0, 0.95, 0}), LookAt(skewed, {2.1, 0.6, 3.0}, {0.1, 1.0, 0}),
          LookAt(close, {0.4, 2.2, 0.9}, {0, 1.0, 0})};
}

TEST(Renderer, AgreesWithARayCasterOnEveryLabelAndDepth) {
  const auto renderer = Renderer::Create();
  ASSERT_TRUE(renderer) << ToString(renderer.error());
  for (const Camera& camera : Cameras()) {
    const View view = (*renderer)->Render({}, {{Dancer(), PerformerColours()}}, camera, Targets::kAll);
    const Comparison result = Compare(view, {camera, Dancer()});
    EXPECT_GT(result.compared, 8000);
    EXPECT_EQ(result.wrong_labels, 0);
    EXPECT_LT(result.worst_depth, 1e-3);
    EXPECT_LT(result.on_outlines, result.compared / 500);
  }
}

TEST(Renderer, WouldBeCaughtBeingHalfAPixelOff) {
  const auto renderer = Renderer::Create();
  ASSERT_TRUE(renderer) << ToString(renderer.error());
  Camera camera = Cameras().front();
  const View view = (*renderer)->Render({}, {{Dancer(), PerformerColours()}}, camera, Targets::kAll);
  camera.intrinsics.cx += 0.5;
  EXPECT_GT(Compare(view, {camera, Dancer()}).wrong_labels, 50);
}

TEST(Renderer, ShowsTheEndsOfEveryCapsuleWhereProjectPutsThem) {
  const auto renderer = Renderer::Create();
  ASSERT_TRUE(renderer) << ToString(renderer.error());
  const Camera camera = LookAt({}, {0.9, 1.3, 4.0}, {0, 0.95, 0});
  for (const Capsule& capsule : Dancer()) {
    const View view = (*renderer)->Render({}, {{{capsule}, PerformerColours()}}, camera, Targets::kAll);
    for (const glm::dvec3& end : {capsule.a, capsule.b}) {
      const auto pixel = Project(MatrixOf(camera), end);
      ASSERT_TRUE(pixel);
      EXPECT_EQ(view.labels.At(static_cast<int>(pixel->x), static_cast<int>(pixel->y)),
                static_cast<std::uint32_t>(capsule.part));
    }
  }
}

TEST(Renderer, ShowsTheNearerOfTwoBodiesWhicheverIsGivenFirst) {
  const auto renderer = Renderer::Create();
  ASSERT_TRUE(renderer) << ToString(renderer.error());
  const Camera camera = LookAt({}, {0, 1, 4}, {0, 1, 0});
  const Figure near_ball{{{Part::kHead, {0, 1, 1}, {0, 1, 1}, 0.2}}, PerformerColours()};
  const Figure far_ball{{{Part::kTrunk, {0, 1, 0}, {0, 1, 0}, 0.3}}, PerformerColours()};
  for (const auto& figures : {std::vector{near_ball, far_ball}, std::vector{far_ball, near_ball}}) {
    const View view = (*renderer)->Render({}, figures, camera, Targets::kAll);
    EXPECT_EQ(view.labels.At(320, 240), static_cast<std::uint32_t>(Part::kHead));
    EXPECT_NEAR(view.depth.At(320, 240), 2.8, 1e-4);
  }
}

}  // namespace
}  // namespace etude
