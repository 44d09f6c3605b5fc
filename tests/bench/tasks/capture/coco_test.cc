#include "bench/tasks/capture/coco.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/keypoints/people.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/keypoints/read_people.h"
#include "tests/support/results.h"

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
  marks.effectors[2] = glm::dvec2(150.5, 140.5);  // the left hand's pixel
  return marks;
}

// The fields that pycocotools reads, according to their published description.
TEST(Coco, WritesWhatItsReadersExpect) {
  const std::vector<std::string> pictures{"camera-1-0000.png", "camera-1-0001.png"};
  const std::vector<Marks> marks{Marks{}, SomeMarks()};
  const nlohmann::json file = nlohmann::json::parse(*WriteCocoKeypoints({}, pictures, marks));
  ASSERT_EQ(file["images"].size(), 2u);
  EXPECT_EQ(file["images"][1]["file_name"], "camera-1-0001.png");
  EXPECT_EQ(file["images"][1]["width"], 640);
  ASSERT_EQ(file["categories"].size(), 1u);
  EXPECT_EQ(file["categories"][0]["keypoints"].size(), 28u);
  EXPECT_EQ(file["categories"][0]["keypoints"][16], "right_ankle") << "the last of COCO's own";
  EXPECT_EQ(file["categories"][0]["keypoints"][26], "left_hand");
  EXPECT_EQ(file["categories"][0]["skeleton"].size(), 24u);
  ASSERT_EQ(file["annotations"].size(), 1u) << "nothing was marked in the first";
  const nlohmann::json& person = file["annotations"][0];
  EXPECT_EQ(person["image_id"], file["images"][1]["id"]);
  EXPECT_EQ(person["category_id"], file["categories"][0]["id"]);
  ASSERT_EQ(person["keypoints"].size(), 84u);
  EXPECT_EQ(person["num_keypoints"], 6);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(person["keypoints"][static_cast<std::size_t>(i)], 0) << "no face";
  EXPECT_EQ(person["keypoints"][15], 100) << "the first pixel's centre is 0, not 0.5";
  EXPECT_EQ(person["keypoints"][17], 2);
  EXPECT_EQ(person["bbox"], nlohmann::json({58, 50, 92, 210}));
  EXPECT_EQ(person["area"], 92 * 210);
}

TEST(Coco, IsReadBackAsThePersonThatTheMarksTell) {
  const auto folder = TemporaryFolder::Make("coco");
  const std::filesystem::path file = folder->path() / "camera-1.coco.json";
  const std::vector<std::string> pictures{"camera-1-0000.png"};
  const std::vector<Marks> marks{SomeMarks()};
  ASSERT_TRUE(WriteFileAtomically(file, *WriteCocoKeypoints({}, pictures, marks)));
  ASSERT_OK(film, ReadKeypoints(file, ""));
  const SeenPerson told = PersonOf(marks[0]), &read = film->frames[0][0];
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    EXPECT_EQ(read.keypoints[i].pixel, told.keypoints[i].pixel) << i;
    EXPECT_EQ(read.keypoints[i].confidence, told.keypoints[i].confidence) << i;
  }
  EXPECT_EQ(read[Landmark::kLeftElbow].pixel, glm::dvec2(122.5, 82.5)) << "the mean of two strokes' ends";
}

}  // namespace
}  // namespace etude
