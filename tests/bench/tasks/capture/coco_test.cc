#include "bench/tasks/capture/coco.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace etude {
namespace {

std::size_t StrokeOf(Role from, Role to) {
  std::size_t i = 0;
  while (i < kStrokeCount && !(StrokeMarks()[i].from == from && StrokeMarks()[i].to == to)) ++i;
  EXPECT_LT(i, kStrokeCount);
  return i;
}

Marks SomeMarks() {
  Marks marks;
  marks.strokes[StrokeOf(Role::kLeftShoulder, Role::kLeftElbow)] = PixelSegment{{100.5, 50.5}, {120.5, 80.5}};
  marks.strokes[StrokeOf(Role::kLeftElbow, Role::kLeftWrist)] = PixelSegment{{124.5, 84.5}, {140.5, 120.5}};
  marks.strokes[StrokeOf(Role::kRightKnee, Role::kRightAnkle)] = PixelSegment{{60.5, 200.5}, {58.5, 260.5}};
  return marks;
}

TEST(Coco, HasTheEndsOfStrokesAndTheirMeanWhereTheyMeet) {
  const auto keypoints = CocoKeypointsOf(SomeMarks());
  EXPECT_EQ(keypoints[5], glm::dvec2(100.5, 50.5)) << "left_shoulder";
  EXPECT_EQ(keypoints[7], glm::dvec2(122.5, 82.5)) << "left_elbow, of two strokes";
  EXPECT_EQ(keypoints[9], glm::dvec2(140.5, 120.5)) << "left_wrist";
  EXPECT_EQ(keypoints[14], glm::dvec2(60.5, 200.5)) << "right_knee";
  EXPECT_EQ(keypoints[16], glm::dvec2(58.5, 260.5)) << "right_ankle";
  EXPECT_EQ(std::ranges::count_if(keypoints, [](const auto& k) { return k.has_value(); }), 5);
}

// The fields that pycocotools reads, by their published description.
TEST(Coco, WritesWhatItsReadersExpect) {
  const std::vector<std::string> pictures{"camera-1-0000.png", "camera-1-0001.png"};
  const std::vector<Marks> marks{Marks{}, SomeMarks()};
  const nlohmann::json file = nlohmann::json::parse(*WriteCocoKeypoints({}, pictures, marks));
  ASSERT_EQ(file["images"].size(), 2u);
  EXPECT_EQ(file["images"][1]["file_name"], "camera-1-0001.png");
  EXPECT_EQ(file["images"][1]["width"], 640);
  ASSERT_EQ(file["categories"].size(), 1u);
  EXPECT_EQ(file["categories"][0]["keypoints"].size(), 17u);
  EXPECT_EQ(file["categories"][0]["keypoints"][16], "right_ankle");
  EXPECT_EQ(file["categories"][0]["skeleton"].size(), 19u);
  ASSERT_EQ(file["annotations"].size(), 1u) << "nothing was marked in the first";
  const nlohmann::json& person = file["annotations"][0];
  EXPECT_EQ(person["image_id"], file["images"][1]["id"]);
  EXPECT_EQ(person["category_id"], file["categories"][0]["id"]);
  ASSERT_EQ(person["keypoints"].size(), 51u);
  EXPECT_EQ(person["num_keypoints"], 5);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(person["keypoints"][static_cast<std::size_t>(i)], 0) << "no face";
  EXPECT_EQ(person["keypoints"][15], 100) << "the first pixel's centre is 0, not 0.5";
  EXPECT_EQ(person["keypoints"][17], 2);
  EXPECT_EQ(person["bbox"], nlohmann::json({58, 50, 82, 210}));
  EXPECT_EQ(person["area"], 82 * 210);
}

}  // namespace
}  // namespace etude
