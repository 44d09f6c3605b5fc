#include "io/drawing/marks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace etude {
namespace {

using Rgb = std::array<double, 3>;
using Matrix = std::array<Rgb, 3>;

// Machado, Oliveira & Fernandes 2009, severity 1, in linear RGB: normal, protanopia, deuteranopia, tritanopia.
constexpr std::array<Matrix, 4> kVisions = {
    {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
     {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
     {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
     {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}}};

Rgb Linear(std::string_view hex) {
  Rgb rgb;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = std::stoi(std::string(hex.substr(1 + 2 * i, 2)), nullptr, 16) / 255.0;
    rgb[i] = part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
  }
  return rgb;
}

Rgb Times(const Matrix& matrix, const Rgb& colour) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i] += matrix[i][j] * colour[j];
    out[i] = std::clamp(out[i], 0.0, 1.0);
  }
  return out;
}

// Converts to OkLab (Ottosson 2020).
Rgb OkLab(const Rgb& c) {
  const Rgb lms = Times({{{0.4122214708, 0.5363325363, 0.0514459929},
                          {0.2119034982, 0.6806995451, 0.1073969566},
                          {0.0883024619, 0.2817188376, 0.6299787005}}},
                        c);
  const double l = std::cbrt(lms[0]), m = std::cbrt(lms[1]), s = std::cbrt(lms[2]);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

/// Returns the smallest distance between two of the colours, over all kinds of colour vision.
double SmallestDistance(const std::vector<std::string_view>& colours) {
  double smallest = 1;
  for (const Matrix& vision : kVisions) {
    for (std::size_t i = 0; i < colours.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Rgb a = OkLab(Times(vision, Linear(colours[i]))), b = OkLab(Times(vision, Linear(colours[j])));
        smallest = std::min(smallest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
    }
  }
  return smallest;
}

// Returns the contrast ratio of WCAG 2.1.
double Contrast(std::string_view a, std::string_view b) {
  const auto luminance = [](std::string_view hex) {
    const Rgb c = Linear(hex);
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  };
  const double of_a = luminance(a) + 0.05, of_b = luminance(b) + 0.05;
  return std::max(of_a, of_b) / std::min(of_a, of_b);
}

std::vector<std::string_view> Scheme(std::string_view PlotColour::*scheme) {
  std::vector<std::string_view> colours;
  for (const PlotColour& colour : kPlotColours) colours.push_back(colour.*scheme);
  return colours;
}

TEST(Marks, AreToldApartWhateverTheReadersColourVision) {
  EXPECT_GT(SmallestDistance(Scheme(&PlotColour::light)), 0.11);
  EXPECT_GT(SmallestDistance(Scheme(&PlotColour::dark)), 0.11);
  // The control: former colours of methods 3 and 7, equal for a protanope.
  EXPECT_LT(SmallestDistance({"#7a5aa6", "#2d62a8"}), 0.02);
}

TEST(Marks, StandOutFromBothBackgrounds) {
  for (const PlotColour& colour : kPlotColours) {
    EXPECT_GE(Contrast(colour.light, "#ffffff"), 3) << colour.light;
    EXPECT_GE(Contrast(colour.dark, "#1c2024"), 3) << colour.dark;
  }
  EXPECT_LT(Contrast("#e3c662", "#ffffff"), 3) << "the control";
}

TEST(Marks, BeginAgainAfterEightAndEscapeTheirTitles) {
  EXPECT_EQ(MarkUse(1, 9, 10.04, 5, " data-t=\"3\""),
            "<use href=\"#k1\" class=\"f1\" x=\"10.0\" y=\"5.0\" data-t=\"3\"/>");
  EXPECT_THAT(MarkUse(8, 0, 0, 0, "", "<b>"), ::testing::HasSubstr("#k0\""));
  EXPECT_THAT(MarkUse(8, 0, 0, 0, "", "<b>"), ::testing::HasSubstr("<title>&lt;b&gt;</title>"));
}

}  // namespace
}  // namespace etude
