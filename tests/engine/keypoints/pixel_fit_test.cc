#include "engine/keypoints/pixel_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/keypoints/agreement.h"
#include "engine/keypoints/people.h"

namespace etude {
namespace {

TEST(PixelFit, PutsALetterboxedPictureBetweenItsBars) {
  // A picture of 1088 × 1920 in a film of 1080 × 1920: smaller by 0.9926, with bars of 7 pixels.
  const auto fit = FitPictures(FitMode::kLetterbox, {1088, 1920}, {1080, 1920});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale.x, 0.99265, 1e-5);
  EXPECT_NEAR(fit->scale.y, 0.99265, 1e-5);
  EXPECT_NEAR(fit->shift.x, 0, 1e-9);
  EXPECT_NEAR(fit->shift.y, 7.06, 0.01);
  const glm::dvec2 rig(300, 1200);
  EXPECT_LT(glm::distance(fit->ToRig(fit->ToFilm(rig)), rig), 1e-9);
  EXPECT_LT(glm::distance(fit->ToFilm({544, 960}), glm::dvec2(540, 960)), 1e-9) << "middles meet";
}

TEST(PixelFit, StretchesCropsAndRefuses) {
  const auto stretch = FitPictures(FitMode::kStretch, {100, 50}, {200, 25});
  EXPECT_EQ(stretch->ToFilm({10, 10}), glm::dvec2(20, 5));
  const auto crop = FitPictures(FitMode::kCrop, {100, 50}, {80, 50});
  EXPECT_EQ(crop->ToFilm({10, 10}), glm::dvec2(0, 10));
  const auto none = FitPictures(FitMode::kNone, {1088, 1920}, {1080, 1920});
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, testing::HasSubstr("1080 x 1920 pixels, the rig's camera 1088 x 1920"));
  EXPECT_TRUE(FitPictures(FitMode::kNone, {640, 480}, {640, 480})->IsNone());
}

TEST(Agreement, ComparesMarkersOfOneNameFrameByFrame) {
  MarkerMotion a{.rate_hz = 30, .names = {"RHip", "LHip"}, .frames = {}}, b = a;
  b.names = {"LHip", "Neck", "RHip"};
  for (int k = 0; k < 4; ++k) {
    a.frames.push_back({glm::dvec3(0), glm::dvec3(1)});
    b.frames.push_back({glm::dvec3(1), glm::dvec3(5), glm::dvec3(0, 0.001 * (k + 1), 0)});
  }
  a.frames[3][0].reset();
  const auto agreement = CompareMarkers(a, b);
  ASSERT_EQ(agreement.size(), 2u);
  EXPECT_EQ(agreement[0].name, "LHip");
  EXPECT_DOUBLE_EQ(agreement[0].median_mm, 0);
  EXPECT_EQ(agreement[1].frames, 3u) << "what one of them lacks does not count";
  EXPECT_DOUBLE_EQ(agreement[1].median_mm, 2);
  EXPECT_EQ(CompareAllMarkers(a, b).frames, 7u);
}

TEST(MarkedPerson, HasJointsWhereStrokesMeet) {
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (StrokeMarks()[i].to == Role::kLeftElbow) marks.strokes[i] = PixelSegment{{10, 10}, {20, 30}};
    if (StrokeMarks()[i].to == Role::kLeftWrist) marks.strokes[i] = PixelSegment{{22, 32}, {40, 40}};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (EffectorMarks()[i].role == Role::kHead) marks.effectors[i] = glm::dvec2(5, 6);
  }
  const SeenPerson person = PersonOf(marks);
  EXPECT_EQ(person[Landmark::kLeftShoulder].pixel, glm::dvec2(10, 10));
  EXPECT_EQ(person[Landmark::kLeftElbow].pixel, glm::dvec2(21, 31));
  EXPECT_EQ(person[Landmark::kHead].pixel, glm::dvec2(5, 6));
  EXPECT_EQ(person[Landmark::kHead].confidence, 1);
  EXPECT_EQ(person[Landmark::kRightKnee].confidence, 0);
}

TEST(Landmarks, LayoutsNameEveryKeypointOnce) {
  for (const KeypointLayout& layout : KeypointLayouts()) {
    std::vector<bool> seen(kLandmarkCount);
    for (const Landmark landmark : layout.landmarks) {
      if (landmark == Landmark::kNoLandmark) continue;
      EXPECT_FALSE(seen[Index(landmark)]) << layout.name;
      seen[Index(landmark)] = true;
    }
  }
  EXPECT_EQ(FindKeypointLayout("coco")->landmarks.size(), 17u);
  EXPECT_EQ(FindKeypointLayout("body_25")->landmarks[8], Landmark::kMidHip);
  EXPECT_EQ(FindKeypointLayout("body_25b")->landmarks[24], Landmark::kRightHeel);
  EXPECT_EQ(FindKeypointLayout("nothing"), nullptr);
}

}  // namespace
}  // namespace etude
