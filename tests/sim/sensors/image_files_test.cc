#include "sim/sensors/image_files.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "sim/random/stream.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

using testing::HasSubstr;

class ImageFiles : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("etude-image-files-") + info->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string At(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

// Every 8-bit value, every label bit and odd depths among them.
View SomeView() {
  RandomStream random({3, "image-files", 0}, "pixels");
  View view{ColourImage(61, 37), LabelImage(61, 37), DepthImage(61, 37)};
  for (std::size_t i = 0; i < view.colour.pixels.size(); ++i) {
    const std::uint64_t bits = random.Bits();
    view.colour.pixels[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(bits),
                             static_cast<std::uint8_t>(bits >> 8)};
    view.labels.pixels[i] = static_cast<std::uint32_t>(bits >> 32);
    view.depth.pixels[i] = static_cast<float>(random.Uniform(0.1, 20));
  }
  view.depth.pixels[5] = std::numeric_limits<float>::infinity();
  return view;
}

std::string Bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Write(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

TEST_F(ImageFiles, ColourComesBackFromPngBitForBit) {
  const ColourImage image = SomeView().colour;
  ASSERT_TRUE(SavePng(image, At("a.png")));
  const auto back = LoadColourPng(At("a.png"));
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_EQ(back->width, image.width);
  EXPECT_EQ(back->pixels, image.pixels);
  EXPECT_EQ(Bytes(At("a.png")), EncodePng(image));
}

TEST_F(ImageFiles, MasksComeBackFromPng) {
  Mask mask(19, 7);
  for (std::size_t i = 0; i < mask.pixels.size(); i += 3) mask.pixels[i] = 1;
  ASSERT_TRUE(SavePng(mask, At("m.png")));
  const auto back = LoadMaskPng(At("m.png"));
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_EQ(back->pixels, mask.pixels);
  const auto seen = LoadColourPng(At("m.png"));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->At(0, 0), (Rgb8{255, 255, 255})) << "people see white on black";
}

TEST_F(ImageFiles, AWholeViewComesBackFromExrBitForBit) {
  const View view = SomeView();
  const auto saved = SaveExr(view, At("v.exr"));
  ASSERT_TRUE(saved) << ToString(saved.error());
  const auto back = LoadExr(At("v.exr"));
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_EQ(back->colour.pixels, view.colour.pixels);
  EXPECT_EQ(back->labels.pixels, view.labels.pixels);
  EXPECT_EQ(back->depth.pixels, view.depth.pixels);
  EXPECT_EQ(back->depth.width, 61);

  ASSERT_TRUE(SaveExr(view, At("again.exr")));
  EXPECT_EQ(Bytes(At("v.exr")), Bytes(At("again.exr")));
}

TEST_F(ImageFiles, AnExrHoldsOnlyThePicturesThatThereAre) {
  View view = SomeView();
  view.colour = {};
  view.labels = {};
  ASSERT_TRUE(SaveExr(view, At("z.exr")));
  const auto back = LoadExr(At("z.exr"));
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_EQ(back->depth.pixels, view.depth.pixels);
  EXPECT_TRUE(back->colour.pixels.empty());
  EXPECT_TRUE(back->labels.pixels.empty());
}

// Read by OpenEXR's own way for pictures.
TEST_F(ImageFiles, AnExrHoldsLinearLight) {
  View view;
  view.colour = ColourImage(256, 1);
  for (int code = 0; code < 256; ++code) view.colour.At(code, 0) = {static_cast<std::uint8_t>(code), 0, 255};
  ASSERT_TRUE(SaveExr(view, At("light.exr")));
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
  const auto bytes = EncodeExr(SomeView(), normals);
  ASSERT_TRUE(bytes);
  Write(At("n.exr"), *bytes);
  const auto back = LoadExrNormals(At("n.exr"));
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_EQ(back->pixels, normals.pixels);
  EXPECT_EQ(LoadExr(At("n.exr"))->labels.pixels, SomeView().labels.pixels);
  ASSERT_TRUE(SaveExr(SomeView(), At("none.exr")));
  EXPECT_TRUE(LoadExrNormals(At("none.exr"))->pixels.empty());
  EXPECT_FALSE(LoadExrNormals(At("missing.exr")));
}

TEST_F(ImageFiles, AnExrKeepsFurtherDepthsBesideTheTrueOnes) {
  const View view = SomeView();
  DepthImage first(61, 37, 1.25f), second(61, 37, 2.5f);
  first.At(7, 3) = std::numeric_limits<float>::infinity();
  const std::vector<DepthChannel> measured{{"Z_measured.v1", first}, {"Z_measured.v2", second}};
  const auto bytes = EncodeExr(view, {}, measured);
  ASSERT_TRUE(bytes);
  Write(At("d.exr"), *bytes);
  EXPECT_EQ(LoadExrDepth(At("d.exr"), "Z_measured.v1")->pixels, first.pixels);
  EXPECT_EQ(LoadExrDepth(At("d.exr"), "Z_measured.v2")->pixels, second.pixels);
  EXPECT_EQ(LoadExrDepth(At("d.exr"), "Z")->pixels, view.depth.pixels);
  EXPECT_TRUE(LoadExrDepth(At("d.exr"), "Z_measured")->pixels.empty()) << "none of that very name";
  EXPECT_FALSE(LoadExrDepth(At("missing.exr"), "Z"));
}

TEST_F(ImageFiles, EveryComplaintNamesTheFile) {
  const std::string missing = At("missing/picture");
  EXPECT_THAT(ToString(LoadColourPng(missing).error()), HasSubstr(missing));
  EXPECT_THAT(ToString(LoadMaskPng(missing).error()), HasSubstr(missing));
  EXPECT_THAT(ToString(LoadExr(missing).error()), HasSubstr(missing));
  EXPECT_THAT(ToString(SavePng(SomeView().colour, missing).error()), HasSubstr(missing));
  EXPECT_THAT(ToString(SaveExr(SomeView(), missing).error()), HasSubstr(missing));
  const std::string folder = folder_.string();
  EXPECT_FALSE(LoadColourPng(folder));
  EXPECT_FALSE(LoadExr(folder));
  EXPECT_FALSE(SavePng(SomeView().colour, folder));
  EXPECT_FALSE(SaveExr(SomeView(), folder));
}

TEST_F(ImageFiles, DamagedFilesAreRefused) {
  ASSERT_TRUE(SavePng(SomeView().colour, At("a.png")));
  ASSERT_TRUE(SaveExr(SomeView(), At("a.exr")));
  const std::string png = Bytes(At("a.png")), exr = Bytes(At("a.exr"));
  for (const std::string& bytes : {std::string(), std::string("hello"), png.substr(0, 20), png.substr(0, 300)}) {
    Write(At("b.png"), bytes);
    EXPECT_FALSE(LoadColourPng(At("b.png"))) << bytes.size() << " bytes";
  }
  for (const std::string& bytes : {std::string(), std::string("hello"), exr.substr(0, 20), exr.substr(0, 2000)}) {
    Write(At("b.exr"), bytes);
    EXPECT_FALSE(LoadExr(At("b.exr"))) << bytes.size() << " bytes";
  }
}

TEST_F(ImageFiles, DamageAnywhereNeverCrashes) {
  ASSERT_TRUE(SaveExr(SomeView(), At("a.exr")));
  ASSERT_TRUE(SavePng(SomeView().colour, At("a.png")));
  const std::string exr = Bytes(At("a.exr")), png = Bytes(At("a.png"));
  RandomStream random({4, "image-files", 0}, "damage");
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string bad_exr = exr, bad_png = png;
    bad_exr[random.IndexBelow(400)] = static_cast<char>(random.Bits());
    bad_png[random.IndexBelow(bad_png.size())] = static_cast<char>(random.Bits());
    Write(At("b.exr"), bad_exr);
    Write(At("b.png"), bad_png);
    refused += !LoadExr(At("b.exr"));
    refused += !LoadColourPng(At("b.png"));
  }
  EXPECT_GT(refused, 30);
}

TEST_F(ImageFiles, HugePicturesAreRefusedBeforeMemoryIsTaken) {
  std::string png = EncodePng(ColourImage(4097, 1));
  Write(At("wide.png"), png);
  EXPECT_THAT(ToString(LoadColourPng(At("wide.png")).error()), HasSubstr("4097"));

  ASSERT_TRUE(SaveExr(SomeView(), At("a.exr")));
  std::string exr = Bytes(At("a.exr"));
  const std::size_t window = exr.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
  ASSERT_LT(window + 16, exr.size());
  exr.replace(window + 8, 8, "\xff\xff\xff\x3f\xff\xff\xff\x3f");  // x max, y max = 2^30 − 1
  Write(At("huge.exr"), exr);
  EXPECT_FALSE(LoadExr(At("huge.exr")));
}

TEST_F(ImageFiles, PngsOfTexturesAreReadFromMemoryWithinTheirBounds) {
  const ColourImage picture = SomeView().colour;
  const std::string png = EncodePng(picture);
  const auto read = DecodeColourPng(png, picture.pixels.size());
  ASSERT_TRUE(read) << ToString(read.error());
  EXPECT_EQ(read->pixels, picture.pixels);
  EXPECT_THAT(ToString(DecodeColourPng(png, picture.pixels.size() - 1).error()), HasSubstr("61 x 37 pixels; allowed"));
  for (std::size_t size = 0; size + 12 < png.size(); size += 97) {  // the last chunk, IEND, holds nothing
    ASSERT_FALSE(DecodeColourPng(std::string_view(png).substr(0, size), picture.pixels.size())) << size;
  }
}

}  // namespace
}  // namespace etude
