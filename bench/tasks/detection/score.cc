#include "bench/tasks/detection/score.h"

#include <algorithm>

#include "bench/model/recording.h"
#include "engine/base/digest.h"
#include "engine/streams/labels.h"

namespace etude {

std::vector<JudgedEvent> JudgedEvents(const DetectionWorld& world, std::span<const Judgement> judgements) {
  std::vector<JudgedEvent> events;
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    const Judgement& judgement = judgements[i];
    const DetectionEvent& event = world.events[i];
    if (event.truth == Truth::kGrey) continue;
    events.push_back({event.IsRight(), judgement.recognised_at.has_value(), judgement.score});
  }
  return events;
}

namespace {

/// Returns, for each performance that satisfies `is_meant`, true if it was called right.
template <typename IsMeant>
std::vector<bool> CalledRight(const DetectionWorld& world, const SessionVerdict& verdict, IsMeant is_meant) {
  std::vector<bool> called;
  for (std::size_t i = 0; i < verdict.events.size(); ++i) {
    if (is_meant(world.events[i])) called.push_back(verdict.events[i].recognised_at.has_value());
  }
  return called;
}

bool IsGrey(const DetectionEvent& event) { return event.truth == Truth::kGrey; }

bool HasFault(const DetectionEvent& event) { return event.HasFault(); }

void ScoreNames(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire,
                CellResult& result) {
  if (verdict.named.empty()) return result.Missing("move_named", "the method does not name moves");
  std::vector<NamedMove> performances;
  for (std::size_t i = 0; i < verdict.named.size(); ++i) {
    const std::string& danced = world.events[i].danced;
    if (danced.empty()) continue;
    performances.push_back({danced, verdict.named[i] ? repertoire.taught[*verdict.named[i]].name : ""});
  }
  result.MeasureOr("move_named", MoveNamed(performances), "no move was danced");
}

std::optional<double> ShareSpotted(const DetectionWorld& world, const SessionVerdict& verdict,
                                   const Repertoire& repertoire) {
  std::vector<MoveWindow> right;
  for (const DetectionEvent& event : world.events) {
    if (event.IsRight()) right.push_back({event.move, event.danced, event.window.begin, event.window.end});
  }
  std::vector<MoveCall> calls;
  for (const Detection& each : verdict.spotted) calls.push_back({repertoire.taught[each.move].name, each.frame});
  return RightSpotted(right, calls);
}

/// Returns, for each right performance, the time from its completion until it was called right. If it was not called
/// right, the time is censored at the end of its window.
std::vector<Wait> WaitsOf(const DetectionWorld& world, const SessionVerdict& verdict) {
  std::vector<Wait> waits;
  for (std::size_t i = 0; i < verdict.events.size(); ++i) {
    const DetectionEvent& event = world.events[i];
    if (!event.first_right_s) continue;
    const FrameInterval& window = event.window;
    const std::optional<int>& recognised_at = verdict.events[i].recognised_at;
    const std::optional<int> called = recognised_at ? std::optional(window.begin + *recognised_at) : std::nullopt;
    waits.push_back(AcceptanceLatency(*event.first_right_s, called, window.end, world.stream.rate_hz));
  }
  return waits;
}

/// Returns the F-score of the moves spotted in labelled recordings against their action points.
std::optional<double> PointFScore(const DetectionWorld& world, const SessionVerdict& verdict,
                                  const Repertoire& repertoire) {
  const double rate = world.stream.rate_hz;
  std::vector<Moment> points, detections;
  for (const ActionPoint& point : world.points) points.push_back({point.move, point.frame / rate});
  for (const Detection& detection : verdict.spotted) {
    detections.push_back({repertoire.taught[detection.move].name, detection.frame / rate});
  }
  return MeanFScore(points, detections, kActionPointTolerance);
}

std::string SessionDigest(const DetectionWorld& world) {
  Digest digest;
  for (const DetectionEvent& event : world.events) {
    digest.Add(event.move).Add(event.danced).Add(event.FaultText()).Add(event.start_s).Add(event.end_s);
    digest.Add(event.first_right_s.value_or(-1));
  }
  for (const BodyPose& pose : world.motion.poses) AddTo(digest, pose);
  return digest.Hex();
}

std::string StreamDigest(const SkeletonStream& stream) {
  Digest digest;
  for (const SensedFrame& frame : stream.frames) {
    AddTo(digest, PoseOf(frame));
    for (const SensedJoint& joint : frame.joints) digest.Add(static_cast<std::int64_t>(joint.state));
    digest.Add(std::int64_t{frame.body_seen});
  }
  return digest.Hex();
}

std::string EventsDigest(const SessionVerdict& verdict, const Repertoire& repertoire) {
  Digest digest;
  for (const Judgement& judgement : verdict.events) {
    digest.Add(std::int64_t{judgement.recognised_at.value_or(-1)}).Add(judgement.score);
  }
  for (const Detection& alarm : verdict.alarms) {
    digest.Add(repertoire.taught[alarm.move].name).Add(std::int64_t{alarm.frame});
  }
  return digest.Hex();
}

/// Returns the fault's index in AllFaults; −1 if there is no fault.
double IndexOfFault(const std::optional<Fault>& fault) {
  if (!fault) return -1;
  return static_cast<double>(std::ranges::find(AllFaults(), *fault) - AllFaults().begin());
}

}  // namespace

void ScoreSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire,
                  CellResult& result) {
  // Compare the calls with the truth of right and wrong performances.
  const std::vector<JudgedEvent> events = JudgedEvents(world, verdict.events);
  const Confusion confusion = CountConfusion(events);
  const std::vector<Wait> waits = WaitsOf(world, verdict);
  result.MeasureOr("f1", F1(confusion), "no performance was right, and none was called right");
  result.MeasureOr("precision", PrecisionOf(confusion), "no performance was called right");
  result.MeasureOr("recall", RecallOf(confusion), "no performance was right");
  result.MeasureOr("fault_found", FaultFound(CalledRight(world, verdict, HasFault)), "no performance had a fault");
  result.MeasureOr("grey_called_right", GreyCalledRight(CalledRight(world, verdict, IsGrey)),
                   "no performance was grey");
  result.MeasureOr("right_spotted", ShareSpotted(world, verdict, repertoire), "no performance was right");
  ScoreNames(world, verdict, repertoire, result);
  if (world.points.empty()) {
    result.Missing("action_point_f", "there are no action points among the labels");
  } else {
    result.MeasureOr("action_point_f", PointFScore(world, verdict, repertoire), "");
  }
  // Measure scores, waiting times and false alarms.
  result.MeasureOr("roc_auc", RocAuc(events), "all performances that are not grey were right, or all wrong");
  result.MeasureOr(
      "latency_s", KaplanMeierMedian(waits),
      waits.empty() ? "no performance was right" : "fewer than half of the right performances were recognised");
  result.Measure("false_alarms_per_min", FalseAlarmsPerMinute(verdict.alarms.size(), world.motion.DurationSeconds()));
}

std::vector<std::string> DetectionMetrics() {
  return {"f1",         "precision",      "recall",  "fault_found", "grey_called_right",   "right_spotted",
          "move_named", "action_point_f", "roc_auc", "latency_s",   "false_alarms_per_min"};
}

std::optional<double> DetectionFailureValue(std::string_view metric, bool some_are_right) {
  const bool counts_misses = metric == "recall" || metric == "f1";
  return counts_misses && some_are_right ? std::optional(0.0) : std::nullopt;
}

StageDigests WorldDigests(const DetectionWorld& world) {
  return {{"session", SessionDigest(world)}, {"stream", StreamDigest(world.stream)}};
}

StageDigests VerdictDigests(const SessionVerdict& verdict, const Repertoire& repertoire) {
  return {{"filtered", StreamDigest(verdict.filtered)}, {"events", EventsDigest(verdict, repertoire)}};
}

Series ScoreSeries(const DetectionWorld& world, const SessionVerdict& verdict) {
  Series series{.name = "score", .axis = "frame", .values = std::vector<double>(world.stream.frames.size(), 0.0)};
  for (std::size_t i = 0; i < verdict.events.size(); ++i) {
    const FrameInterval window = world.events[i].window;
    const std::vector<double>& scores = verdict.events[i].running_score;
    std::copy(scores.begin(), scores.end(), series.values.begin() + window.begin);
  }
  return series;
}

std::vector<Series> PerformanceSeries(const DetectionWorld& world, const SessionVerdict& verdict,
                                      const Repertoire& repertoire) {
  std::vector<double> score, truth, called, fault, severity, asked, danced, named;
  // Add one value per performance, also for grey performances (neither right nor wrong).
  for (std::size_t i = 0; i < verdict.events.size(); ++i) {
    const DetectionEvent& event = world.events[i];
    score.push_back(verdict.events[i].score);
    called.push_back(verdict.events[i].recognised_at ? 1 : 0);
    truth.push_back(event.IsRight() ? 1 : event.truth == Truth::kGrey ? 0.5 : 0);
    const auto worst = std::ranges::max_element(event.faults, {}, &GradedFault::severity);
    const bool is_graded = worst != event.faults.end();
    fault.push_back(IndexOfFault(is_graded ? std::optional(worst->fault) : FindFault(event.labelled_fault)));
    severity.push_back(is_graded ? worst->severity : 0);
    asked.push_back(static_cast<double>(repertoire.IndexOf(event.move)));
    danced.push_back(event.danced.empty() ? -1 : static_cast<double>(repertoire.IndexOf(event.danced)));
    if (verdict.named.empty()) continue;
    const auto& name = verdict.named[i];
    named.push_back(name ? static_cast<double>(repertoire.IndexOf(repertoire.taught[*name].name)) : -1);
  }
  // Add the waiting times of right performances.
  std::vector<double> waited, answered;
  for (const Wait& wait : WaitsOf(world, verdict)) {
    waited.push_back(wait.seconds);
    answered.push_back(wait.happened ? 1 : 0);
  }
  return {{"performance_score", "performance", std::move(score)},
          {"performance_truth", "performance", std::move(truth)},
          {"performance_called", "performance", std::move(called)},
          {"performance_fault", "performance", std::move(fault), FaultNameList()},
          {"performance_severity", "performance", std::move(severity)},
          {"performance_asked", "performance", std::move(asked), repertoire.names},
          {"performance_danced", "performance", std::move(danced), repertoire.names},
          {"performance_named", "performance", std::move(named), repertoire.names},
          {"right_wait_s", "right performance", std::move(waited)},
          {"right_answered", "right performance", std::move(answered)}};
}

}  // namespace etude
