#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The Kinect SDK's smoothing (TransformSmoothParameters, SDK 1.8 documentation, "Joint Filtering"):
/// Holt's double exponential smoothing inside a jitter radius, held within a radius of the raw data.
/// The defaults are the SDK's "some smoothing with little latency … good for gesture recognition".
struct HoltOptions {
  double smoothing = 0.5;                ///< in [0, 1]; 0 follows the raw data
  double correction = 0.5;               ///< in [0, 1]; how fast the trend follows
  double prediction_frames = 0.5;        ///< ≥ 0; above 0.5 overshoots on quick changes
  double jitter_radius_m = 0.05;         ///< a step inside it is damped in proportion to its length
  double max_deviation_radius_m = 0.04;  ///< the output stays this close to the raw position
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
struct OneEuroOptions {
  double min_cutoff_hz = 1.0;         ///< the paper's; lower = less jitter at rest
  double beta_per_m = 5.0;            ///< cut-off gained per m/s (ours: the paper's pixels do not carry over)
  double derivative_cutoff_hz = 1.0;  ///< the paper's
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
  FilterKind kind = FilterKind::kNone;
  HoltOptions holt{};
  OneEuroOptions one_euro{};
};

/// "none", "holt", "one-euro".
const std::vector<std::string>& FilterNames();
/// `name` must be one of FilterNames().
FilterKind FilterOf(std::string_view name);

/// Smooths every joint on its own, causally: frame t depends on frames ≤ t only. A joint that is not
/// tracked passes through unchanged and its filter starts anew afterwards. States are kept.
SkeletonStream Smooth(const SkeletonStream& stream, const FilterOptions& options);

}  // namespace etude
