#include "bench/films/encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "bench/files/files.h"
#include "engine/formats/wav.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

fs::path FilmPath() {
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::path(::testing::TempDir()) / ("etude_encoder_" + test);
  fs::remove_all(folder);
  return folder / "film.mp4";
}

TEST(Encoder, GivesTheSameBytesForTheSamePictures) {
  const auto encode = [](const fs::path& sound) {
    const fs::path path = FilmPath();
    auto encoder = Encoder::Start(path, 64, 48, 30, sound);
    EXPECT_TRUE(encoder.has_value()) << ToString(encoder.error());
    for (int i = 0; i < 10; ++i) {
      EXPECT_TRUE(encoder->Add(ColourImage(64, 48, {static_cast<std::uint8_t>(20 * i), 90, 30})).has_value());
    }
    const auto finished = encoder->Finish();
    EXPECT_TRUE(finished.has_value()) << ToString(finished.error());
    EXPECT_FALSE(fs::exists(TemporaryName(path)));
    return ReadWholeFile(path).value_or("");
  };
  const std::string silent = encode({});
  EXPECT_THAT(silent.substr(0, 12), HasSubstr("ftyp"));
  EXPECT_THAT(silent, Not(HasSubstr("fLaC")));
  EXPECT_EQ(silent, encode({}));

  const fs::path clicks = fs::path(::testing::TempDir()) / "etude_film_clicks.wav";
  ASSERT_TRUE(WriteFileAtomically(clicks, WriteWav(std::vector<double>(44100 / 3, 0.5), 44100)));
  const std::string clicking = encode(clicks);
  EXPECT_THAT(clicking, HasSubstr("fLaC"));
  EXPECT_EQ(clicking, encode(clicks));
  fs::remove(clicks);
}

TEST(Encoder, SaysThatTheProgramIsMissing) {
  const auto encoder = Encoder::Start(FilmPath(), 64, 48, 30, {}, Encoder::Form::kRgb, "no-such-encoder");
  ASSERT_FALSE(encoder.has_value());
  EXPECT_THAT(ToString(encoder.error()), HasSubstr("no-such-encoder could not be started"));
}

TEST(Encoder, ReportsAProgramThatGivesUpInsteadOfDying) {
  auto encoder = Encoder::Start(FilmPath(), 64, 48, 30, {}, Encoder::Form::kRgb, "false");
  ASSERT_TRUE(encoder.has_value());
  Result<void> added;
  for (int i = 0; i < 500 && added; ++i) added = encoder->Add(ColourImage(64, 48));
  const auto ended = added ? encoder->Finish() : added;
  EXPECT_FALSE(ended.has_value());
}

TEST(Encoder, LeavesNothingBehindWhenDropped) {
  const fs::path path = FilmPath();
  {
    auto encoder = Encoder::Start(path, 64, 48, 30);
    ASSERT_TRUE(encoder.has_value());
    ASSERT_TRUE(encoder->Add(ColourImage(64, 48)).has_value());
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(fs::exists(TemporaryName(path)));
}

}  // namespace

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
