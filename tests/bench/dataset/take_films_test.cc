#include "bench/dataset/take_films.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "io/files/files.h"
#include "io/images/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TakeFilms : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(::testing::TempDir()) / (std::string("etude_take_films_") + info->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::vector<std::string> Saved() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  fs::path folder_;
};

std::string Grey(int value, int width = 32) {
  const auto level = static_cast<std::uint8_t>(value);
  return EncodePng(ColourImage(width, 24, {level, level, level}));
}

TEST_F(TakeFilms, AreOneForEachCamera) {
  const std::vector<Attachment> files = {{"camera-1-background.png", Grey(9)},
                                         {"camera-1-0000.png", Grey(10)},
                                         {"camera-1-0001.png", Grey(200)},
                                         {"marks-hue-camera-1.coco.json", "{}"},
                                         {"camera-2-0000.png", Grey(90)}};
  ASSERT_TRUE(SaveTakeFilms(files, 30, folder_));
  EXPECT_THAT(Saved(), ElementsAre("camera-1.mp4", "camera-2.mp4"));
  const std::string film = ReadWholeFile(folder_ / "camera-1.mp4").value_or("");
  EXPECT_THAT(film.substr(0, 12), HasSubstr("ftyp"));
  ASSERT_TRUE(SaveTakeFilms(files, 30, folder_));
  EXPECT_EQ(film, ReadWholeFile(folder_ / "camera-1.mp4").value_or(""));
}

TEST_F(TakeFilms, AreNoneWhereThereAreNoPictures) {
  ASSERT_TRUE(SaveTakeFilms(std::vector<Attachment>{{"clip.bvh", "HIERARCHY"}}, 30, folder_));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(TakeFilms, SayWhatFfmpegSays) {
  const auto saved = SaveTakeFilms(std::vector<Attachment>{{"camera-1-0000.png", Grey(1, 31)}}, 30, folder_);
  ASSERT_FALSE(saved);
  EXPECT_THAT(ToString(saved.error()), HasSubstr("camera-1.mp4"));
}

}  // namespace
}  // namespace etude
