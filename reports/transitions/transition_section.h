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

/// The meanings of paper A's short names of the ten features.
constexpr std::string_view kFeatureLegend =
    "RH, LH: how far the right and the left arm are raised; RHE, LHE: their elbows; Posture: lying to jumping; Trunk: "
    "its lean; RF, LF: how far the legs are spread; RFK, LFK: their knees.";

/// A table of the ten partial distances of frames that met, one row per point, each with a bar: a full bar alone would
/// reach the threshold. Weights stand above, once for all methods that share them.
class DistanceTable {
 public:
  void AddWeights(const std::string& method, const FeatureWeights& weights);
  /// Adds a row for a point that has partials.
  void AddPoint(const std::string& method, const PointFacts& point, std::optional<double> threshold);

  /// Writes the table; "" without points.
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

/// Explains where each recorded transition went, the methods of one request side by side: the ways taken, the ten
/// partial distances of the frames that met, and the candidates. Long lists are cut, and say so. "" without worlds.
std::string TransitionsHtml(const std::vector<RecordedRequest>& worlds);

/// Writes the same in short: the ways, and the largest parts of the distances.
std::string TransitionsMarkdown(const std::vector<RecordedRequest>& worlds);

/// Names the largest of the partial distances, at most three: "LF 0.051, RF 0.036, LHE 0.035"; "all alike" when all are
/// 0.
std::string MostlyBy(const PerFeature& partials);

}  // namespace etude
