#include <fmt/format.h>
#include <gmock/gmock.h>

#include <functional>

#include "tests/io/keypoints/keypoint_files.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class CocoFile : public testing::KeypointFiles {
 protected:
  /// Writes images with ids from 1 in this order, and in the image of number k a person whose nose is at x = k + 1.
  std::filesystem::path Images(const std::vector<int>& numbers, const std::function<std::string(int)>& name,
                               const std::string& more = "") {
    std::string images, annotations;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const char* comma = i == 0 ? "" : ", ";
      images += fmt::format(R"({}{{"id": {}, "file_name": "{}"}})", comma, i + 1, name(numbers[i]));
      annotations += fmt::format(R"({}{{"image_id": {}, "category_id": 1, "keypoints": [{}]}})", comma, i + 1,
                                 Triples(17, fmt::format("{}, 20, 2", numbers[i] + 1)));
    }
    return Write("coco.json", "{\"images\": [" + images + "], \"annotations\": [" + annotations + more +
                                  R"(], "categories": [{"id": 2, "name": "ball", "keypoints": ["centre"]},
                                                       {"id": 1, "name": "person"}]})");
  }
  static std::vector<double> Noses(const PeopleOfFilm& film) {
    std::vector<double> noses;
    for (const auto& frame : film.frames) {
      noses.push_back(frame.empty() ? -1 : frame[0][Landmark::kNose].pixel.x - 1.5);
    }
    return noses;
  }
};

TEST_F(CocoFile, TakesImagesInTheOrderOfTheNumbersInTheirNames) {
  const std::vector<int> lexical = {0, 1, 10, 11, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<double> wanted = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  using Name = std::function<std::string(int)>;
  for (const Name& name : {Name([](int k) { return fmt::format("frame_{}.png", k); }),
                           Name([](int k) { return fmt::format("cam1/frame_{}_png.rf.{}.jpg", k, k % 3); }),
                           Name([](int k) { return fmt::format("{}.png", k); })}) {
    ASSERT_OK(film, ReadKeypoints(Images(lexical, name), ""));
    EXPECT_EQ(Noses(*film), wanted) << name(3);
    EXPECT_THAT(film->told, HasSubstr("the file lists the images in another order than the numbers in their names"));
  }
  const auto in_order = ReadKeypoints(Images({0, 1, 2}, [](int k) { return fmt::format("{}.png", k); }), "");
  EXPECT_EQ(in_order->told, "");
}

TEST_F(CocoFile, TakesImagesWithoutNumbersInTheOrderOfTheirIds) {
  const auto letters = [](int k) { return fmt::format("{}.png", std::string(1, static_cast<char>('z' - k))); };
  ASSERT_OK(film, ReadKeypoints(Images({2, 0, 1}, letters), ""));
  EXPECT_EQ(Noses(*film), (std::vector<double>{2, 0, 1})) << "ids 1, 2, 3";
  EXPECT_EQ(film->told, "");
  const std::string person = R"("category_id": 1, "keypoints": [)" + Triples(17) + "]}";
  const auto ids = ReadKeypoints(Write("ids.json", R"({"images": [{"id": 9}, {"id": 4}], "annotations": [)"
                                                   R"({"image_id": 4, )" +
                                                       person + "]}"),
                                 "");
  ASSERT_TRUE(ids) << ToString(ids.error());
  EXPECT_EQ(ids->frames[0].size(), 1u);
  EXPECT_THAT(ids->told, HasSubstr("another order than their ids"));
}

TEST_F(CocoFile, ImagesOfEveryNthFrameAreLaidOnTheFilmsFrames) {
  std::vector<int> tenth;
  for (int k = 0; k < 60; k += 10) tenth.push_back(k);
  const auto path = Images(tenth, [](int k) { return fmt::format("cam_{:05}.png", k); });
  ASSERT_OK(film, ReadKeypoints(path, "", {.frames = 60}));
  ASSERT_EQ(film->frames.size(), 60u);
  EXPECT_EQ(Noses(*film)[30], 30);
  EXPECT_THAT(film->told, HasSubstr("54 of 60 frames are missing"));
  EXPECT_EQ(ReadKeypoints(path, "", {.frames = 6})->frames.size(), 6u) << "a film of these images";
}

TEST_F(CocoFile, LeavesOutWhatShowsNoPersonAndCountsIt) {
  const auto name = [](int k) { return fmt::format("{}.png", k); };
  const std::string boxes =
      R"(, {"image_id": 1, "category_id": 1, "bbox": [1, 2, 3, 4]}, {"image_id": 2, "keypoints": []})";
  const std::string balls = R"(, {"image_id": 3, "category_id": 2, "keypoints": [1, 2, 2]})";
  ASSERT_OK(film, ReadKeypoints(Images({0, 1, 2}, name, boxes + balls), ""));
  EXPECT_EQ(Noses(*film), (std::vector<double>{0, 1, 2}));
  for (const auto& frame : film->frames) EXPECT_EQ(frame.size(), 1u);
  EXPECT_EQ(
      film->told,
      "Etude left out annotations without keypoints: 2; Etude left out annotations of the category ball, because their "
      "keypoints are not those of a person: 1");
  // If nothing else is there, the reason is an error.
  const std::string image = R"({"images": [{"id": 1}], "annotations": [)";
  EXPECT_THAT(Reason(Write("a.json", image + R"({"image_id": 1, "bbox": [1, 2, 3, 4]}]})")),
              HasSubstr("none of 1 annotations has a list 'keypoints'"));
  EXPECT_THAT(Reason(Write("b.json", image + R"({"image_id": 1, "keypoints": [1, 2, 2]}]})")),
              HasSubstr("1 keypoints per person; allowed: coco (17)"));
  // A person with too few keypoints among others is still an error.
  EXPECT_THAT(Reason(Images({0, 1}, name, R"(, {"image_id": 1, "category_id": 1, "keypoints": [1, 2, 2]})")),
              HasSubstr("1 keypoints per person"));
}

}  // namespace
}  // namespace etude
