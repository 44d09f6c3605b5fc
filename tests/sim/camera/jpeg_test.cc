#include "sim/camera/jpeg.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "engine/base/digest.h"
#include "tests/sim/camera/shots.h"
#include "tests/support/results.h"

namespace etude {
namespace {

ColourImage Smooth(int width = 160, int height = 120) {
  ColourImage picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double wave = 40 * std::sin(x / 17.0) + 30 * std::cos(y / 13.0);
      const auto code = static_cast<std::uint8_t>(120 + wave);
      picture.At(x, y) = {code, static_cast<std::uint8_t>(code + 10), static_cast<std::uint8_t>(code - 20)};
    }
  }
  return picture;
}

// Returns a file's luminance table: the content of its first DQT marker, in zigzag order.
std::array<int, 64> LuminanceTable(const std::string& jpeg) {
  const std::size_t at = jpeg.find(std::string("\xff\xdb", 2)) + 5;
  std::array<int, 64> table;
  for (std::size_t i = 0; i < 64; ++i) table[i] = static_cast<unsigned char>(jpeg[at + i]);
  return table;
}

// Returns the quality by which libjpeg scales table K.1 of ITU-T T.81 (zigzag order).
int QualityOf(const std::string& jpeg) {
  constexpr std::array<int, 64> kTable = {16, 11, 12,  14,  12,  10, 16, 14,  13,  14,  18,  17,  16, 19,  24,  40,
                                          26, 24, 22,  22,  24,  49, 35, 37,  29,  40,  58,  51,  61, 60,  57,  51,
                                          56, 55, 64,  72,  92,  78, 64, 68,  87,  69,  55,  56,  80, 109, 81,  87,
                                          95, 98, 103, 104, 103, 62, 77, 113, 121, 112, 100, 120, 92, 101, 103, 99};
  const std::array<int, 64> found = LuminanceTable(jpeg);
  for (int quality = 1; quality <= 100; ++quality) {
    const int scale = quality < 50 ? 5000 / quality : 200 - 2 * quality;
    bool fits = true;
    for (std::size_t i = 0; i < kTable.size(); ++i) {
      fits = fits && found[i] == std::clamp((kTable[i] * scale + 50) / 100, 1, 255);
    }
    if (fits) return quality;
  }
  return 0;
}

TEST(Jpeg, TellsItsQualityByItsQuantisationTable) {
  for (const int quality : {10, 35, 50, 75, 92}) EXPECT_EQ(QualityOf(EncodeJpeg(Smooth(), quality)), quality);
}

// Returns the ratio of neighbours' differences across borders of 8 × 8 blocks to those within blocks.
double Blockiness(const ColourImage& picture) {
  double across = 0, within = 0;
  int borders = 0, others = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 1; x < picture.width; ++x) {
      const double step = std::abs(picture.At(x, y).g - picture.At(x - 1, y).g);
      (x % 8 == 0 ? across : within) += step;
      ++(x % 8 == 0 ? borders : others);
    }
  }
  return (across / borders) / (within / others);
}

TEST(Jpeg, ShowsItsBlocksTheMoreIsLost) {
  const auto blockiness = [](double loss) {
    CameraModel model = ModelOf({.noise = 0, .jpeg_loss = loss}, PlainCamera(160, 120));
    const ColourImage smooth = Smooth();
    return Blockiness(Shoot(model, [&](int x, int y, double) { return smooth.At(x, y); }));
  };
  EXPECT_NEAR(blockiness(0), 1, 0.1);
  EXPECT_GT(blockiness(90), 1.5);
  EXPECT_GT(blockiness(97), 2 * blockiness(60));
}

TEST(Jpeg, OfTheBestQualityIsNearThePicture) {
  const ColourImage picture = Smooth();
  ColourImage back;
  DecodeJpeg(EncodeJpeg(picture, 100), back);
  ASSERT_EQ(back.width, picture.width);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i].g, picture.pixels[i].g, 4);
}

std::string DigestOfJpegs() {
  Digest digest;
  for (const int quality : {5, 40, 80, 99}) {
    ColourImage back;
    const std::string jpeg = EncodeJpeg(Smooth(157, 83), quality);
    DecodeJpeg(jpeg, back);
    digest.Add(std::span(reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size()));
    digest.Add(std::span(reinterpret_cast<const std::uint8_t*>(back.pixels.data()), 3 * back.pixels.size()));
  }
  return digest.Hex();
}

TEST(Jpeg, ReadsAnybodysFileLikeOurOwn) {
  const std::string jpeg = EncodeJpeg(Smooth(), 90);
  ColourImage own;
  DecodeJpeg(jpeg, own);
  ASSERT_OK(read, ReadJpeg(jpeg, 160 * 120));
  EXPECT_EQ(read->pixels, own.pixels);
}

TEST(Jpeg, RefusesWhatIsDamagedOrTooLarge) {
  const std::string jpeg = EncodeJpeg(Smooth(), 90);
  EXPECT_NE(ToString(ReadJpeg(jpeg, 160 * 120 - 1).error()).find("160 x 120 pixels; allowed: at most 19199"),
            std::string::npos);
  // The file is cut off at many places.
  for (std::size_t size = 0; size < jpeg.size(); size += 1 + size / 40) {
    const auto read = ReadJpeg(std::string_view(jpeg).substr(0, size), 160 * 120);
    ASSERT_FALSE(read) << size;
    EXPECT_NE(ToString(read.error()).find("a damaged JPEG picture: "), std::string::npos);
  }
  // Every byte of the head, and many others, are changed: the result is a picture or an error message, never a crash.
  for (std::size_t at = 0; at < jpeg.size(); at += at < 700 ? 1 : 7) {
    for (const char other : {'\0', '\x7f', '\xff'}) {
      std::string changed = jpeg;
      changed[at] = other;
      const auto read = ReadJpeg(changed, 1'000'000);
      if (read) {
        EXPECT_LE(read->pixels.size(), 1'000'000u);
      }
    }
  }
}

// libjpeg-turbo detects vector instructions once per process, so another process disables them.
TEST(Jpeg, GivesTheSameBytesWithoutVectorInstructions) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("JSIMD_FORCENONE", "1", 1);
    const std::string digest = DigestOfJpegs();
    const bool told = ::write(ends[1], digest.data(), digest.size()) == static_cast<ssize_t>(digest.size());
    ::_exit(told ? 0 : 1);
  }
  ::close(ends[1]);
  char text[256];
  const ssize_t size = ::read(ends[0], text, sizeof text);
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_GT(size, 0);
  EXPECT_EQ(std::string(text, static_cast<std::size_t>(size)), DigestOfJpegs());
}

}  // namespace
}  // namespace etude
