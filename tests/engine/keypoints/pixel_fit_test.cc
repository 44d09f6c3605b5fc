#include "engine/keypoints/pixel_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/keypoints/agreement.h"
#include "engine/keypoints/people.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TEST(PixelFit, PutsALetterboxedPictureBetweenItsBars) {
  // A picture of 1088 × 1920 in a film of 1080 × 1920 is scaled by 0.9926, with bars of 7 pixels.
  ASSERT_OK(fit, FitPictures(FitMode::kLetterbox, {1088, 1920}, {1080, 1920}));
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
  EXPECT_THAT(testing::Message(FitPictures(FitMode::kNone, {1088, 1920}, {1080, 1920})),
              ::testing::HasSubstr("1080 x 1920 pixels, but the rig's camera has 1088 x 1920"));
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

/// Returns two moving markers at a rate; the second is unseen for a while.
MarkerMotion MovingMarkers(double rate_hz, std::size_t frames, double delay_s = 0) {
  MarkerMotion motion{.rate_hz = rate_hz, .names = {"LHip", "RHip"}, .frames = {}};
  for (std::size_t k = 0; k < frames; ++k) {
    const double t = static_cast<double>(k) / rate_hz + delay_s;
    motion.frames.push_back({glm::dvec3(0.3 * std::sin(3 * t), 1, t), glm::dvec3(t, std::cos(2 * t), 0.5)});
    if (k > 20 && k < 26) motion.frames.back()[1].reset();
  }
  return motion;
}

TEST(Agreement, ResamplesStraightBetweenFramesAndBridgesNoGap) {
  const MarkerMotion half = AtRate(MovingMarkers(60, 121), 30);
  ASSERT_EQ(half.frames.size(), 61u);
  EXPECT_EQ(half.frames[10][0], MovingMarkers(60, 121).frames[20][0]) << "a frame that is there stays as it is";
  const MarkerMotion slow = AtRate(MovingMarkers(25, 51), 30);
  ASSERT_EQ(slow.frames.size(), 61u) << "two seconds";
  const MarkerMotion truth = MovingMarkers(25, 51);
  EXPECT_LT(glm::distance(*slow.frames[1][0], glm::mix(*truth.frames[0][0], *truth.frames[1][0], 25 / 30.0)), 1e-12);
  for (std::size_t k = 0; k < slow.frames.size(); ++k) {
    const double at = static_cast<double>(k) * 25 / 30;
    EXPECT_EQ(slow.frames[k][1].has_value(), at < 20 + 1e-9 || at > 26 - 1e-9) << k;
  }
  EXPECT_EQ(AtRate(MovingMarkers(29.97, 40), 30).frames, MovingMarkers(29.97, 40).frames) << "one rate";
}

TEST(Agreement, MeasuresHowTwoRatesThatAreOneDriftApart) {
  const MarkerMotion motion = MovingMarkers(30, 300), reference = MovingMarkers(29.97, 300);
  ASSERT_OK(clock, MeasureClock(motion, reference));
  EXPECT_NEAR(clock->DriftOver(300), -0.3, 0.02);
  EXPECT_LT(clock->after, 0.1 * clock->before);
  const MarkerMotion set = AtClock(reference, *clock, 300, 30);
  EXPECT_LT(CompareAllMarkers(motion, set).median_mm, 0.2 * CompareAllMarkers(motion, reference).median_mm);
  ASSERT_OK(late, MeasureClock(motion, MovingMarkers(30, 300, -1.5 / 30)));
  EXPECT_NEAR(late->at, 1.5, 0.02);
  EXPECT_NEAR(late->DriftOver(300), 0, 0.02);
  ASSERT_OK(same, MeasureClock(motion, motion));
  EXPECT_EQ(same->at, 0);
  EXPECT_EQ(same->stretch, 0);
  MarkerMotion others = motion;
  others.names = {"Neck", "Head"};
  EXPECT_FALSE(MeasureClock(motion, others));
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
