#include "engine/capture/synchronise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

using Pixel = std::optional<glm::dvec2>;

// A mark between frames b and c, whose neighbours are a and d.
Pixel Between(const Pixel& a, const Pixel& b, const Pixel& c, const Pixel& d, double share) {
  if (!b || (share > 0 && !c)) return std::nullopt;
  if (share == 0) return b;
  if (!a || !d) return (1 - share) * *b + share * *c;
  const double t = share, u = 1 - t;
  return u * u * (1 + 2 * t) * *b + t * t * (3 - 2 * t) * *c + 0.5 * t * u * u * (*c - *a) -
         0.5 * t * t * u * (*d - *b);
}

Pixel BeginOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->a) : std::nullopt; }
Pixel EndOf(const std::optional<PixelSegment>& stroke) { return stroke ? Pixel(stroke->b) : std::nullopt; }

/// Two cameras, of which the second one's clock is asked.
class ClockPair {
 public:
  ClockPair(const ProjectionMatrix& first, std::span<const Marks> first_marks, const ProjectionMatrix& second,
            std::span<const Marks> second_marks, double most_px)
      : first_(first), second_(second), first_marks_(first_marks), second_marks_(second_marks), most_px_(most_px) {}

  /// The mean of the squared distances when the second camera is so late; nothing where they have too little in common.
  std::optional<double> Misfit(double offset) const {
    double sum = 0;
    int count = 0;
    const auto add = [&](const Pixel& a, const Pixel& b) {
      if (!a || !b) return;
      const std::array<Sighting, 2> both = {{{first_, *a}, {second_, *b}}};
      const TriangulatedPoint point = Triangulate(both);
      const double px = point.status == PointStatus::kOk ? std::min(point.residual_px, most_px_) : most_px_;
      sum += px * px;
      ++count;
    };
    for (std::size_t k = 0; k < first_marks_.size(); ++k) {
      const Marks there = MarksAt(second_marks_, static_cast<double>(k) - offset);
      const Marks& here = first_marks_[k];
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

 private:
  const ProjectionMatrix& first_;
  const ProjectionMatrix& second_;
  const std::span<const Marks> first_marks_, second_marks_;
  const double most_px_;
};

// The minimiser between two offsets, to a hundredth of a frame.
double GoldenSection(const std::function<double(double)>& misfit, double low, double high) {
  const double kShare = 0.5 * (std::sqrt(5.0) - 1);
  double left = high - kShare * (high - low), right = low + kShare * (high - low);
  double at_left = misfit(left), at_right = misfit(right);
  constexpr double kExact = 0.005;
  while (high - low > kExact) {
    if (at_left <= at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kShare * (high - low);
      at_left = misfit(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kShare * (high - low);
      at_right = misfit(right);
    }
  }
  return 0.5 * (low + high);
}

double OffsetOf(const ClockPair& pair, const SyncOptions& options) {
  const std::optional<double> assumed = pair.Misfit(0);
  if (!assumed) return 0;
  int best = 0;
  double least = *assumed;
  for (int offset = -options.most_frames; offset <= options.most_frames; ++offset) {
    const std::optional<double> misfit = pair.Misfit(offset);
    if (!misfit || *misfit >= least) continue;
    least = *misfit;
    best = offset;
  }
  const auto misfit = [&](double offset) {
    return pair.Misfit(offset).value_or(std::numeric_limits<double>::infinity());
  };
  const double found = GoldenSection(misfit, best - 1, best + 1);
  // As good as none: nobody moved.
  constexpr double kNoBetter = 0.999, kNothing = 1e-4;  // a share; pixels squared
  return misfit(found) + kNothing < kNoBetter * *assumed ? found : 0;
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
    between.effectors[i] = Between(a.effectors[i], b.effectors[i], c.effectors[i], d.effectors[i], share);
  }
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto along = [&](auto end) {
      return Between(end(a.strokes[i]), end(b.strokes[i]), end(c.strokes[i]), end(d.strokes[i]), share);
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
    offsets[i] = OffsetOf(ClockPair(cameras[0], marks[0], cameras[i], marks[i], options.most_px), options);
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
