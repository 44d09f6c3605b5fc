#pragma once

#include <vector>

#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// Estimates the performer's standing hip height causally from the limb lengths: the median over the first second in
/// which a body is seen (in single frames, limb lengths vary by 4–12 %).
class StandingHeight {
 public:
  /// Creates an estimator for frames at `rate_hz` > 0.
  explicit StandingHeight(double rate_hz);

  /// Takes one frame; frames after the first second have no effect.
  void Update(const SensedFrame& frame);
  /// Returns the hip height in metres, > 0; 0.9 before a body was seen.
  double Value() const { return value_; }

 private:
  std::size_t wanted_;
  std::vector<double> heights_;  // hip heights of the frames so far, ascending
  double value_;
};

/// Filters a live stream frame by frame and computes the features that recognisers use. SeeStream uses this class for
/// recorded streams, so live and recorded streams give bit-identical results.
class LiveSight {
 public:
  /// Creates the filter for frames at `rate_hz` > 0.
  LiveSight(const FilterOptions& filter, double rate_hz);

  /// Takes the next frame. The references in the result are valid until the next call.
  SeenFrame Update(const SensedFrame& raw);

 private:
  StreamFilter filter_;
  StandingHeight standing_;
  SensedFrame filtered_;
  FeatureFrame features_;
};

/// A whole stream after filtering, with its features. All recognisers with the same filter share it, so it is computed
/// once.
struct SeenStream {
  SkeletonStream filtered;
  std::vector<FeatureFrame> frames;  ///< features of each frame of the stream

  SeenFrame operator[](std::size_t frame) const { return {filtered.frames[frame], frames[frame]}; }
};

/// Passes a whole stream through a LiveSight.
SeenStream SeeStream(const SkeletonStream& stream, const FilterOptions& filter);

}  // namespace etude
