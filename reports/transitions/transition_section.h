#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/transitions/recorded_requests.h"

namespace etude {

/// A partial distance below this is written as 0.
constexpr double kMinShownPartial = 0.0005;

/// Explains paper A's abbreviations of the ten features.
constexpr std::string_view kFeatureLegend =
    "RH, LH: angles by which the right and left arms are raised; RHE, LHE: angles of the right and left elbows; "
    "Posture: from lying to jumping; Trunk: lean of the trunk; RF, LF: angles by which the right and left legs are "
    "spread; RFK, LFK: angles of the right and left knees.";

/// A table of the ten partial distances of transition points, one row per point, with a bar for each partial distance.
/// A partial distance of the squared threshold fills its bar; without a threshold, the row's largest one does. The
/// table's first rows list the feature weights, one row for all methods with the same weights.
class DistanceTable {
 public:
  void AddWeights(const std::string& method, const FeatureWeights& weights);
  /// Adds a row for a transition point, which must have partial distances. `threshold` is the method's limit on the
  /// whole distance; nullopt = none.
  void AddPoint(const std::string& method, const PointFacts& point, std::optional<double> threshold);

  /// Returns the table; "" without points.
  std::string Html() const;

 private:
  struct Point {
    std::string method;
    PointFacts facts;
    std::optional<double> threshold;
  };

  /// Names of the methods with the same feature weights, and these weights.
  std::vector<std::pair<std::string, FeatureWeights>> weights_;
  std::vector<Point> points_;
};

/// Explains each recorded transition, with the methods of one request side by side: the frames at which one clip is
/// left and the other clip is entered, the ten partial distances of each transition point, and the candidate pairs of
/// frames. A note says if the list of candidates was shortened. Returns "" without worlds.
std::string TransitionsHtml(const std::vector<RecordedRequest>& worlds);

/// Returns a short form as Markdown: the frames at which one clip is left and the other clip is entered, and the
/// largest partial distances.
std::string TransitionsMarkdown(const std::vector<RecordedRequest>& worlds);

/// Names the features with the largest partial distances, at most three: "LF 0.051, RF 0.036, LHE 0.035"; "all alike"
/// if all are below kMinShownPartial.
std::string MostlyBy(const PerFeature& partials);

}  // namespace etude
