#include "engine/capture/synchronise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

/// The minimum of the parabola that is fitted to the misfits around a whole frame.
struct ParabolaMinimum {
  double shift = 0;  ///< position of the minimum relative to the whole frame, in frames
  double gain = 0;
};

std::optional<ParabolaMinimum> FitParabola(const std::function<std::optional<double>(int offset)>& misfit, int frame) {
  // The parabola is fitted to this many frames on either side: farther away, the misfit is not a parabola; with fewer
  // frames, noise matters more.
  constexpr int kReach = 2;
  double count = 0, x2 = 0, x4 = 0, f = 0, xf = 0, x2f = 0;
  for (int x = -kReach; x <= kReach; ++x) {
    const std::optional<double> here = misfit(frame + x);
    if (!here) return std::nullopt;
    count += 1, x2 += x * x, x4 += x * x * x * x;
    f += *here, xf += x * *here, x2f += x * x * *here;
  }
  // Fit f + slope · x + bend · x² by least squares.
  const double bend = (count * x2f - x2 * f) / (count * x4 - x2 * x2), slope = xf / x2;
  if (!(bend > 0)) return std::nullopt;
  const double shift = std::clamp(-0.5 * slope / bend, -1.0, 1.0);
  return ParabolaMinimum{shift, bend * shift * shift};
}

using Pixel = OptionalPixel;

Pixel BeginOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->a) : std::nullopt; }
Pixel EndOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->b) : std::nullopt; }

/// Returns the mean squared epipolar distance between the marks of two cameras if the second is late by `offset`
/// frames; nullopt if they have too few marks in common.
std::optional<double> Misfit(const EpipolarGeometry& geometry, std::span<const Marks> first,
                             std::span<const Marks> second, double max_px, double offset) {
  double sum = 0;
  int count = 0;
  const auto add = [&](const Pixel& a, const Pixel& b) {
    if (!a || !b) return;
    const double px = std::min(std::abs(geometry.DistancePx(*a, *b)), max_px);
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
  constexpr int kMinPairs = 30;
  if (count < kMinPairs) return std::nullopt;
  return sum / count;
}

}  // namespace

ClockOffset FindOffset(const std::function<std::optional<double>(int offset)>& misfit, int max_frames) {
  const std::optional<double> assumed = misfit(0);
  if (!assumed) return {};
  // Find the best whole frame, then the minimum of the parabola around it.
  int best = 0, evaluated = 0;
  double min_misfit = *assumed, sum = 0;
  for (int offset = -max_frames; offset <= max_frames; ++offset) {
    const std::optional<double> here = misfit(offset);
    if (!here) continue;
    sum += *here;
    ++evaluated;
    if (*here >= min_misfit) continue;
    min_misfit = *here;
    best = offset;
  }
  const ParabolaMinimum minimum = FitParabola(misfit, best).value_or(ParabolaMinimum{});
  // If the minimum is below the misfit at offset 0 by at most the share kNoBetter of this misfit plus kNothing px²,
  // probably nobody moved: the offset is then 0.
  constexpr double kNoBetter = 0.001, kNothing = 1e-4;
  // With 300 distances or more, noise alone keeps the ratio of the mean misfit to the minimum below this value.
  constexpr double kTold = 1.25;
  const bool is_better = *assumed - min_misfit + minimum.gain > kNothing + kNoBetter * *assumed;
  const bool is_told = std::abs(best) < max_frames && sum / evaluated > kNothing + kTold * (min_misfit - minimum.gain);
  const double least = min_misfit - minimum.gain;
  return {is_better ? best + minimum.shift : 0, is_told, is_better ? least : *assumed,
          sum > 0 ? std::clamp(1 - least * evaluated / sum, 0.0, 1.0) : 0};
}

OptionalPixel PixelBetween(const OptionalPixel& a, const OptionalPixel& b, const OptionalPixel& c, const OptionalPixel& d, double share) {
  if (!b || (share > 0 && !c)) return std::nullopt;
  if (share == 0) return b;
  if (!a || !d) return (1 - share) * *b + share * *c;
  const double t = share, u = 1 - t;
  return u * u * (1 + 2 * t) * *b + t * t * (3 - 2 * t) * *c + 0.5 * t * u * u * (*c - *a) -
         0.5 * t * t * u * (*d - *b);
}

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
    const auto misfit = [&](int offset) { return Misfit(*geometry, marks[0], marks[i], options.max_px, offset); };
    offsets[i] = FindOffset(misfit, options.max_frames).frames;
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
