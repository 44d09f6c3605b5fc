#include "sim/sensors/image_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "sim/random/stream.h"
#include "tests/sim/sensors/read_image_files.h"
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
  Write(At("a.png"), EncodePng(image));
  const auto back = ReadColourPng(At("a.png"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->width, image.width);
  EXPECT_EQ(back->pixels, image.pixels);
}

TEST_F(ImageFiles, AWholeViewComesBackFromExrBitForBit) {
  const View view = SomeView();
  const auto saved = SaveExr(view, At("v.exr"));
  ASSERT_TRUE(saved) << ToString(saved.error());
  const auto back = ReadExr(At("v.exr"));
  ASSERT_TRUE(back);
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
  const auto back = ReadExr(At("z.exr"));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->depth.pixels, view.depth.pixels);
  EXPECT_TRUE(back->colour.pixels.empty());
  EXPECT_TRUE(back->labels.pixels.empty());
}

TEST_F(ImageFiles, EveryComplaintNamesTheFile) {
  const std::string missing = At("missing/picture");
  EXPECT_THAT(ToString(SaveExr(SomeView(), missing).error()), HasSubstr(missing));
  const std::string folder = folder_.string();
  EXPECT_FALSE(SaveExr(SomeView(), folder));
}

}  // namespace
}  // namespace etude
