#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const std::string kUncounted = ", or the method is one outside, which does not tell.";

}  // namespace

std::vector<MetricInfo> SearchCatalogue() {
  return {
      {.id = "search_agreement",
       .label = "exact answers",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.001,
       .definition = "Share of queries answered exactly as by a loop over all frames.",
       .practical_reason = "A query in a thousand: an exact index has 1, and nothing less will do.",
       .formula = "#{queries whose frames are the loop's, in its order} / #queries. `first`: the first frame, by its "
                  "number, of d < threshold; `within`: all of them, by number; `nearest` and `nearest-10`: those of "
                  "smallest d, by d, then number. Of no frame at all the right answer is none.",
       .null_rule = "Never: a cell has one query at least.",
       .source = "Etude.",
       .inputs = {{"found", "per query the list of frames answered"}, {"truth", "per query the loop's"}}},
      {.id = "matches_per_query",
       .label = "frames found per query",
       .unit = "",
       .direction = kNeither,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Frames that a query is answered, on average.",
       .practical_reason = "One frame in a hundred queries.",
       .formula = "Σ #frames / #queries.",
       .null_rule = "Never: a cell has one query at least.",
       .source = "Etude.",
       .inputs = {{"found", "per query the list of frames answered"}}},
      {.id = "distances_per_query",
       .label = "distances per query",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Frames of the library to which the distance was computed, on average over the queries.",
       .practical_reason = "Less than one frame is none.",
       .formula =
           "Σ distances / #queries. A distance counts when it was begun, also where its sum was given up as soon "
           "as it was too large. Unlike time, the same on every machine.",
       .null_rule = "When the method is one outside, which does not tell.",
       .source = "Chávez et al. 2001, section 2 (distance evaluations as the cost of a search).",
       .inputs = {{"distances", "per query how many were computed"}}},
      {.id = "boxes_per_query",
       .label = "boxes per query",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 1,
       .definition = "Boxes of frames that were looked at to see whether they can be left out, on average.",
       .practical_reason = "Less than one box is none.",
       .formula = "Σ boxes / #queries. A box counts when a bound of its frames' distances was computed.",
       .null_rule = "When the method has no boxes (brute force)" + kUncounted,
       .source = "Etude.",
       .inputs = {{"boxes", "per query how many were looked at; null for a method without"}}},
  };
}

}  // namespace etude
