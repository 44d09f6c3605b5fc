#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/detection.h"
#include "tests/bench/metrics/evaluators.h"

namespace etude {
namespace {

std::vector<JudgedEvent> EventsOf(const Json& in) {
  std::vector<JudgedEvent> events;
  for (const Json& event : in.at("events")) {
    events.push_back({event.at("right").get<bool>(), event.at("called").get<bool>(), event.at("score").get<double>()});
  }
  return events;
}

Confusion ConfusionOf(const Json& in) { return CountConfusion(EventsOf(in)); }

Value Found(const Json& in) {
  std::vector<bool> called;
  for (const Json& performance : in.at("rehearsals")) {
    if (performance.at("severity").get<double>() > 0) called.push_back(performance.at("called").get<bool>());
  }
  return FaultFound(called);
}

Value Grey(const Json& in) {
  std::vector<bool> called;
  for (const Json& performance : in.at("graded")) {
    if (performance.at("truth").get<std::string>() == "grey") called.push_back(performance.at("called").get<bool>());
  }
  return GreyCalledRight(called);
}

Value Spotted(const Json& in) {
  std::vector<MoveWindow> right;
  for (const Json& asked : in.at("asked")) {
    if (!asked.at("right").get<bool>()) continue;
    const auto move = asked.at("move").get<std::string>();
    right.push_back({move, move, asked.at("begin_frame").get<int>(), asked.at("end_frame").get<int>()});
  }
  std::vector<MoveCall> calls;
  for (const Json& call : in.at("calls"))
    calls.push_back({call.at("move").get<std::string>(), call.at("frame").get<int>()});
  return RightSpotted(right, calls);
}

Value Named(const Json& in) {
  std::vector<NamedMove> performances;
  for (const Json& performance : in.at("dances")) {
    performances.push_back({performance.at("danced").get<std::string>(), performance.at("named").get<std::string>()});
  }
  return MoveNamed(performances);
}

std::vector<Moment> MomentsOf(const Json& told) {
  std::vector<Moment> moments;
  for (const Json& each : told) moments.push_back({each.at("move").get<std::string>(), each.at("at_s").get<double>()});
  return moments;
}

Value Points(const Json& in) {
  constexpr double kTolerance = 0.333;
  return MeanFScore(MomentsOf(in.at("points")), MomentsOf(in.at("detections")), kTolerance);
}

Value Latency(const Json& in) {
  std::vector<Wait> waits;
  for (const Json& event : in.at("performances")) {
    const Json& called = event.at("called_frame");
    waits.push_back(AcceptanceLatency(event.at("first_right_s").get<double>(),
                                      called.is_null() ? std::nullopt : std::optional(called.get<int>()),
                                      event.at("window_end_frame").get<int>(), in.at("rate_hz").get<double>()));
  }
  return KaplanMeierMedian(waits);
}

double FalseAlarms(const Json& in) {
  std::vector<MoveWindow> windows;
  for (const Json& window : in.at("windows")) {
    windows.push_back({window.at("asked").get<std::string>(), window.at("danced").get<std::string>(),
                       window.at("begin_frame").get<int>(), window.at("end_frame").get<int>()});
  }
  std::size_t alarms = 0;
  for (const Json& call : in.at("calls")) {
    alarms += IsFalseAlarm(call.at("move").get<std::string>(), call.at("frame").get<int>(), windows);
  }
  return FalseAlarmsPerMinute(alarms, in.at("frames").get<double>() / in.at("rate_hz").get<double>());
}

}  // namespace

std::span<const Evaluator> DetectionEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"precision", [](const Json& in) -> Value { return PrecisionOf(ConfusionOf(in)); }},
      {"recall", [](const Json& in) -> Value { return RecallOf(ConfusionOf(in)); }},
      {"f1", [](const Json& in) -> Value { return F1(ConfusionOf(in)); }},
      {"fault_found", Found},
      {"grey_called_right", Grey},
      {"right_spotted", Spotted},
      {"move_named", Named},
      {"action_point_f", Points},
      {"roc_auc", [](const Json& in) -> Value { return RocAuc(EventsOf(in)); }},
      {"latency_s", Latency},
      {"false_alarms_per_min", [](const Json& in) -> Value { return FalseAlarms(in); }},
  };
  return kAll;
}

}  // namespace etude
