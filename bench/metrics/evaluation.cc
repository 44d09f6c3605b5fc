#include "bench/metrics/evaluation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "bench/metrics/pose_error.h"
#include "engine/base/angles.h"
#include "engine/base/directions.h"

namespace etude {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
constexpr double kToMillimetres = 1000;
constexpr std::size_t kMinFitted = 3;  // fewer points do not determine a rotation

bool BothSeen(const glm::dvec3& a, const glm::dvec3& b) { return !std::isnan(a.x) && !std::isnan(b.x); }

/// Points of the answer and their truths that a fit uses.
struct FittedPoints {
  std::vector<glm::dvec3> found, truth;

  void Add(const EvaluatedPair& pair, std::size_t frame) {
    const auto a = pair.found.Frame(frame), b = pair.truth.Frame(frame);
    for (std::size_t j = 0; j < a.size(); ++j) {
      if (!BothSeen(a[j], b[j])) continue;
      found.push_back(a[j]);
      truth.push_back(b[j]);
    }
  }
};

glm::dvec3 Middle(std::span<const glm::dvec3> points) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

/// Returns the best similarity, or the best movement; nothing if it is not determined.
std::optional<Similarity> Fit(const FittedPoints& points, bool with_scale) {
  if (points.found.size() < kMinFitted) return std::nullopt;
  Similarity fit = AlignSimilarity(points.found, points.truth);
  if (with_scale) return fit;
  fit.scale = 1;
  fit.translation = Middle(points.truth) - fit.rotation * Middle(points.found);
  return fit;
}

PointTracks Unseen(const EvaluatedPair& pair) {
  return {pair.found.points, std::vector<glm::dvec3>(pair.found.positions.size(), glm::dvec3(kUnseen))};
}

/// Applies a fit to the joints of one frame that both show.
void Apply(const Similarity& fit, const EvaluatedPair& pair, std::size_t frame, PointTracks& out) {
  for (std::size_t j = 0; j < pair.found.points; ++j) {
    const std::size_t at = frame * pair.found.points + j;
    if (BothSeen(pair.found.positions[at], pair.truth.positions[at])) {
      out.positions[at] = fit.Apply(pair.found.positions[at]);
    }
  }
}

/// Moves each frame's root onto the true root, and scales it there if asked.
PointTracks AlignedByRoot(const EvaluatedPair& pair, bool with_scale) {
  PointTracks out = Unseen(pair);
  if (pair.found_root.empty()) return out;
  for (std::size_t f = 0; f < pair.found.FrameCount(); ++f) {
    const glm::dvec3 &root = pair.found_root[f], &onto = pair.true_root[f];
    if (!BothSeen(root, onto)) continue;
    double product = 0, square = 0;
    FittedPoints points;
    points.Add(pair, f);
    for (std::size_t i = 0; i < points.found.size(); ++i) {
      product += glm::dot(points.found[i] - root, points.truth[i] - onto);
      square += glm::dot(points.found[i] - root, points.found[i] - root);
    }
    const double scale = with_scale && square > 0 ? product / square : 1;
    Apply({.scale = scale, .rotation = glm::dmat3(1), .translation = onto - scale * root}, pair, f, out);
  }
  return out;
}

/// Returns the first frame in which both show three joints or more.
std::optional<std::size_t> FirstFitting(const EvaluatedPair& pair) {
  for (std::size_t f = 0; f < pair.found.FrameCount(); ++f) {
    FittedPoints points;
    points.Add(pair, f);
    if (points.found.size() >= kMinFitted) return f;
  }
  return std::nullopt;
}

}  // namespace

PointTracks Aligned(const EvaluatedPair& pair, Alignment alignment) {
  assert(pair.found.points == pair.truth.points && pair.found.positions.size() == pair.truth.positions.size());
  using enum Alignment;
  const std::size_t frames = pair.found.FrameCount();
  PointTracks out = Unseen(pair);
  const auto apply_to_all = [&](const std::optional<Similarity>& fit) {
    for (std::size_t f = 0; fit && f < frames; ++f) Apply(*fit, pair, f, out);
  };
  FittedPoints points;
  switch (alignment) {
    case kNone:
      apply_to_all(Similarity{});
      break;
    case kRoot:
    case kRootScaled:
      return AlignedByRoot(pair, alignment == kRootScaled);
    case kFirst:
    case kFirstScaled:
      if (const auto first = FirstFitting(pair)) points.Add(pair, *first);
      apply_to_all(Fit(points, alignment == kFirstScaled));
      break;
    case kTake:
    case kTakeScaled:
      for (std::size_t f = 0; f < frames; ++f) points.Add(pair, f);
      apply_to_all(Fit(points, alignment == kTakeScaled));
      break;
    case kFrame:
    case kFrameScaled:
      for (std::size_t f = 0; f < frames; ++f) {
        FittedPoints of_frame;
        of_frame.Add(pair, f);
        if (const auto fit = Fit(of_frame, alignment == kFrameScaled)) Apply(*fit, pair, f, out);
      }
      break;
  }
  return out;
}

PointTracks AlignedBySegments(const EvaluatedPair& pair, std::size_t length, std::size_t fitted) {
  PointTracks out = Unseen(pair);
  const std::size_t frames = pair.found.FrameCount();
  for (std::size_t begin = 0; begin < frames; begin += length) {
    const std::size_t end = std::min(begin + length, frames);
    FittedPoints points;
    for (std::size_t f = begin; f < std::min(begin + fitted, end); ++f) points.Add(pair, f);
    const auto fit = Fit(points, true);
    for (std::size_t f = begin; fit && f < end; ++f) Apply(*fit, pair, f, out);
  }
  return out;
}

std::vector<double> JointErrorsMm(const PointTracks& aligned, const PointTracks& truth) {
  assert(aligned.positions.size() == truth.positions.size());
  std::vector<double> errors;
  errors.reserve(truth.positions.size());
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    errors.push_back(kToMillimetres * glm::distance(aligned.positions[i], truth.positions[i]));
  }
  return errors;
}

std::optional<double> MeanOfSeen(std::span<const double> values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

std::optional<double> ShareBelow(std::span<const double> values, double limit_mm) {
  std::size_t below = 0, count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++count;
    below += value < limit_mm ? 1 : 0;
  }
  if (count == 0) return std::nullopt;
  return static_cast<double>(below) / static_cast<double>(count);
}

std::optional<double> AucTo150(std::span<const double> values) {
  constexpr int kThresholds = 31;
  constexpr double kStep_mm = 5;
  double sum = 0;
  for (int i = 0; i < kThresholds; ++i) {
    const auto share = ShareBelow(values, i * kStep_mm);
    if (!share) return std::nullopt;
    sum += *share;
  }
  return sum / kThresholds;
}

std::optional<double> SeenShare(const EvaluatedPair& pair) {
  std::size_t shown = 0, both = 0;
  for (std::size_t i = 0; i < pair.truth.positions.size(); ++i) {
    if (std::isnan(pair.truth.positions[i].x)) continue;
    ++shown;
    both += std::isnan(pair.found.positions[i].x) ? 0 : 1;
  }
  if (shown == 0) return std::nullopt;
  return static_cast<double>(both) / static_cast<double>(shown);
}

std::optional<double> AccelerationError(const PointTracks& found, const PointTracks& truth, std::size_t left_out) {
  assert(found.positions.size() == truth.positions.size());
  std::vector<double> errors;
  const std::size_t n = found.points;
  const std::size_t end = found.positions.size() - std::min(left_out * n, found.positions.size());
  for (std::size_t i = (2 + left_out) * n; i < end; ++i) {
    const auto second = [&](const PointTracks& tracks) {
      const auto& p = tracks.positions;
      return p[i - 2 * n] - 2.0 * p[i - n] + p[i];
    };
    errors.push_back(glm::length(second(found) - second(truth)));
  }
  return MeanOfSeen(errors);
}

std::optional<double> Jitter(const PointTracks& found, double rate_hz) {
  constexpr double kPrinted = 10;
  std::vector<double> lengths;
  const std::size_t n = found.points;
  const auto& p = found.positions;
  for (std::size_t i = 3 * n; i < p.size(); ++i) {
    lengths.push_back(glm::length(p[i] - 3.0 * p[i - n] + 3.0 * p[i - 2 * n] - p[i - 3 * n]));
  }
  const auto mean = MeanOfSeen(lengths);
  if (!mean) return std::nullopt;
  return *mean * rate_hz * rate_hz * rate_hz / kPrinted;
}

std::optional<double> RootTranslationError(const EvaluatedPair& pair) {
  FittedPoints points;
  for (std::size_t f = 0; f < pair.found_root.size(); ++f) {
    if (!BothSeen(pair.found_root[f], pair.true_root[f])) continue;
    points.found.push_back(pair.found_root[f]);
    points.truth.push_back(pair.true_root[f]);
  }
  const auto fit = Fit(points, false);
  if (!fit) return std::nullopt;
  double length = 0, error = 0;
  for (std::size_t i = 0; i < points.truth.size(); ++i) {
    if (i > 0) length += glm::distance(points.truth[i], points.truth[i - 1]);
    error += glm::distance(points.truth[i], fit->Apply(points.found[i]));
  }
  if (length == 0) return std::nullopt;
  constexpr double kPerCent = 100;
  return kPerCent * error / static_cast<double>(points.truth.size()) / length;
}

std::optional<RotationChannels> RotationsOf(const EvaluatedPair& pair) {
  if (pair.found_turns.empty() || pair.true_turns.empty()) return std::nullopt;
  std::vector<glm::dquat> found = pair.found_turns, truth = pair.true_turns;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (BothSeen(pair.found.positions[i], pair.truth.positions[i])) continue;
    found[i] = truth[i] = glm::dquat(kUnseen, kUnseen, kUnseen, kUnseen);
  }
  RotationChannels channels;
  channels.truth = QuaternionChannels(truth, pair.truth.points);
  channels.found = QuaternionChannels(found, pair.found.points, channels.truth.values);
  return channels;
}

std::optional<double> BendErrorDeg(const PointTracks& found, const PointTracks& truth,
                                   std::span<const std::array<std::size_t, 3>> bends) {
  std::vector<double> errors;
  for (std::size_t f = 0; f < found.FrameCount(); ++f) {
    for (const auto& [upper, middle, lower] : bends) {
      const auto angle = [&, a = upper, b = middle, c = lower](std::span<const glm::dvec3> p) {
        const glm::dvec3 in = p[b] - p[a], out = p[c] - p[b];
        const bool has_angle = glm::dot(in, in) > 0 && glm::dot(out, out) > 0;  // false for NaN, too
        return has_angle ? Degrees(AngleBetween(in, out)) : kUnseen;
      };
      errors.push_back(std::abs(angle(found.Frame(f)) - angle(truth.Frame(f))));
    }
  }
  return MeanOfSeen(errors);
}

}  // namespace etude
