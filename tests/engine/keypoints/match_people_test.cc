#include "engine/keypoints/match_people.h"

#include <gtest/gtest.h>

#include "engine/keypoints/pixel_fit.h"
#include "engine/keypoints/recover_person.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a person 100 px high with the head at (x, 0).
SeenPerson Upright(double x, double confidence = 1) {
  SeenPerson person;
  person[Landmark::kHead] = {{x, 0}, confidence};
  person[Landmark::kMidHip] = {{x, 50}, confidence};
  person[Landmark::kLeftAnkle] = {{x, 100}, confidence};
  return person;
}

/// Returns the tracks as text, "0:0 1:1 | 2:0" with frame:entry.
std::string TracksOf(const SeenPeople& people, const FollowOptions& options = {}) {
  std::string text;
  for (const PersonTrack& track : FollowPeople(people, options)) {
    if (!text.empty()) text += " |";
    for (const auto& [frame, entry] : track.entries) text += " " + std::to_string(frame) + ":" + std::to_string(entry);
  }
  return text;
}

TEST(FollowPeople, JoinsTheNearestWhateverTheirOrder) {
  EXPECT_EQ(TracksOf({{Upright(0), Upright(300)}, {Upright(310), Upright(5)}}), " 0:0 1:1 | 0:1 1:0");
  EXPECT_EQ(TracksOf({}), "");
}

TEST(FollowPeople, TakesNoLongerStepThanAShareOfTheHeight) {
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(24)}}), " 0:0 1:0");
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(26)}}), " 0:0 | 1:0");
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(26)}}, {.max_step = 0.3}), " 0:0 1:0");
}

TEST(FollowPeople, ForgetsWhoWasAwayTooLong) {
  for (const std::size_t away : {15u, 16u, 90u, 91u}) {
    for (const int max_return : {0, 90}) {
      SeenPeople people(away + 1);
      people[0] = {Upright(0)};
      people[away] = {Upright(1)};
      const std::string last = std::to_string(away) + ":0";
      const bool is_same = away == 15 || (away <= 90 && max_return == 90);
      EXPECT_EQ(TracksOf(people, {.max_return = max_return}), is_same ? " 0:0 " + last : " 0:0 | " + last);
    }
  }
}

TEST(FollowPeople, SomebodyWhoWasAwayForLongerIsNoRival) {
  // The first person was at 100 until frame 0. The second walks there, and is nearer to that place than to the last
  // one.
  SeenPeople people(23);
  people[0] = {Upright(100)};
  for (std::size_t f = 1; f < people.size(); ++f) people[f] = {Upright(300 - 10 * static_cast<double>(f))};
  std::string second;
  for (std::size_t f = 1; f < people.size(); ++f) second += " " + std::to_string(f) + ":0";
  EXPECT_EQ(TracksOf(people), " 0:0 |" + second);
}

TEST(FollowPeople, BeginsAnewWhereTwoAreAsNear) {
  // Two candidates are ambiguous if their distances differ by less than half: 10 and 14 px are, 10 and 16 px are not.
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(10), Upright(-14)}}), " 0:0 | 1:0 | 1:1");
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(10), Upright(-16)}}), " 0:0 1:0 | 1:1");
}

TEST(FollowPeople, PassesOverKeypointsThatAreUnsure) {
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(1, 0.09)}}), " 0:0 | 1:0") << "none is left";
  EXPECT_EQ(TracksOf({{Upright(0)}, {Upright(1, 0.1)}}), " 0:0 1:0");
}

TEST(HeightPx, IsThatOfTheBoxAroundWhatIsSeen) {
  EXPECT_EQ(HeightPx(Upright(40)), 100);
  EXPECT_EQ(HeightPx(SeenPerson{}), 0);
  SeenPerson one;
  one[Landmark::kNose] = {{3, 4}, 0.5};
  EXPECT_EQ(HeightPx(one), 0);
}

TEST(LandmarkOfName, KnowsOtherToolsNames) {
  using enum Landmark;
  for (const auto& [name, landmark] : {std::pair("left_shoulder", kLeftShoulder),
                                       {"LShoulder", kLeftShoulder},
                                       {"Left Big Toe", kLeftBigToe},
                                       {"right foot index", kRightBigToe},
                                       {"WristRight", kRightWrist},
                                       {"mid_hip", kMidHip},
                                       {"pelvis", kMidHip},
                                       {"head_top", kHead},
                                       {"NOSE", kNose},
                                       {"neck", kNeck},
                                       {"l-heel", kLeftHeel},
                                       {"ankle.R", kRightAnkle},
                                       {"Shoulder_L", kLeftShoulder},
                                       {"heel", kNoLandmark},
                                       {"tail", kNoLandmark},
                                       {"", kNoLandmark}}) {
    EXPECT_EQ(LandmarkOfName(name), landmark) << name;
  }
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const auto landmark = static_cast<Landmark>(i);
    EXPECT_EQ(LandmarkOfName(LandmarkName(landmark)), landmark);
    EXPECT_EQ(FindLandmark(LandmarkName(landmark)), landmark);
  }
}

TEST(FindFitMode, KnowsItsFourNames) {
  EXPECT_EQ(FindFitMode("none"), FitMode::kNone);
  EXPECT_EQ(FindFitMode("letterbox"), FitMode::kLetterbox);
  EXPECT_EQ(FindFitMode("stretch"), FitMode::kStretch);
  EXPECT_EQ(FindFitMode("crop"), FitMode::kCrop);
  EXPECT_FALSE(FindFitMode("fill"));
}

TEST(PixelFit, TurnsClockwiseAndBack) {
  // The top left pixel of 100 × 50 moves to the top right of 50 × 100, and so on.
  const glm::dvec2 size(100, 50);
  const auto turned = [&](int turns, bool mirrored, glm::dvec2 p) {
    return PixelFit{.quarter_turns = turns, .is_mirrored = mirrored, .size = size}.ToFilm(p);
  };
  EXPECT_EQ(turned(1, false, {0, 0}), glm::dvec2(50, 0));
  EXPECT_EQ(turned(2, false, {0, 0}), glm::dvec2(100, 50));
  EXPECT_EQ(turned(3, false, {0, 0}), glm::dvec2(0, 100));
  EXPECT_EQ(turned(0, true, {10, 20}), glm::dvec2(90, 20));
  EXPECT_EQ(turned(1, true, {10, 20}), glm::dvec2(30, 90)) << "mirrored, then turned";
  for (int turns = 0; turns < 4; ++turns) {
    for (const bool mirrored : {false, true}) {
      const PixelFit fit{
          .scale = {2, 3}, .shift = {4, -5}, .quarter_turns = turns, .is_mirrored = mirrored, .size = size};
      EXPECT_LT(glm::distance(fit.ToRig(fit.ToFilm({7, 11})), glm::dvec2(7, 11)), 1e-12) << turns << mirrored;
      EXPECT_FALSE(fit.IsNone());
    }
  }
}

TEST(BodyOfBones, HasBonesOfTheseLengths) {
  std::array<double, kRoleCount> lengths;
  for (std::size_t i = 0; i < kRoleCount; ++i) lengths[i] = 0.2 + 0.01 * static_cast<double>(i);
  ASSERT_OK(body, BodyOfBones(lengths));
  for (const Bone& bone : AllBones()) {
    EXPECT_NEAR(body->bones[Index(bone.child)], lengths[Index(bone.child)], 1e-12) << RoleName(bone.child);
  }
}

}  // namespace
}  // namespace etude
