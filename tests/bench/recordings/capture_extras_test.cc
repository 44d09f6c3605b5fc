#include "bench/recordings/capture_extras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

Mask Pattern(int width, int height, std::uint32_t state) {
  Mask mask(width, height);
  for (auto& pixel : mask.pixels) {
    state = state * 1664525u + 1013904223u;
    pixel = (state >> 20) % 3 == 0;
  }
  return mask;
}

CaptureExtras Sample() {
  CaptureExtras extras{.texture_seed = 77, .casts_shadows = false};
  extras.colours[3] = {1, 2, 255};
  extras.brightness = {1.0, 0.93};
  for (double x : {-2.0, 2.5}) {
    extras.views.push_back({LookAt({.fy = 601.5}, {x, 1.4, 3}, {0, 1, 0}), {Pattern(32, 24, 1), Pattern(32, 24, 2)}});
  }
  extras.views[1].truth.distortion = {.k1 = -0.2, .k2 = 0.03, .p1 = 0.001, .p2 = -0.002, .k3 = 0.01};
  extras.views[0].still_jpeg_base64 = "/9j/4A+b";
  extras.moments = {{.frame = 1, .fixed = {}, .marks = {{{{1.5, 2}, {30, 40.25}, {9, 8, 255}}}, {}}}};
  extras.moments[0].fixed.joints[7] = {0.1, -2, 3};
  extras.bvh = "HIERARCHY\n";
  return extras;
}

TEST(CaptureExtras, SurviveWritingAndReading) {
  const CaptureExtras written = Sample();
  ASSERT_OK(read, ReadCaptureExtras(WriteCaptureExtras(written)));
  EXPECT_EQ(read->texture_seed, 77u);
  EXPECT_FALSE(read->casts_shadows);
  EXPECT_EQ(read->colours, written.colours);
  EXPECT_EQ(read->brightness, written.brightness);
  EXPECT_EQ(read->bvh, written.bvh);
  ASSERT_EQ(read->views.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read->views[i].truth.R_CW, written.views[i].truth.R_CW);
    EXPECT_EQ(read->views[i].truth.p_WC, written.views[i].truth.p_WC);
    EXPECT_EQ(read->views[i].truth.intrinsics.fy, 601.5);
    EXPECT_EQ(read->views[i].truth.distortion, written.views[i].truth.distortion);
    EXPECT_EQ(read->views[i].still_jpeg_base64, written.views[i].still_jpeg_base64);
    ASSERT_EQ(read->views[i].masks.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(read->views[i].masks[k].pixels, written.views[i].masks[k].pixels);
  }
}

TEST(CaptureExtras, KeepMoments) {
  ASSERT_OK(read, ReadCaptureExtras(WriteCaptureExtras(Sample())));
  ASSERT_EQ(read->moments.size(), 1u);
  const CaptureExtras::Moment &moment = read->moments[0], expected = Sample().moments[0];
  EXPECT_EQ(moment.frame, 1u);
  EXPECT_EQ(moment.fixed.joints, expected.fixed.joints);
  ASSERT_EQ(moment.marks.size(), 2u);
  ASSERT_EQ(moment.marks[0].size(), 1u);
  EXPECT_EQ(moment.marks[0][0].a, expected.marks[0][0].a);
  EXPECT_EQ(moment.marks[0][0].b, expected.marks[0][0].b);
  EXPECT_EQ(moment.marks[0][0].colour, expected.marks[0][0].colour);
  EXPECT_TRUE(moment.marks[1].empty());
}

TEST(CaptureExtras, RefuseMomentsOfAnotherTake) {
  CaptureExtras late = Sample(), lopsided = Sample();
  late.moments[0].frame = 2;
  lopsided.moments[0].marks.pop_back();
  for (const CaptureExtras& extras : {late, lopsided}) {
    EXPECT_THAT(testing::Message(ReadCaptureExtras(WriteCaptureExtras(extras))), HasSubstr("moment"));
  }
}

TEST(CaptureExtras, RefuseWhatIsNotOne) {
  for (const char* text : {"", "{", "[]", "{}", R"({"format": "etude-capture", "version": 1})"}) {
    EXPECT_FALSE(ReadCaptureExtras(text)) << text;
  }
  EXPECT_THAT(testing::Message(ReadCaptureExtras(R"({"format": "etude-capture", "version": 2})")),
              HasSubstr("version 2"));
  CaptureExtras hostile = Sample();
  hostile.views[0].still_jpeg_base64 = "x\"><script>";  // this text goes into an HTML page
  EXPECT_FALSE(ReadCaptureExtras(WriteCaptureExtras(hostile)));
  CaptureExtras torn = Sample();
  torn.views[1].masks.pop_back();
  EXPECT_FALSE(ReadCaptureExtras(WriteCaptureExtras(torn)));
}

TEST(CaptureExtras, KnowACodedSuitInTheStudioToo) {
  CaptureExtras extras = Sample();
  extras.wears_coded = true;
  ASSERT_OK(read, ReadCaptureExtras(WriteCaptureExtras(extras)));
  EXPECT_TRUE(read->wears_coded);
  EXPECT_EQ(read->scene, 0);
  EXPECT_FALSE(ReadCaptureExtras(WriteCaptureExtras(Sample()))->wears_coded);
}

TEST(EncodeMask, IsUndoneByDecodeMask) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const Mask mask = Pattern(7 + static_cast<int>(seed % 5), 6, seed);
    ASSERT_OK(decoded, DecodeMask(EncodeMask(mask), mask.width, mask.height));
    ASSERT_EQ(decoded->pixels, mask.pixels) << seed;
  }
}

TEST(EncodeMask, CountsZerosFirstAndLeavesOutTheLastOnes) {
  Mask mask(4, 2);
  EXPECT_EQ(EncodeMask(mask), "");
  mask.At(3, 0) = mask.At(0, 1) = 1;
  EXPECT_EQ(EncodeMask(mask), "3 2");
  EXPECT_EQ(EncodeMask(Mask(4, 2, 1)), "0 8");
}

TEST(DecodeMask, RefusesBrokenText) {
  for (const char* text : {"3 x", "3 6", "-1 2", "1,2", "99999999999999999999"}) {
    EXPECT_FALSE(DecodeMask(text, 4, 2)) << text;
  }
  EXPECT_FALSE(DecodeMask("", 1 << 30, 1 << 30));
}

TEST(HalveMask, KeepsAPixelWithTwoOfItsFour) {
  Mask mask(4, 2);
  mask.At(0, 0) = 1;                  // one pixel of four
  mask.At(2, 0) = mask.At(3, 1) = 1;  // two pixels of four
  EXPECT_EQ(HalveMask(mask).pixels, (std::vector<std::uint8_t>{0, 1}));
}

}  // namespace
}  // namespace etude
