#include "bench/dataset/take_films.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "io/files/files.h"
#include "io/films/decoder.h"
#include "io/images/image_files.h"
#include "tests/support/results.h"

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
  EXPECT_THAT(Saved(), ElementsAre("camera-1.mkv", "camera-2.mkv"));
  const std::string film = ReadWholeFile(folder_ / "camera-1.mkv").value_or("");
  EXPECT_EQ(film.substr(0, 4), "\x1a\x45\xdf\xa3") << "the head of Matroska";
  ASSERT_TRUE(SaveTakeFilms(files, 30, folder_));
  EXPECT_EQ(film, ReadWholeFile(folder_ / "camera-1.mkv").value_or(""));
}

TEST_F(TakeFilms, AreNoneWhereThereAreNoPictures) {
  ASSERT_TRUE(SaveTakeFilms(std::vector<Attachment>{{"clip.bvh", "HIERARCHY"}}, 30, folder_));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(TakeFilms, KeepEveryBitOfEveryPicture) {
  // Pictures of an odd size with noise in every channel.
  std::vector<ColourImage> pictures(4, ColourImage(31, 23));
  std::vector<Attachment> files;
  std::uint32_t state = 1;
  const auto next = [&] { return static_cast<std::uint8_t>((state = 1664525 * state + 1013904223) >> 24); };
  for (ColourImage& picture : pictures) {
    for (Rgb8& pixel : picture.pixels) pixel = {next(), next(), next()};
    files.push_back({"camera-1-000" + std::to_string(files.size()) + ".png", EncodePng(picture)});
  }
  ASSERT_TRUE(SaveTakeFilms(files, 30, folder_));
  ASSERT_OK(facts, ProbeFilm(folder_ / "camera-1.mkv"));
  EXPECT_EQ(facts->frames, 4);
  EXPECT_EQ(facts->rate_hz, 30);
  auto film = Decoder::Start(folder_ / "camera-1.mkv", *facts);
  ASSERT_TRUE(film) << ToString(film.error());
  ColourImage frame;
  for (const ColourImage& picture : pictures) {
    ASSERT_TRUE(film->Next(frame).value_or(false));
    EXPECT_EQ(frame.pixels, picture.pixels);
  }
  EXPECT_FALSE(film->Next(frame).value_or(true));
}

TEST_F(TakeFilms, SayWhyTheyCannotBeWritten) {
  ASSERT_TRUE(WriteFileAtomically(folder_, "a file where the folder would be"));
  EXPECT_THAT(testing::Refusal(SaveTakeFilms(std::vector<Attachment>{{"camera-1-0000.png", Grey(1)}}, 30, folder_)),
              HasSubstr("etude_take_films_"));
  EXPECT_THAT(testing::Refusal(
                  SaveTakeFilms(std::vector<Attachment>{{"camera-1-0000.png", Grey(1).substr(0, 50)}}, 30, folder_)),
              HasSubstr("PNG"));
}

}  // namespace
}  // namespace etude
