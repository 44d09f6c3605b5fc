#include "engine/vision/strokes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "engine/base/angles.h"
#include "engine/vision/scatter.h"

namespace etude {
namespace {

using enum Role;

constexpr std::array<StrokeMark, kStrokeCount> kStrokes = {{
    {kLeftHip, kLeftKnee, {255, 0, 0}, {140, 0, 0}},
    {kLeftKnee, kLeftAnkle, {255, 110, 0}, {140, 60, 0}},
    {kLeftAnkle, kLeftFoot, {255, 190, 0}, {140, 105, 0}},
    {kRightHip, kRightKnee, {0, 0, 255}, {0, 0, 140}},
    {kRightKnee, kRightAnkle, {0, 110, 255}, {0, 60, 140}},
    {kRightAnkle, kRightFoot, {0, 190, 255}, {0, 105, 140}},
    {kLeftShoulder, kLeftElbow, {255, 0, 120}, {140, 0, 66}},
    {kLeftElbow, kLeftWrist, {255, 0, 200}, {140, 0, 110}},
    {kLeftWrist, kLeftHand, {255, 120, 220}, {140, 66, 120}},
    {kRightShoulder, kRightElbow, {0, 255, 60}, {0, 140, 33}},
    {kRightElbow, kRightWrist, {0, 255, 140}, {0, 140, 77}},
    {kRightWrist, kRightHand, {120, 255, 190}, {66, 140, 105}},
    {kShoulderCentre, kHead, {255, 255, 0}, {140, 140, 0}},
}};

constexpr std::array<EffectorMark, kEffectorCount> kEffectors = {{
    {kLeftFoot, {255, 230, 200}},
    {kRightFoot, {200, 230, 255}},
    {kLeftHand, {255, 200, 255}},
    {kRightHand, {200, 255, 220}},
    {kHead, {255, 255, 255}},
}};

using Pixels = std::vector<glm::dvec2>;

glm::dvec2 Mean(const Pixels& pixels) {
  glm::dvec2 sum(0);
  for (const glm::dvec2& p : pixels) sum += p;
  return sum / static_cast<double>(pixels.size());
}

// Returns the principal axis: the direction in which the pixels' positions vary most.
glm::dvec2 PrincipalAxis(const Pixels& pixels, const glm::dvec2& mean) {
  Scatter scatter;
  for (const glm::dvec2& p : pixels) scatter.Add(p - mean);
  return scatter.Axis();
}

std::optional<PixelSegment> ReadStroke(const Pixels& first, const Pixels& second) {
  if (first.empty() || second.empty()) return std::nullopt;
  const glm::dvec2 sense = Mean(second) - Mean(first);
  Pixels all = first;
  all.insert(all.end(), second.begin(), second.end());
  const glm::dvec2 mean = Mean(all);
  glm::dvec2 axis = PrincipalAxis(all, mean);
  if (glm::dot(axis, sense) < 0) axis = -axis;
  double low = 0, high = 0;
  for (const glm::dvec2& p : all) {
    const double along = glm::dot(p - mean, axis);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  // The round pen makes the stroke longer than its limb: the outermost pixel centres lie half the pen's width, minus
  // half a pixel, beyond the limb's ends. Shorten the stroke by this length, but by at most a quarter at each end.
  const double pen = std::min((kStrokeWidth - 1) / 2, (high - low) / 4);
  return PixelSegment{mean + (low + pen) * axis, mean + (high - pen) * axis};
}

std::optional<glm::dvec2> ReadDisc(const Pixels& pixels) {
  if (pixels.empty()) return std::nullopt;
  const glm::dvec2 mean = Mean(pixels);
  constexpr double kWhole = 0.95;
  if (static_cast<double>(pixels.size()) >= kWhole * kPi * kDiscRadius * kDiscRadius) return mean;

  // If a disc is partly covered, the mean of the visible pixels is not the centre. Search instead for all possible
  // centres.
  constexpr double kGridStep = 0.25;
  constexpr double kRasterSlack = 0.25;
  const double radius = kDiscRadius + kRasterSlack;
  Pixels centres;
  const int steps = static_cast<int>(2 * kDiscRadius / kGridStep);
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      const glm::dvec2 centre = mean + kGridStep * glm::dvec2(j, i);
      const bool covers = std::all_of(pixels.begin(), pixels.end(), [&](const glm::dvec2& p) {
        return glm::dot(p - centre, p - centre) <= radius * radius;
      });
      if (covers) centres.push_back(centre);
    }
  }
  return centres.empty() ? mean : Mean(centres);
}

constexpr std::size_t kColourCount = 2 * kStrokeCount + kEffectorCount;

// The palette contains, for each stroke, the colours of its first and second half, then the colours of the discs.
constexpr std::array<Rgb8, kColourCount> kPalette = [] {
  std::array<Rgb8, kColourCount> palette{};
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    palette[2 * i] = kStrokes[i].first_half;
    palette[2 * i + 1] = kStrokes[i].second_half;
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) palette[2 * kStrokeCount + i] = kEffectors[i].colour;
  return palette;
}();

// Test eight pixels at a time, because most of an annotation picture is black.
constexpr int kBlock = 8;

bool IsBlackBlock(const Rgb8* pixels) {
  static_assert(sizeof(Rgb8) == 3, "a picture is written as bytes of its colours");
  std::array<std::uint64_t, 3> bits;
  std::memcpy(bits.data(), pixels, sizeof(bits));
  return (bits[0] | bits[1] | bits[2]) == 0;
}

}  // namespace

std::span<const StrokeMark, kStrokeCount> StrokeMarks() { return kStrokes; }
std::span<const EffectorMark, kEffectorCount> EffectorMarks() { return kEffectors; }

Marks ReadMarks(const ColourImage& annotation) {
  std::array<Pixels, kColourCount> pixels;
  for (int y = 0; y < annotation.height; ++y) {
    for (int x = 0; x < annotation.width; ++x) {
      if (x + kBlock <= annotation.width && IsBlackBlock(&annotation.At(x, y))) {
        x += kBlock - 1;
        continue;
      }
      const Rgb8 colour = annotation.At(x, y);
      if (colour == Rgb8{}) continue;
      const auto found = std::find(kPalette.begin(), kPalette.end(), colour);
      if (found == kPalette.end()) continue;
      pixels[static_cast<std::size_t>(found - kPalette.begin())].push_back({x + 0.5, y + 0.5});
    }
  }
  Marks marks;
  for (std::size_t i = 0; i < kStrokeCount; ++i) marks.strokes[i] = ReadStroke(pixels[2 * i], pixels[2 * i + 1]);
  for (std::size_t i = 0; i < kEffectorCount; ++i) marks.effectors[i] = ReadDisc(pixels[2 * kStrokeCount + i]);
  return marks;
}

}  // namespace etude
