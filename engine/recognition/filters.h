#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The Kinect SDK's smoothing (TransformSmoothParameters, SDK 1.8 documentation, "Joint Filtering"):
/// Holt's double exponential smoothing inside a jitter radius, held within a radius of the raw data.
/// The defaults are the SDK's "some smoothing with little latency … good for gesture recognition"; it gives two more
/// sets, for menus and for a very smooth skeleton, which pay for calm with latency.
struct HoltOptions {
  /// The weight of the past, in [0, 1]; 0 follows the raw data. Raise it for a sensor that jitters more, at the price
  /// of latency.
  double smoothing = 0.5;
  /// The speed at which the trend follows, in [0, 1]. Raise it where joints turn round quickly.
  double correction = 0.5;
  /// The number of frames by which the output is ahead, ≥ 0, which makes up for the lag of smoothing. Above 0.5 quick
  /// changes overshoot.
  double prediction_frames = 0.5;
  /// A step inside this radius is damped in proportion to its length. Lower it where small motions matter, 0 for none.
  double jitter_radius_m = 0.05;
  /// The output stays this close to the raw position. Raise it for outliers of single frames.
  double max_deviation_radius_m = 0.04;

  bool operator==(const HoltOptions&) const = default;
};

/// One joint through the Holt filter.
class HoltFilter {
 public:
  explicit HoltFilter(const HoltOptions& options) : options_(options) {}

  /// The next raw position → the filtered one. An inferred joint gets both radii doubled, as in the
  /// SDK's sample.
  glm::dvec3 Update(const glm::dvec3& raw, bool inferred = false);
  /// Forgets the past: the next position starts anew.
  void Reset() { count_ = 0; }

 private:
  HoltOptions options_;
  glm::dvec3 raw_{0}, smoothed_{0}, trend_{0};
  int count_ = 0;  // frames since the start, up to 2
};

/// The 1€ filter (Casiez, Roussel, Vogel 2012): a low-pass whose cut-off rises with speed.
/// The paper tunes it in two steps: with `beta_per_m` 0 and a joint at rest, lower `min_cutoff_hz` until the jitter is
/// bearable; then move quickly and raise `beta_per_m` until the lag is.
struct OneEuroOptions {
  double min_cutoff_hz = 1.0;  ///< > 0; the paper's; lower = less jitter at rest, more lag in slow motion
  /// The cut-off gained per m/s, ≥ 0 (ours: the paper's pixels do not carry over). Raise it for dances quicker than
  /// ours.
  double beta_per_m = 5.0;
  double derivative_cutoff_hz = 1.0;  ///< > 0; the paper's, which found no need to change it

  bool operator==(const OneEuroOptions&) const = default;
};

/// One joint through the 1€ filter, each axis on its own, as in the paper.
class OneEuroFilter {
 public:
  OneEuroFilter(const OneEuroOptions& options, double rate_hz) : options_(options), rate_hz_(rate_hz) {}

  glm::dvec3 Update(const glm::dvec3& raw);
  void Reset() { started_ = false; }

 private:
  OneEuroOptions options_;
  double rate_hz_;
  glm::dvec3 smoothed_{0}, derivative_{0};
  bool started_ = false;
};

enum class FilterKind { kNone, kHolt, kOneEuro };

struct FilterOptions {
  /// The default is no filter: key poses must be held over several frames anyway, and nothing lags. Holt, which
  /// Kinect's programmers turn on, finds a little more with fewer false alarms (`scenarios/quick/detection.yaml`); 1€
  /// where joints must both rest quietly and move quickly.
  FilterKind kind = FilterKind::kNone;
  HoltOptions holt{};         ///< read with kHolt only
  OneEuroOptions one_euro{};  ///< read with kOneEuro only

  bool operator==(const FilterOptions&) const = default;
};

/// Returns "none", "holt", "one-euro".
const std::vector<std::string>& FilterNames();
/// Returns the filter of that name, which must be one of FilterNames().
FilterKind FilterOf(std::string_view name);

/// Smooths every joint on its own, frame by frame, causally: frame t depends on frames ≤ t only. A joint that is not
/// tracked passes through unchanged and its filter starts anew afterwards. States are kept.
class StreamFilter {
 public:
  /// Smooths frames of rate `rate_hz` > 0.
  StreamFilter(const FilterOptions& options, double rate_hz);

  SensedFrame Update(const SensedFrame& raw);

 private:
  FilterKind kind_;
  std::vector<HoltFilter> holt_;         // one per joint, of the kind chosen; else none
  std::vector<OneEuroFilter> one_euro_;  // likewise
};

/// A whole stream through a StreamFilter.
SkeletonStream Smooth(const SkeletonStream& stream, const FilterOptions& options);

}  // namespace etude
