#pragma once

#include <vector>

#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The hip height that this performer has when standing, causally: the median, over the first second in which the body
/// was seen, of what the limb lengths say (single frames vary by 4–12 %).
class StandingHeight {
 public:
  /// `rate_hz` > 0.
  explicit StandingHeight(double rate_hz);

  /// Takes one frame in; later frames than those of the first second change nothing.
  void Update(const SensedFrame& frame);
  /// Returns the hip height, metres, > 0; 0.9 before a body was seen.
  double Value() const { return value_; }

 private:
  std::size_t wanted_;
  std::vector<double> heights_;  // of the frames so far, sorted
  double value_;
};

/// Turns a live stream into what recognisers see: frame by frame through the filter, then the features. A stream that
/// was recorded is seen by the same (SeeStream), so both answer the same to the last bit.
class LiveSight {
 public:
  /// `rate_hz` > 0.
  LiveSight(const FilterOptions& filter, double rate_hz);

  /// Takes the next frame. The result's pointers are valid until the next call.
  SeenFrame Update(const SensedFrame& raw);

 private:
  StreamFilter filter_;
  StandingHeight standing_;
  SensedFrame filtered_;
  FeatureFrame features_;
};

/// A stream as recognisers behind the same filter see it: computed once for all of them.
struct SeenStream {
  SkeletonStream filtered;
  std::vector<FeatureFrame> frames;  ///< one per frame of the stream

  SeenFrame operator[](std::size_t frame) const { return {filtered.frames[frame], frames[frame]}; }
};

/// The whole stream through a LiveSight.
SeenStream SeeStream(const SkeletonStream& stream, const FilterOptions& filter);

}  // namespace etude
