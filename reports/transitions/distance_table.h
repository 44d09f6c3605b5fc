#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/transitions/recorded_requests.h"

namespace etude {

/// A partial distance below this is written as 0.
constexpr double kLeastShown = 0.0005;

/// What paper A's short names of the ten features stand for.
constexpr std::string_view kFeatureLegend =
    "RH, LH: how far the right and the left arm are raised; RHE, LHE: their elbows; Posture: lying to jumping; Trunk: "
    "its lean; RF, LF: how far the legs are spread; RFK, LFK: their knees.";

/// The ten partial distances of frames that met, one row per point, each with a bar: a full bar alone would reach the
/// threshold. Weights stand above, once for all methods that share them.
class DistanceTable {
 public:
  void AddWeights(const std::string& method, const FeatureWeights& weights);
  /// `point` has partials.
  void AddPoint(const std::string& method, const PointFacts& point, std::optional<double> threshold);

  /// "" without points.
  std::string Html() const;

 private:
  struct Point {
    std::string method;
    PointFacts facts;
    std::optional<double> threshold;
  };

  std::vector<std::pair<std::string, FeatureWeights>> weights_;  ///< whose they are, in words
  std::vector<Point> points_;
};

}  // namespace etude
