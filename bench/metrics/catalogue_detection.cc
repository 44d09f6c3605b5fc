#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const std::vector<MetricInput> kEvents = {
    {"events",
     "per performance asked for: `right`, the truth; `called`, whether the recogniser called it right within its "
     "window; `score`, its soft answer, higher = righter"}};

const char* const kOneInHundred = "One performance in a hundred; a session has about ten.";

}  // namespace

std::vector<MetricInfo> DetectionCatalogue() {
  return {
      {.id = "precision",
       .label = "precision",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of performances called right that are right.",
       .practical_reason = kOneInHundred,
       .formula = "TP / (TP + FP) over the performances of a session. One performance is one event: the move asked "
                  "for, judged from its first beat to half a second after its last. Positive is \"right\": performed "
                  "without a fault.",
       .null_rule = "When no performance was called right.",
       .source = "van Rijsbergen 1979.",
       .inputs = kEvents},
      {.id = "recall",
       .label = "recall",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Share of right performances that are called right.",
       .practical_reason = kOneInHundred,
       .formula = "TP / (TP + FN), events as in precision.",
       .null_rule = "When no performance was right.",
       .source = "van Rijsbergen 1979.",
       .inputs = kEvents},
      {.id = "f1",
       .label = "F1",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMean,
       .practical = 0.01,
       .definition = "Harmonic mean of precision and recall.",
       .practical_reason = kOneInHundred,
       .formula = "2 TP / (2 TP + FP + FN), events as in precision; 0 when right performances were all missed, also "
                  "where precision has no value.",
       .null_rule = "When no performance was right and none was called right.",
       .source = "van Rijsbergen 1979.",
       .inputs = kEvents},
      {.id = "roc_auc",
       .label = "ROC area",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Probability that a right performance scores above a faulty one; ties count half.",
       .practical_reason = "One pair of performances in a hundred.",
       .formula = "(#{right above faulty} + ½ #{right level with faulty}) / (#right · #faulty) over all pairs of a "
                  "right and a faulty performance: the Mann–Whitney statistic, equal to the trapezoidal area.",
       .null_rule = "When all performances were right, or none was.",
       .source = "Fawcett 2006, section 7; Hanley and McNeil 1982.",
       .inputs = kEvents},
      {.id = "latency_s",
       .label = "detection latency",
       .unit = "s",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.05,
       .definition = "Median time from first truly right to first called right; misses are censored (Kaplan–Meier).",
       .practical_reason = "A frame and a half at 30 Hz.",
       .formula =
           "Per right performance the time from when it had truly passed through every key pose asked for, to the "
           "first frame called right, frame / rate − time; negative when called early. One that was never called is "
           "censored at the end of its window: it waited longer than that. The median is the first time at which the "
           "Kaplan–Meier estimate Π (1 − 1/n) is ½ or less, n being those still waiting; what happens at a time "
           "happens before what is censored at it. Faulty performances are in roc_auc and precision, not here.",
       .null_rule = "When no performance was right, or the estimate never falls to ½.",
       .source = "Kaplan and Meier 1958.",
       .inputs = {{"rate_hz", "frames per second"},
                  {"performances",
                   "per right performance: `first_right_s`, seconds from the session's start; `called_frame`, or null; "
                   "`window_end_frame`, the first frame after its window"}}},
      {.id = "false_alarms_per_min",
       .label = "false alarms",
       .unit = "1/min",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.5,
       .definition = "Times per minute that a move is called right outside the window of its performance.",
       .practical_reason = "One false alarm in a session of two minutes.",
       .formula = "alarms / minutes of the whole session: performances included, since a move's recogniser runs "
                  "through others' windows too. A call of move m at frame f is an alarm unless begin ≤ f < end holds "
                  "for a performance in which m was asked for or danced. How often a recogniser calls while a move "
                  "lasts is part of the recogniser; what a method outside says twice counts once.",
       .null_rule = "Never.",
       .source = "Etude.",
       .inputs = {{"rate_hz", "frames per second"},
                  {"frames", "of the session"},
                  {"calls", "every time a recogniser fired: `move` and `frame`"},
                  {"windows",
                   "per performance: `asked` and `danced`, moves (\"\" = none); `begin_frame`; `end_frame`, the first "
                   "after it"}}},
  };
}

}  // namespace etude
