#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The Kinect SDK's smoothing (TransformSmoothParameters, SDK 1.8 documentation, "Joint Filtering"): Holt's double
/// exponential smoothing with a jitter radius and a maximal deviation from the raw data. The defaults are the SDK's set
/// "some smoothing with little latency … good for gesture recognition". The SDK gives two more sets, for menus and for
/// a very smooth skeleton, which have more latency.
struct HoltOptions {
  /// The weight of the past, in [0, 1]; 0 follows the raw data. Raise it for a sensor with more jitter; latency grows
  /// with it.
  double smoothing = 0.5;
  /// The weight of a new trend sample, in [0, 1]. Raise it if joints change direction quickly.
  double correction = 0.5;
  /// The number of frames by which the output is predicted ahead, ≥ 0; it compensates for the lag of smoothing. Above
  /// 0.5, quick changes overshoot.
  double prediction_frames = 0.5;
  /// A step shorter than this radius is multiplied by its length divided by the radius. Lower it if small motions
  /// matter; 0 turns damping off.
  double jitter_radius_m = 0.05;
  /// The largest distance of the output from the raw position. Raise it to suppress outliers of single frames.
  double max_deviation_radius_m = 0.04;

  bool operator==(const HoltOptions&) const = default;
};

/// Applies the Holt filter to one joint.
class HoltFilter {
 public:
  explicit HoltFilter(const HoltOptions& options) : options_(options) {}

  /// Takes the next raw position and returns the filtered one. For an inferred joint, both radii of HoltOptions are
  /// doubled, as in the sample of the Kinect SDK.
  glm::dvec3 Update(const glm::dvec3& raw, bool inferred = false);
  /// Forgets the past; the next position is treated as the first.
  void Reset() { count_ = 0; }

 private:
  HoltOptions options_;
  glm::dvec3 raw_{0}, smoothed_{0}, trend_{0};
  int count_ = 0;  // frames since the reset, counted up to 2
};

/// The 1€ filter (Casiez, Roussel, Vogel 2012): a low-pass filter whose cutoff frequency increases with speed. The
/// paper tunes it in two steps: set `beta_per_m` to 0, hold the joint at rest and lower `min_cutoff_hz` until the
/// jitter is acceptable; then move quickly and raise `beta_per_m` until the lag is acceptable.
struct OneEuroOptions {
  /// Cutoff frequency at rest, > 0, as in the paper; lower it for less jitter at rest and more lag in slow motion.
  double min_cutoff_hz = 1.0;
  /// The increase of the cutoff frequency per m/s, ≥ 0 (ours: the paper's value is per pixel). Raise it for dances that
  /// are faster than ours.
  double beta_per_m = 5.0;
  double derivative_cutoff_hz = 1.0;  ///< cutoff for the speed, > 0; the paper's authors found no need to change it

  bool operator==(const OneEuroOptions&) const = default;
};

/// Applies the 1€ filter to one joint, each axis separately, as in the paper.
class OneEuroFilter {
 public:
  OneEuroFilter(const OneEuroOptions& options, double rate_hz) : options_(options), rate_hz_(rate_hz) {}

  /// Takes the next raw position and returns the filtered one, metres.
  glm::dvec3 Update(const glm::dvec3& raw);
  /// Forgets the past; the next position is treated as the first.
  void Reset() { started_ = false; }

 private:
  OneEuroOptions options_;
  double rate_hz_;
  glm::dvec3 smoothed_{0}, derivative_{0};
  bool started_ = false;
};

enum class FilterKind { kNone, kHolt, kOneEuro };

struct FilterOptions {
  /// The default is no filter, which adds no lag; single noisy frames matter little, because key poses must be held
  /// over several frames. Use Holt, which Kinect applications usually turn on, for slightly more detections with fewer
  /// false alarms (`scenarios/quick/detection.yaml`). Use 1€ if joints must be calm at rest and also move quickly.
  FilterKind kind = FilterKind::kNone;
  HoltOptions holt{};         ///< used only if `kind` is kHolt
  OneEuroOptions one_euro{};  ///< used only if `kind` is kOneEuro

  bool operator==(const FilterOptions&) const = default;
};

/// Returns the names of all filters: "none", "holt", "one-euro".
const std::vector<std::string>& FilterNames();
/// Returns the filter called `name`, which must be one of FilterNames().
FilterKind FilterOf(std::string_view name);

/// Smooths every joint separately and causally: the output at frame t depends on frames ≤ t only. A joint that is not
/// tracked passes through unchanged and resets its filter. Tracking states are not changed.
class StreamFilter {
 public:
  /// Creates a filter for frames at `rate_hz` > 0.
  StreamFilter(const FilterOptions& options, double rate_hz);

  /// Takes the next frame and returns it with filtered positions.
  SensedFrame Update(const SensedFrame& raw);

 private:
  FilterKind kind_;
  std::vector<HoltFilter> holt_;         // one filter per joint if the kind is kHolt, else empty
  std::vector<OneEuroFilter> one_euro_;  // one filter per joint if the kind is kOneEuro, else empty
};

/// Filters a whole stream with a StreamFilter.
SkeletonStream Smooth(const SkeletonStream& stream, const FilterOptions& options);

}  // namespace etude
