#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const std::vector<MetricInput> kPairs = {
    {"threshold", "below which the method calls two poses alike"},
    {"pairs", "per pair of poses: `distance`, the method's, and `pose_gap_cm`, the truth"}};
const char* const kOnePair = "When the world has several pairs.";
const char* const kClose = " A pair is close when its pose_gap_cm is below 15.";

}  // namespace

std::vector<MetricInfo> PoseDistanceCatalogue() {
  return {
      {.id = "called_alike",
       .label = "called alike",
       .unit = "",
       .direction = kNeither,
       .aggregate = kMean,
       .practical = 0.02,
       .definition = "1 when the method calls the two poses alike, else 0.",
       .practical_reason = "One pair in fifty.",
       .formula = "1 if distance < threshold, else 0. No direction is better: it depends on the poses. On a blind spot "
                  "1 is wrong.",
       .null_rule = kOnePair,
       .source = "Etude.",
       .inputs = kPairs},
      {.id = "joint_distance_cm",
       .label = "joint distance",
       .unit = "cm",
       .direction = kNeither,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "How far apart a method that compares joints says that the two poses are.",
       .practical_reason = "A joint that moves at 30 cm/s moves so far in a frame.",
       .formula =
           "joint-positions: 100 · (1/20) Σ_j ‖a_j − b_j‖, b laid onto a as in pose_gap_cm. point-cloud: 100 · "
           "√((1/20) "
           "Σ_j ‖a_j − b_j‖²) after the turn about the vertical axis and the shift on the floor that make it least. "
           "No direction is better: it is the method's own opinion.",
       .null_rule = "When the world has several pairs, or the method measures no such distance.",
       .source = "Kovar et al. 2002, Motion Graphs, section 3.1.",
       .inputs = {{"method", "joint-positions or point-cloud"},
                  {"a", "a pose: the joints that are not at the origin, m"},
                  {"b", "likewise, already laid onto a"}}},
      {.id = "close_auc",
       .label = "ROC area of close pairs",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Probability that a close pair of poses has a smaller distance than another; ties count half.",
       .practical_reason = "One comparison in a hundred.",
       .formula =
           std::string("(#{close nearer than far} + ½ #{level}) / (#close · #far) over all pairs of a close and a "
                       "far pair of the world: whatever the threshold.") +
           kClose,
       .null_rule = "When all pairs are close, or none is.",
       .source = "Fawcett 2006, section 7.",
       .inputs = kPairs},
      {.id = "close_f1",
       .label = "F1 of close pairs",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.02,
       .definition =
           "Harmonic mean of how many pairs called alike are close, and how many close ones are called alike.",
       .practical_reason = "One pair in fifty.",
       .formula = std::string("2 #{close and called alike} / (#close + #{called alike}).") + kClose,
       .null_rule = "When no pair is close and none was called alike.",
       .source = "van Rijsbergen 1979.",
       .inputs = kPairs},
  };
}

}  // namespace etude
