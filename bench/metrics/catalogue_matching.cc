#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const std::vector<MetricInput> kPairs = {
    {"threshold", "below which a distance is a match; null for a method that matches no frames"},
    {"pairs", "per pair of bridge frames: `distance`, and `pose_gap_cm` after alignment"}};

const std::string kNoThreshold = "the method matches no frames by a threshold" + kOutside;
const std::string kThePairs =
    " The pairs are those that the choice may take: a frame of the old clip from the request until the wait limit, and "
    "a "
    "frame of the new clip but its last one, after which nothing would follow; both bridge frames, unless the choice "
    "looks at all frames. In task pose-distance they are the pairs of poses drawn.";

}  // namespace

std::vector<MetricInfo> MatchingCatalogue() {
  return {
      {.id = "direct_match",
       .label = "direct match",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition = "1 when the two clips have matching frames within the wait, else 0.",
       .practical_reason = "One switch in fifty.",
       .formula =
           "1 if d < threshold for one pair at least, else 0, also where there is no pair: through an in-between a "
           "method may find a way without." +
           kThePairs,
       .null_rule = "When " + kNoThreshold,
       .source = "Paper A: without a direct match the switch goes through an in-between clip.",
       .inputs = kPairs},
      {.id = "matching_share",
       .label = "matching pairs",
       .unit = "",
       .direction = kNeither,
       .aggregate = kMedian,
       .practical = 0.005,
       .definition = "Share of the pairs of bridge frames within the wait that match.",
       .practical_reason = "One pair in two hundred; few windows have more than some hundreds.",
       .formula = "#{d < threshold} / #pairs, of one window. No direction is better: a threshold that lets all pairs "
                  "through has the largest." +
                  kThePairs,
       .null_rule = "When there is no pair, " + kNoThreshold,
       .source = "Etude.",
       .inputs = kPairs},
      {.id = "false_smooth_share",
       .label = "falsely smooth pairs",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.02,
       .definition = "Share of the matching pairs whose worst joint is more than 20 cm off.",
       .practical_reason = "One match in fifty.",
       .formula =
           "#{d < threshold and pose gap > 20 cm} / #{d < threshold}, of one window: how far the threshold is to be "
           "trusted, whichever pair is taken. A pair's pose gap is that of pose_gap_cm; exactly 20 is not "
           "more." +
           kThePairs,
       .null_rule = "When nothing matches, " + kNoThreshold,
       .source = "Etude: what paper A's distance cannot see.",
       .inputs = kPairs},
      {.id = "in_between",
       .label = "through an in-between",
       .unit = "",
       .direction = kNeither,
       .aggregate = kMean,
       .practical = 0.02,
       .definition = "1 when something else was shown between the two clips, else 0.",
       .practical_reason = "One switch in fifty.",
       .formula = "1 if more than two runs of frames are shown: the old clip, then frames of a third clip or of the "
                  "method's making, then the new clip; else 0. No direction is better: an in-between finds a way where "
                  "there is none, and costs time and a second seam.",
       .null_rule = "When no way was found (status unsolved).",
       .source = "Paper A (補間動作).",
       .inputs = {{"legs", "how many runs of frames are shown; null when no way was found"}}},
  };
}

}  // namespace etude
