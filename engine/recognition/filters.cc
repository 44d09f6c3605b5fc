#include "engine/recognition/filters.h"

#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr Named<FilterKind> kFilters[] = {
    {"none", FilterKind::kNone}, {"holt", FilterKind::kHolt}, {"one-euro", FilterKind::kOneEuro}};

/// Returns the weight of a new sample in a first-order low-pass filter (Casiez 2012, equation 5).
double LowPassWeight(double cutoff_hz, double rate_hz) {
  const double time_constant = 1.0 / (2.0 * kPi * cutoff_hz);
  return 1.0 / (1.0 + time_constant * rate_hz);
}

}  // namespace

glm::dvec3 HoltFilter::Update(const glm::dvec3& raw, bool inferred) {
  // An inferred joint gets larger radii.
  const double widening = inferred ? 2.0 : 1.0;
  const double jitter_radius = options_.jitter_radius_m * widening;
  const double max_deviation = options_.max_deviation_radius_m * widening;

  // Smooth the position and the trend. The first two frames initialise the position and the trend.
  const glm::dvec3 previous = smoothed_;
  if (count_ == 0) {
    smoothed_ = raw;
    trend_ = glm::dvec3(0);
  } else if (count_ == 1) {
    smoothed_ = 0.5 * (raw + raw_);
    trend_ = options_.correction * (smoothed_ - previous) + (1.0 - options_.correction) * trend_;
  } else {
    // Damp a step inside the jitter radius, then apply Holt's double exponential smoothing.
    const double step = glm::distance(raw, previous);
    const glm::dvec3 calmed =
        step <= jitter_radius && jitter_radius > 0 ? glm::mix(previous, raw, step / jitter_radius) : raw;
    smoothed_ = (1.0 - options_.smoothing) * calmed + options_.smoothing * (previous + trend_);
    trend_ = options_.correction * (smoothed_ - previous) + (1.0 - options_.correction) * trend_;
  }
  raw_ = raw;
  count_ = std::min(count_ + 1, 2);

  // Predict ahead, and limit the result to the allowed deviation from the raw position.
  const glm::dvec3 predicted = smoothed_ + options_.prediction_frames * trend_;
  const double deviation = glm::distance(predicted, raw);
  if (deviation <= max_deviation) return predicted;
  return glm::mix(raw, predicted, max_deviation / deviation);
}

glm::dvec3 OneEuroFilter::Update(const glm::dvec3& raw) {
  if (!started_) {
    started_ = true;
    smoothed_ = raw;
    derivative_ = glm::dvec3(0);
    return raw;
  }
  const double derivative_weight = LowPassWeight(options_.derivative_cutoff_hz, rate_hz_);
  for (int axis = 0; axis < 3; ++axis) {
    const double slope = (raw[axis] - smoothed_[axis]) * rate_hz_;
    derivative_[axis] += derivative_weight * (slope - derivative_[axis]);
    const double cutoff = options_.min_cutoff_hz + options_.beta_per_m * std::abs(derivative_[axis]);
    smoothed_[axis] += LowPassWeight(cutoff, rate_hz_) * (raw[axis] - smoothed_[axis]);
  }
  return smoothed_;
}

const std::vector<std::string>& FilterNames() {
  static const std::vector<std::string> names = NamesOf(kFilters);
  return names;
}

FilterKind FilterOf(std::string_view name) { return ValueNamed(kFilters, name); }

StreamFilter::StreamFilter(const FilterOptions& options, double rate_hz) : kind_(options.kind) {
  if (kind_ == FilterKind::kHolt) holt_.assign(kRoleCount, HoltFilter(options.holt));
  if (kind_ == FilterKind::kOneEuro) one_euro_.assign(kRoleCount, OneEuroFilter(options.one_euro, rate_hz));
}

SensedFrame StreamFilter::Update(const SensedFrame& raw) {
  SensedFrame smoothed = raw;
  for (std::size_t i = 0; i < kRoleCount && kind_ != FilterKind::kNone; ++i) {
    SensedJoint& joint = smoothed.joints[i];
    const bool is_lost = joint.state == TrackingState::kNotTracked;
    if (kind_ == FilterKind::kHolt) {
      if (is_lost)
        holt_[i].Reset();
      else
        joint.position = holt_[i].Update(joint.position, joint.state == TrackingState::kInferred);
    } else {
      if (is_lost)
        one_euro_[i].Reset();
      else
        joint.position = one_euro_[i].Update(joint.position);
    }
  }
  return smoothed;
}

SkeletonStream Smooth(const SkeletonStream& stream, const FilterOptions& options) {
  SkeletonStream smoothed{.rate_hz = stream.rate_hz, .frames = {}};
  smoothed.frames.reserve(stream.frames.size());
  StreamFilter filter(options, stream.rate_hz);
  for (const SensedFrame& raw : stream.frames) smoothed.frames.push_back(filter.Update(raw));
  return smoothed;
}

}  // namespace etude
