#include "engine/recognition/sight.h"

#include <algorithm>

namespace etude {

StandingHeight::StandingHeight(double rate_hz) : wanted_(static_cast<std::size_t>(rate_hz)) {
  constexpr double kFallback = 0.9;  // hip height to which motions are scaled for evaluation, metres
  value_ = kFallback;
}

void StandingHeight::Update(const SensedFrame& frame) {
  if (!frame.body_seen || heights_.size() >= wanted_) return;
  const double height = StandingHipHeight(PoseOf(frame));
  if (!(height > 0)) return;
  heights_.insert(std::ranges::upper_bound(heights_, height), height);
  value_ = heights_[heights_.size() / 2];
}

LiveSight::LiveSight(const FilterOptions& filter, double rate_hz) : filter_(filter, rate_hz), standing_(rate_hz) {}

SeenFrame LiveSight::Update(const SensedFrame& raw) {
  filtered_ = filter_.Update(raw);
  standing_.Update(filtered_);
  features_ = SeeFeatures(filtered_, standing_.Value());
  return {filtered_, features_};
}

SeenStream SeeStream(const SkeletonStream& stream, const FilterOptions& filter) {
  SeenStream seen{.filtered = {.rate_hz = stream.rate_hz, .frames = {}}, .frames = {}};
  seen.filtered.frames.reserve(stream.frames.size());
  seen.frames.reserve(stream.frames.size());
  LiveSight sight(filter, stream.rate_hz);
  for (const SensedFrame& raw : stream.frames) {
    const SeenFrame frame = sight.Update(raw);
    seen.filtered.frames.push_back(frame.skeleton);
    seen.frames.push_back(frame.features);
  }
  return seen;
}

}  // namespace etude
