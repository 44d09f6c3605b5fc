#include <gtest/gtest.h>

#include "sim/render/renderer.h"
#include "tests/sim/render/dancer.h"
#include "tests/sim/render/ray_caster.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TEST(Renderer, AgreesWithARayCasterOnEveryLabelAndDepth) {
  ASSERT_OK(renderer, SharedRenderer());
  for (const Camera& camera : TestCameras()) {
    const View view = (*renderer)->Render({}, {{Dancer(), PerformerColours()}}, camera, Targets::kAll);
    const Comparison result = Compare(view, {camera, Dancer()});
    EXPECT_GT(result.compared, 8000);
    EXPECT_EQ(result.wrong_labels, 0);
    EXPECT_LT(result.worst_depth, 1e-3);
    EXPECT_LT(result.on_outlines, result.compared / 500);
  }
}

TEST(Renderer, WouldBeCaughtBeingHalfAPixelOff) {
  ASSERT_OK(renderer, SharedRenderer());
  Camera camera = TestCameras().front();
  const View view = (*renderer)->Render({}, {{Dancer(), PerformerColours()}}, camera, Targets::kAll);
  camera.intrinsics.cx += 0.5;
  EXPECT_GT(Compare(view, {camera, Dancer()}).wrong_labels, 50);
}

TEST(Renderer, ShowsTheEndsOfEveryCapsuleWhereProjectPutsThem) {
  ASSERT_OK(renderer, SharedRenderer());
  const Camera camera = LookAt({}, {0.9, 1.3, 4.0}, {0, 0.95, 0});
  for (const Capsule& capsule : Dancer()) {
    const View view = (*renderer)->Render({}, {{{capsule}, PerformerColours()}}, camera, Targets::kAll);
    for (const glm::dvec3& end : {capsule.a, capsule.b}) {
      ASSERT_OK(pixel, Project(MatrixOf(camera), end));
      EXPECT_EQ(view.labels.At(static_cast<int>(pixel->x), static_cast<int>(pixel->y)),
                static_cast<std::uint32_t>(capsule.part));
    }
  }
}

TEST(Renderer, ShowsTheNearerOfTwoBodiesWhicheverIsGivenFirst) {
  ASSERT_OK(renderer, SharedRenderer());
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
