#include "io/images/image_files.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "sim/random/stream.h"
#include "tests/io/images/exr_files.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class ImageFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("etude-image-files-") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string At(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

// Returns a view with every 8-bit value, every label bit, and unusual depths.
View SomeView() {
  RandomStream random({3, "image-files", 0}, "pixels");
  View view{ColourImage(61, 37), LabelImage(61, 37), DepthImage(61, 37)};
  for (std::size_t i = 0; i < view.colour.pixels.size(); ++i) {
    const std::uint64_t bits = random.Bits();
    view.colour.pixels[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(bits),
                             static_cast<std::uint8_t>(bits >> 8)};
    view.labels.pixels[i] = static_cast<std::uint32_t>(bits >> 40);  // below 2²⁴
    view.depth.pixels[i] = static_cast<float>(random.Uniform(0.1, 20));
  }
  view.depth.pixels[5] = std::numeric_limits<float>::infinity();
  return view;
}

void Write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

TEST_F(ImageFiles, ColourComesBackFromPngBitForBit) {
  const ColourImage image = SomeView().colour;
  Write(At("a.png"), EncodePng(image));
  ASSERT_OK(back, LoadColourPng(At("a.png")));
  EXPECT_EQ(back->width, image.width);
  EXPECT_EQ(back->pixels, image.pixels);
}

TEST_F(ImageFiles, MasksAreWhiteOnBlack) {
  Mask mask(19, 7);
  for (std::size_t i = 0; i < mask.pixels.size(); i += 3) mask.pixels[i] = 1;
  Write(At("m.png"), EncodePng(mask));
  ASSERT_OK(seen, LoadColourPng(At("m.png")));
  for (std::size_t i = 0; i < mask.pixels.size(); ++i) {
    const std::uint8_t grey = mask.pixels[i] ? 255 : 0;
    ASSERT_EQ(seen->pixels[i], (Rgb8{grey, grey, grey})) << "people see white on black";
  }
}

TEST_F(ImageFiles, AnExrHoldsAWholeViewBitForBit) {
  const View view = SomeView();
  ASSERT_OK(bytes, EncodeExr(view));
  Write(At("v.exr"), *bytes);
  ExrFile file(At("v.exr"));
  EXPECT_EQ(file.Colour().pixels, view.colour.pixels);
  EXPECT_EQ(file.Labels().pixels, view.labels.pixels);
  EXPECT_EQ(file.Depth().pixels, view.depth.pixels);
  EXPECT_EQ(file.Depth().width, 61);
  EXPECT_TRUE(file.Normals().pixels.empty());
  EXPECT_EQ(*EncodeExr(view), *bytes);
}

// three.js and parse-exr misread files with whole-number channels, because they assign them no bytes.
TEST_F(ImageFiles, AnExrHasNoChannelOfWholeNumbers) {
  Write(At("v.exr"), *EncodeExr(SomeView()));
  const Imf::InputFile file(At("v.exr").c_str(), 0);
  int channels = 0;
  for (auto channel = file.header().channels().begin(); channel != file.header().channels().end(); ++channel) {
    EXPECT_NE(channel.channel().type, Imf::UINT) << channel.name();
    ++channels;
  }
  EXPECT_EQ(channels, 5);
}

TEST_F(ImageFiles, AnExrHoldsOnlyThePicturesThatThereAre) {
  View view = SomeView();
  view.colour = {};
  view.labels = {};
  Write(At("z.exr"), *EncodeExr(view));
  ExrFile file(At("z.exr"));
  EXPECT_EQ(file.Depth().pixels, view.depth.pixels);
  EXPECT_TRUE(file.Colour().pixels.empty());
  EXPECT_TRUE(file.Labels().pixels.empty());
}

// Read by OpenEXR's interface for pictures.
TEST_F(ImageFiles, AnExrHoldsLinearLight) {
  View view;
  view.colour = ColourImage(256, 1);
  for (int code = 0; code < 256; ++code) view.colour.At(code, 0) = {static_cast<std::uint8_t>(code), 0, 255};
  Write(At("light.exr"), *EncodeExr(view));
  Imf::RgbaInputFile file(At("light.exr").c_str());
  Imf::Array2D<Imf::Rgba> pixels(1, 256);
  file.setFrameBuffer(&pixels[0][0], 1, 256);
  file.readPixels(0, 0);
  EXPECT_NEAR(pixels[0][188].r, 0.5029, 3e-4) << "IEC 61966-2-1";
  EXPECT_NEAR(pixels[0][10].r, 10 / 255.0 / 12.92, 2e-6);
  EXPECT_EQ(static_cast<float>(pixels[0][10].g), 0);
  EXPECT_EQ(static_cast<float>(pixels[0][10].b), 1);
}

TEST_F(ImageFiles, AnExrKeepsNormals) {
  NormalImage normals(61, 37, glm::vec3(0));
  RandomStream random({3, "image-files", 0}, "normals");
  for (glm::vec3& n : normals.pixels) n = glm::vec3(glm::normalize(random.Normal3()));
  ASSERT_OK(bytes, EncodeExr(SomeView(), normals));
  Write(At("n.exr"), *bytes);
  ExrFile file(At("n.exr"));
  EXPECT_EQ(file.Normals().pixels, normals.pixels);
  EXPECT_EQ(file.Labels().pixels, SomeView().labels.pixels);
}

TEST_F(ImageFiles, AnExrKeepsFurtherDepthsBesideTheTrueOnes) {
  const View view = SomeView();
  DepthImage first(61, 37, 1.25f), second(61, 37, 2.5f);
  first.At(7, 3) = std::numeric_limits<float>::infinity();
  const std::vector<DepthChannel> measured{{"Z_measured.v1", first}, {"Z_measured.v2", second}};
  ASSERT_OK(bytes, EncodeExr(view, {}, measured));
  Write(At("d.exr"), *bytes);
  ExrFile file(At("d.exr"));
  EXPECT_EQ(file.Depth("Z_measured.v1").pixels, first.pixels);
  EXPECT_EQ(file.Depth("Z_measured.v2").pixels, second.pixels);
  EXPECT_EQ(file.Depth().pixels, view.depth.pixels);
  EXPECT_TRUE(file.Depth("Z_measured").pixels.empty()) << "none of that very name";
}

TEST_F(ImageFiles, EveryComplaintNamesTheFile) {
  const std::string missing = At("missing/picture");
  EXPECT_THAT(ToString(LoadColourPng(missing).error()), HasSubstr(missing));
  const std::string folder = folder_.string();
  EXPECT_FALSE(LoadColourPng(folder));
}

TEST_F(ImageFiles, DamagedFilesAreRefused) {
  const std::string png = EncodePng(SomeView().colour);
  for (const std::string& bytes : {std::string(), std::string("hello"), png.substr(0, 20), png.substr(0, 300)}) {
    Write(At("b.png"), bytes);
    EXPECT_FALSE(LoadColourPng(At("b.png"))) << bytes.size() << " bytes";
  }
}

TEST_F(ImageFiles, DamageAnywhereNeverCrashes) {
  const std::string png = EncodePng(SomeView().colour);
  RandomStream random({4, "image-files", 0}, "damage");
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string bad = png;
    bad[random.IndexBelow(bad.size())] = static_cast<char>(random.Bits());
    Write(At("b.png"), bad);
    refused += !LoadColourPng(At("b.png"));
  }
  EXPECT_GT(refused, 30);
}

TEST_F(ImageFiles, HugePicturesAreRefusedBeforeMemoryIsTaken) {
  std::string png = EncodePng(ColourImage(4097, 1));
  Write(At("wide.png"), png);
  EXPECT_THAT(ToString(LoadColourPng(At("wide.png")).error()), HasSubstr("4097"));
}

TEST_F(ImageFiles, PngsOfTexturesAreReadFromMemoryWithinTheirBounds) {
  const ColourImage picture = SomeView().colour;
  const std::string png = EncodePng(picture);
  ASSERT_OK(read, DecodeColourPng(png, picture.pixels.size()));
  EXPECT_EQ(read->pixels, picture.pixels);
  EXPECT_THAT(ToString(DecodeColourPng(png, picture.pixels.size() - 1).error()), HasSubstr("61 x 37 pixels; allowed"));
  for (std::size_t size = 0; size + 12 < png.size(); size += 97) {  // the last chunk, IEND, is empty
    ASSERT_FALSE(DecodeColourPng(std::string_view(png).substr(0, size), picture.pixels.size())) << size;
  }
}

}  // namespace
}  // namespace etude
