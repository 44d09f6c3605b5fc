#include "engine/capture/synchronise.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/cameras/epipolar.h"

namespace etude {
namespace {

using Pixel = SomePixel;

Pixel BeginOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->a) : std::nullopt; }
Pixel EndOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->b) : std::nullopt; }

/// The mean of the squared distances between what two cameras have marked when the second one is so late; nothing where
/// they have too little in common.
std::optional<double> Misfit(const EpipolarGeometry& geometry, std::span<const Marks> first,
                             std::span<const Marks> second, double most_px, double offset) {
  double sum = 0;
  int count = 0;
  const auto add = [&](const Pixel& a, const Pixel& b) {
    if (!a || !b) return;
    const double px = std::min(std::abs(geometry.DistancePx(*a, *b)), most_px);
    sum += px * px;
    ++count;
  };
  for (std::size_t k = 0; k < first.size(); ++k) {
    const Marks there = MarksAt(second, static_cast<double>(k) - offset);
    const Marks& here = first[k];
    for (std::size_t i = 0; i < kEffectorCount; ++i) add(here.effectors[i], there.effectors[i]);
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      add(BeginOf(here.strokes[i]), BeginOf(there.strokes[i]));
      add(EndOf(here.strokes[i]), EndOf(there.strokes[i]));
    }
  }
  constexpr int kFewest = 30;
  if (count < kFewest) return std::nullopt;
  return sum / count;
}

}  // namespace

Marks MarksAt(std::span<const Marks> track, double frame) {
  const double last = static_cast<double>(track.size()) - 1;
  if (frame < 0 || frame > last) return {};
  const auto at = static_cast<std::size_t>(frame);
  const double share = frame - static_cast<double>(at);
  const Marks nothing;
  const Marks& a = at > 0 ? track[at - 1] : nothing;
  const Marks& b = track[at];
  const Marks& c = at + 1 < track.size() ? track[at + 1] : nothing;
  const Marks& d = at + 2 < track.size() ? track[at + 2] : nothing;
  Marks between;
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    between.effectors[i] = PixelBetween(a.effectors[i], b.effectors[i], c.effectors[i], d.effectors[i], share);
  }
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto along = [&](auto end) {
      return PixelBetween(end(a.strokes[i]), end(b.strokes[i]), end(c.strokes[i]), end(d.strokes[i]), share);
    };
    const Pixel begin = along(BeginOf), end = along(EndOf);
    if (begin && end) between.strokes[i] = PixelSegment{*begin, *end};
  }
  return between;
}

std::vector<double> EstimateOffsets(std::span<const ProjectionMatrix> cameras,
                                    std::span<const std::vector<Marks>> marks, const SyncOptions& options) {
  std::vector<double> offsets(cameras.size(), 0.0);
  for (std::size_t i = 1; i < cameras.size(); ++i) {
    const auto geometry = EpipolarGeometry::Of(cameras[0], cameras[i]);
    if (!geometry) continue;
    const auto misfit = [&](int offset) { return Misfit(*geometry, marks[0], marks[i], options.most_px, offset); };
    offsets[i] = FindOffset(misfit, options.most_frames).frames;
  }
  return offsets;
}

std::vector<std::vector<Marks>> Synchronised(std::span<const std::vector<Marks>> marks,
                                             std::span<const double> offsets) {
  std::vector<std::vector<Marks>> shifted;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    std::vector<Marks>& of_camera = shifted.emplace_back();
    for (std::size_t k = 0; k < marks[i].size(); ++k) {
      of_camera.push_back(MarksAt(marks[i], static_cast<double>(k) - offsets[i]));
    }
  }
  return shifted;
}

}  // namespace etude
