#include "tools/capture/mask_films.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/images/image_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 96, kHeight = 64;

/// Returns a PNG with three equal channels, which the reader takes as grey.
std::string GreyPng(const Image<std::uint8_t>& values) {
  ColourImage picture(values.width, values.height);
  for (std::size_t i = 0; i < values.pixels.size(); ++i) {
    const std::uint8_t grey = values.pixels[i];
    picture.pixels[i] = {grey, grey, grey};
  }
  return EncodePng(picture);
}

Image<std::uint8_t> Rectangle(int left, int right, std::uint8_t value, int width = kWidth) {
  Image<std::uint8_t> values(width, kHeight);
  for (int y = 10; y < 50; ++y) {
    for (int x = left; x < right; ++x) values.At(x, y) = value;
  }
  return values;
}

std::string BytesOf(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

/// Returns a palette PNG of 4 x 1 pixels with the indices 0 to 3; index 1 is dark red.
std::string PalettePng() {
  constexpr std::string_view kHex =
      "89504e470d0a1a0a0000000d4948445200000004000000010803000000cee2ffff0000000c504c5445000000800000008000"
      "80800038ec04800000000d49444154789c63606064620600000f0007848e996d0000000049454e44ae426082";
  return BytesOf(kHex);
}

/// Returns a grey PNG of 16 bits whose pixels are `value` in the rectangle of Rectangle(20, 40), and 0 elsewhere.
/// `value` is 1, 255 or 40000.
std::string Grey16Png(int value) {
  constexpr std::string_view k1 =
      "89504e470d0a1a0a0000000d494844520000006000000040100000000090cff191000000444944415478daedcf3111000008"
      "c4b0c7bf692c30b0c0a555904492245da8860300000000000000000000000000000000000000000000000000000000fc0048"
      "922449db35be20032165e48d0e0000000049454e44ae426082";
  constexpr std::string_view k255 =
      "89504e470d0a1a0a0000000d494844520000006000000040100000000090cff191000000444944415478daedcf3111000008"
      "c4b0f76f1a2c30b0c0a555904492245da8860300000000000000000000000000000000000000000000000000000000fc0048"
      "922449db358aa31d0e32a65be10000000049454e44ae426082";
  constexpr std::string_view k40000 =
      "89504e470d0a1a0a0000000d494844520000006000000040100000000090cff191000000464944415478daedcf4111000004"
      "0041d1041556050f1f66ef126c8424493a50e56c00000000000000000000000000000000000000000000000000000000801f"
      "0049922469bd060b84af9fbffa18bf0000000049454e44ae426082";
  return BytesOf(value == 1 ? k1 : value == 255 ? k255 : k40000);
}

/// Returns an RGBA PNG: opaque dark brown in the rectangle of Rectangle(20, 40), and transparent light grey elsewhere.
std::string CutOutPng() {
  constexpr std::string_view kHex =
      "89504e470d0a1a0a0000000d4948445200000060000000400806000000e534720e0000008f4944415478daeddb310d002010"
      "04c117414d8d7f15e70a4c7c420853ac819bfa2a49e95e4600004000000800000100a0d701d61cbb33000000000000000000"
      "0000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000"
      "00000000000000386a0310000002004000000800000046000040003eed00a899263c4829c35e0000000049454e44ae426082";
  return BytesOf(kHex);
}

TEST(LoadMaskPng, KeepsTheIndicesOfAPalette) {
  const TemporaryFolder folder = TemporaryFolder::Make("palette").value();
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "a.png", PalettePng()));
  ASSERT_OK(mask, LoadMaskPng((folder.path() / "a.png").string()));
  EXPECT_TRUE(mask->is_indexed);
  EXPECT_EQ(mask->values.pixels, (std::vector<std::uint16_t>{0, 1, 2, 3}));
  ASSERT_TRUE(WriteFileAtomically(folder.path() / "b.png", PalettePng().substr(0, 60)));
  EXPECT_FALSE(LoadMaskPng((folder.path() / "b.png").string()));
}

TEST(LoadMaskPng, KeepsEqualChannelsOf16Bits) {
  const TemporaryFolder folder = TemporaryFolder::Make("colour").value();
  ASSERT_TRUE(WriteFileAtomically(
      folder.path() / "a.png",
      BytesOf("89504e470d0a1a0a0000000d49484452000000020000000110020000002bd0349e0000000e4944415478da6360"
              "8000661004000028000a10fc72910000000049454e44ae426082")));
  ASSERT_OK(mask, LoadMaskPng((folder.path() / "a.png").string()));
  EXPECT_EQ(mask->values.pixels, (std::vector<std::uint16_t>{0, 3}));
}

class ReadMasksTest : public ::testing::Test {
 protected:
  void Add(const std::string& name, const Image<std::uint8_t>& values) { AddBytes(name, GreyPng(values)); }
  void AddBytes(const std::string& name, const std::string& png) {
    ASSERT_TRUE(WriteFileAtomically(folder_.path() / "cam1_masks" / name, png));
  }
  Result<std::vector<Mask>> Read(std::optional<int> id = {}, int frames = 2) {
    FilmedView view{.path = "films/cam1.mp4", .facts = {kWidth, kHeight, 30, frames}, .camera = {}, .fit = {}};
    view.camera = {"cam1", {.intrinsics = {kWidth, kHeight, 90, 90, kWidth / 2.0, kHeight / 2.0}}};
    told_.lines.clear();
    return ReadMasks(folder_.path().string(), id, view, told_);
  }
  std::string Reason(std::optional<int> id = {}, int frames = 2) { return testing::Refusal(Read(id, frames)); }
  TemporaryFolder folder_ = TemporaryFolder::Make("masks").value();
  MessageLog told_{[](const std::string&) {}};
};

TEST_F(ReadMasksTest, TakesBlackAndWhiteSoftOnesAndNumbers) {
  for (const int value : {255, 128, 1, 7}) {
    Add("9.png", Rectangle(20, 40, static_cast<std::uint8_t>(value)));
    Add("10.png", Rectangle(30, 50, static_cast<std::uint8_t>(value)));
    const auto masks = Read();
    ASSERT_TRUE(masks) << value << ": " << ToString(masks.error());
    ASSERT_EQ(masks->size(), 2u);
    EXPECT_EQ((*masks)[0].At(25, 30), 1) << "9.png is before 10.png";
    EXPECT_EQ((*masks)[0].At(45, 30), 0);
    EXPECT_EQ((*masks)[1].At(45, 30), 1);
    EXPECT_EQ(std::ranges::count((*masks)[0].pixels, 1), 20 * 40);
    EXPECT_TRUE(told_.lines.empty());
  }
}

TEST_F(ReadMasksTest, TakesGreyPicturesOf16Bits) {
  for (const int value : {1, 255, 40000}) {
    AddBytes("1.png", Grey16Png(value));
    AddBytes("2.png", Grey16Png(value));
    ASSERT_OK(masks, Read());
    EXPECT_EQ(std::ranges::count((*masks)[0].pixels, 1), 20 * 40) << value;
    EXPECT_EQ((*masks)[0].At(25, 30), 1) << value;
    EXPECT_TRUE(told_.lines.empty());
  }
  ASSERT_OK(mask, LoadMaskPng((folder_.path() / "cam1_masks" / "1.png").string()));
  EXPECT_TRUE(mask->has_16_bits);
  EXPECT_EQ(mask->values.At(25, 30), 40000);
  AddBytes("1.png", Grey16Png(1).substr(0, 90));
  EXPECT_THAT(Reason(), HasSubstr("1.png: a damaged PNG picture"));
}

TEST_F(ReadMasksTest, OfCutOutsTakesTheOpacityAndSaysSo) {
  AddBytes("1.png", CutOutPng());
  AddBytes("2.png", CutOutPng());
  ASSERT_OK(masks, Read());
  EXPECT_EQ(std::ranges::count((*masks)[0].pixels, 1), 20 * 40);
  EXPECT_EQ((*masks)[0].At(25, 30), 1);
  ASSERT_EQ(told_.lines.size(), 1u);
  EXPECT_EQ(told_.lines[0],
            "masks of cam1: the pictures have transparent pixels; Etude takes all opaque pixels as the person, "
            "whatever their "
            "colour");
}

TEST_F(ReadMasksTest, OfSeveralPeopleNeedTheNumberOfOne) {
  Image<std::uint8_t> both = Rectangle(10, 30, 1);
  for (int y = 10; y < 50; ++y) both.At(60, y) = both.At(61, y) = 2;
  Add("1.png", both);
  Add("2.png", both);
  EXPECT_THAT(Reason(),
              HasSubstr("the masks have several values: 1, 2; use --mask-id to select the value of the person"));
  ASSERT_OK(second, Read(2));
  EXPECT_EQ(std::ranges::count((*second)[0].pixels, 1), 2 * 40);
  EXPECT_THAT(Reason(3), HasSubstr("no pixel has the value 3 of --mask-id; found: 1, 2"));
}

TEST_F(ReadMasksTest, SayWhatLooksWrong) {
  Add("1.png", Rectangle(0, 0, 0));
  EXPECT_THAT(Reason(), HasSubstr("cam1_masks: the film films/cam1.mp4 has 2 frames, but the number of masks is 1"));
  Add("2.png", Rectangle(0, 0, 0));
  EXPECT_THAT(Reason(), HasSubstr("no mask shows a person: all pixels are 0"));
  Add("2.png", Rectangle(20, 40, 100));
  EXPECT_THAT(Reason(), HasSubstr("the largest value is 100; allowed: 1, 255, shades from 128 on"));
  Image<std::uint8_t> two = Rectangle(10, 30, 255);
  for (int y = 10; y < 50; ++y) {
    for (int x = 60; x < 75; ++x) two.At(x, y) = 255;
  }
  Add("2.png", two);
  ASSERT_EQ(Reason(), "accepted");
  ASSERT_EQ(told_.lines.size(), 2u);
  EXPECT_EQ(told_.lines[0], "masks of cam1: 1 of 2 masks are empty");
  EXPECT_THAT(told_.lines[1], HasSubstr("doubtful: masks of cam1: 1 of 2 masks have several large regions"));
  for (const char* name : {"1.png", "2.png"}) {
    Image<std::uint8_t> inverted = Rectangle(20, 40, 255);
    for (std::uint8_t& value : inverted.pixels) value = static_cast<std::uint8_t>(255 - value);
    Add(name, inverted);
  }
  ASSERT_EQ(Reason(), "accepted");
  EXPECT_EQ(
      told_.lines.front(),
      "doubtful: masks of cam1: 2 of 2 masks cover most of the picture; the person may be black instead of white");
  EXPECT_THAT(Reason({}, 1), HasSubstr("found more masks than the film films/cam1.mp4 has frames (1)"));
  Add("2.png", Rectangle(20, 40, 255, 2 * kWidth));
  EXPECT_THAT(Reason(), HasSubstr("2.png: the mask has 192 x 64 pixels, but the film films/cam1.mp4 has 96 x 64"));
  std::filesystem::rename(folder_.path() / "cam1_masks", folder_.path() / "cam2_masks");
  EXPECT_THAT(Reason(), HasSubstr("the folder contains no file for the film cam1"));
}

TEST_F(ReadMasksTest, AsksForOneOfSeveralGreysOrColours) {
  Image<std::uint8_t> two = Rectangle(20, 40, 100);
  for (int y = 10; y < 50; ++y) {
    for (int x = 60; x < 75; ++x) two.At(x, y) = 200;
  }
  Add("1.png", two);
  Add("2.png", two);
  EXPECT_THAT(Reason(),
              HasSubstr("the masks have several values: 100, 200; use --mask-id to select the value of the person"));
  // A soft rim is no second person.
  Image<std::uint8_t> soft = Rectangle(20, 40, 255);
  for (int y = 10; y < 50; ++y) soft.At(40, y) = 150;
  Add("1.png", soft);
  Add("2.png", soft);
  EXPECT_TRUE(Read());
}

}  // namespace
}  // namespace etude
