#include "io/films/encoder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "engine/formats/wav.h"
#include "io/files/files.h"
#include "io/images/image_files.h"

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

/// Returns a program that runs ffmpeg, but lets x264 use only some instruction sets.
std::string FfmpegWith(const std::string& instructions) {
  const fs::path program = fs::path(::testing::TempDir()) / ("etude_ffmpeg_" + instructions);
  EXPECT_TRUE(WriteFileAtomically(program, fmt::format("#!/bin/bash\nexec ffmpeg \"${{@/cpu-independent=1/"
                                                       "cpu-independent=1:asm={}}}\"\n",
                                                       instructions)));
  fs::permissions(program, fs::perms::owner_all);
  return program;
}

TEST(Encoder, GivesTheSameBytesOnEveryProcessor) {
  // A texture that moves by fractions of pixels, so that x264 has to search, filter and choose.
  const auto encode = [](const std::string& program) {
    const fs::path path = FilmPath();
    auto encoder = Encoder::Start(path, 192, 144, 30, {}, Encoder::Form::kRgb, program);
    EXPECT_TRUE(encoder.has_value()) << ToString(encoder.error());
    for (int i = 0; i < 12; ++i) {
      ColourImage picture(192, 144);
      for (std::size_t p = 0; p < picture.pixels.size(); ++p) {
        const double x = static_cast<double>(p % 192), y = static_cast<double>(p / 192), t = i;
        const double wave = 60 * std::sin(0.21 * x + 0.3 * t) + 50 * std::sin(0.13 * y * (1 + 0.01 * x) - 0.4 * t);
        const auto value = static_cast<std::uint8_t>(127 + wave);
        picture.pixels[p] = {value, static_cast<std::uint8_t>(p * 7 % 31 + 90), static_cast<std::uint8_t>(255 - value)};
      }
      EXPECT_TRUE(encoder->Add(picture).has_value());
    }
    EXPECT_TRUE(encoder->Finish().has_value());
    return ReadWholeFile(path).value_or("");
  };
  const std::string own = encode("ffmpeg");
  EXPECT_GT(own.size(), 5000u);
  for (const char* instructions : {"AVX2", "SSE4.2", "SSE2", "0"}) {
    EXPECT_TRUE(encode(FfmpegWith(instructions)) == own) << instructions;
  }
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
}  // namespace etude
