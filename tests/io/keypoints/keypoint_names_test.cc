#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/io/keypoints/keypoint_files.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class KeypointNamesOfFiles : public testing::KeypointFiles {
 protected:
  /// The order of COCO's 17 keypoints, as pycocotools' documentation lists it.
  const std::vector<std::string> coco_ = {"nose",          "left_eye",       "right_eye",  "left_ear",    "right_ear",
                                          "left_shoulder", "right_shoulder", "left_elbow", "right_elbow", "left_wrist",
                                          "right_wrist",   "left_hip",       "right_hip",  "left_knee",   "right_knee",
                                          "left_ankle",    "right_ankle"};

  static std::string Quoted(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return text;
  }
  /// Returns `count` triples; keypoint i lies at (10 + i, 20).
  static std::string Row(std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) text += fmt::format("{}{}, 20, 2", i == 0 ? "" : ", ", 10 + i);
    return text;
  }
  /// Returns where the landmark was read by a data set with these names; 0 if it was not seen.
  double ReadAt(Landmark landmark, const std::vector<std::string>& names, std::size_t count,
                const std::string& layout = "") {
    const auto film = ReadKeypoints(Coco(names, count), layout);
    if (!film) ADD_FAILURE() << ToString(film.error());
    const Keypoint keypoint = film ? film->frames[0][0][landmark] : Keypoint{};
    return keypoint.confidence > 0 ? keypoint.pixel.x - 10.5 : -1;
  }
  std::filesystem::path Coco(const std::vector<std::string>& names, std::size_t count) {
    return Write("coco.json",
                 R"({"images": [{"id": 1}], "annotations": [{"image_id": 1, "category_id": 7, "keypoints": [)" +
                     Row(count) + R"(]}], "categories": [{"id": 7, "name": "person", "keypoints": [)" + Quoted(names) +
                     "]}]}");
  }
};

TEST_F(KeypointNamesOfFiles, DecideAlsoIfTheirNumberFitsALayout) {
  std::vector<std::string> reversed(coco_.rbegin(), coco_.rend());
  EXPECT_EQ(ReadAt(Landmark::kNose, coco_, 17), 0);
  EXPECT_EQ(ReadAt(Landmark::kRightAnkle, coco_, 17), 16);
  EXPECT_EQ(ReadAt(Landmark::kNose, reversed, 17), 16);
  EXPECT_EQ(ReadAt(Landmark::kRightAnkle, reversed, 17), 0);
  // 18 keypoints with the neck at the end are not OpenPose's 18, whose neck is the second one.
  std::vector<std::string> with_neck = coco_;
  with_neck.push_back("neck");
  EXPECT_EQ(ReadAt(Landmark::kNeck, with_neck, 18), 17);
  EXPECT_EQ(ReadAt(Landmark::kLeftEye, with_neck, 18), 1);
  // A name that is not known is not a landmark, whatever the layout says.
  std::vector<std::string> with_tail = coco_;
  with_tail[1] = "tail";
  EXPECT_EQ(ReadAt(Landmark::kLeftEye, with_tail, 17), -1);
}

TEST_F(KeypointNamesOfFiles, ThatAreNumbersAreNoNames) {
  std::vector<std::string> numbers;
  for (int i = 1; i <= 17; ++i) numbers.push_back(fmt::format("kp_{}", i));
  EXPECT_EQ(ReadAt(Landmark::kLeftEye, numbers, 17), 1);
}

TEST_F(KeypointNamesOfFiles, MayPutTheSideAtTheEndAndCallTheAnkleAFoot) {
  std::vector<std::string> ends;
  for (const std::string& name : coco_) {
    const bool is_left = name.starts_with("left_"), is_right = name.starts_with("right_");
    ends.push_back(is_left ? name.substr(5) + ".L" : is_right ? name.substr(6) + ".R" : name);
  }
  EXPECT_EQ(ReadAt(Landmark::kLeftAnkle, ends, 17), 15);
  EXPECT_EQ(ReadAt(Landmark::kRightHip, ends, 17), 12);
  const std::vector<std::string> h36m = {"root",        "right_hip",     "right_knee", "right_foot", "left_hip",
                                         "left_knee",   "left_foot",     "spine",      "thorax",     "neck_base",
                                         "head",        "left_shoulder", "left_elbow", "left_wrist", "right_shoulder",
                                         "right_elbow", "right_wrist"};
  EXPECT_EQ(ReadAt(Landmark::kRightAnkle, h36m, 17), 3);
  EXPECT_EQ(ReadAt(Landmark::kMidHip, h36m, 17), 0);
  EXPECT_EQ(ReadAt(Landmark::kNose, h36m, 17), -1);
}

TEST_F(KeypointNamesOfFiles, OfManyPointsOfAHandAreNotTheHand) {
  std::vector<std::string> names = coco_;
  names[1] = "left_hand_1";
  names[2] = "left_hand_2";
  EXPECT_EQ(ReadAt(Landmark::kLeftHand, names, 17), -1);
  names[1] = "head";
  names[2] = "head_top";
  EXPECT_EQ(ReadAt(Landmark::kHead, names, 17), 2);
}

TEST_F(KeypointNamesOfFiles, ThatAreNotKnownOrContradictTheLayoutAreRefused) {
  const std::vector<std::string> own = {"鼻", "a", "b", "c", "d", "e", "f", "g", "h",
                                        "i",  "j", "k", "l", "m", "n", "o", "p"};
  EXPECT_THAT(Reason(Coco(own, 17)), HasSubstr("only 0 of the 17 keypoint names (鼻, a, b"));
  EXPECT_THAT(Reason(Coco(own, 17)), HasSubstr("allowed: at least 12 names of Nose, LEye"));
  EXPECT_EQ(ReadAt(Landmark::kLeftEye, own, 17, "coco"), 1) << "what is said counts";
  const std::vector<std::string> reversed(coco_.rbegin(), coco_.rend());
  EXPECT_THAT(Reason(Coco(reversed, 17), "coco"),
              HasSubstr("keypoint 1 has the name right_ankle in the file, but is Nose in the layout coco"));
  // Names of another number than the keypoints: the layout, if they do not contradict it.
  EXPECT_EQ(ReadAt(Landmark::kLeftEye, coco_, 26), 1);
  EXPECT_THAT(Reason(Coco(reversed, 26)), HasSubstr("allowed: a name for each keypoint"));
  EXPECT_THAT(Reason(Coco(coco_, 19)), HasSubstr("found 19 keypoints per person, but 17 names (nose, left_eye"));
}

TEST_F(KeypointNamesOfFiles, AreReadFromMmposeAndFromPoints) {
  const std::vector<std::string> reversed(coco_.rbegin(), coco_.rend());
  std::string id2name, name2id, pairs, points;
  for (std::size_t i = 0; i < reversed.size(); ++i) {
    const char* comma = i == 0 ? "" : ", ";
    id2name += fmt::format("{}\"{}\": \"{}\"", comma, i, reversed[i]);
    name2id += fmt::format("{}\"{}\": {}", comma, reversed[i], i);
    pairs += fmt::format("{}[{}, 20]", comma, 10 + i);
    points += fmt::format(R"({}{{"x": {}, "y": 20, "name": "{}"}})", comma, 10 + i, reversed[i]);
  }
  const std::string people = R"("instance_info": [{"frame_id": 0, "instances": [{"keypoints": [)" + pairs + "]}]}]}";
  for (const std::string& text : {R"({"meta_info": {"keypoint_id2name": {)" + id2name + "}}, " + people,
                                  R"({"meta_info": {"keypoint_id2name": [)" + Quoted(reversed) + "]}, " + people,
                                  R"({"meta_info": {"keypoint_name2id": {)" + name2id + "}}, " + people,
                                  R"([{"frame": 0, "keypoints": [)" + points + "]}]"}) {
    const auto film = ReadKeypoints(Write("m.json", text), "");
    ASSERT_TRUE(film) << text << ToString(film.error());
    EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel.x, 26.5) << text;
  }
  // A file of one picture, as MMPose's scripts write it for pictures.
  Write("folder/0.json", R"({"meta_info": {"keypoint_id2name": {)" + id2name +
                             R"(}}, "instance_info": [{"keypoints": [)" + pairs + "]}]}");
  Write("folder/1.json", R"({"meta_info": {}, "instance_info": []})");
  ASSERT_OK(film, ReadKeypoints(folder_.path() / "folder", ""));
  ASSERT_EQ(film->frames.size(), 2u);
  EXPECT_EQ(film->frames[0][0][Landmark::kNose].pixel.x, 26.5);
  EXPECT_TRUE(film->frames[1].empty());
}

}  // namespace
}  // namespace etude
