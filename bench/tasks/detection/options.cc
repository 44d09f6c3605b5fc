#include "bench/tasks/detection/options.h"

#include "bench/tasks/base/sensor_key.h"

namespace etude {
namespace {

constexpr Range kShare{0, 1};
constexpr Range kThresholds{0.01, 1};  // 0 would call everything right
constexpr Range kHolds{1, 30};

}  // namespace

const FieldTable<DetectionOptions>& DetectionConditionFields() {
  using Options = DetectionOptions;
  using Key = Field<Options>;
  static const FieldTable<Options> table{
      {Key::Number(
           "events", [](auto& o) -> auto& { return o.session.events; }, {1, 200},
           "How many performances a session holds."),
       Key::Number(
           "fault_share", [](auto& o) -> auto& { return o.session.fault_share; }, kShare,
           "Which share of them has a fault; whether it is wrong is up to how bad the fault is."),
       Key::Number(
           "severity", [](auto& o) -> auto& { return o.session.severity; }, kShare,
           "How bad every fault is: 0 changes nothing, 1 is as bad as it gets.")
           .WhenAbsent("(thrown evenly for each)"),
       Key{{"faults", ListKind("a list of: " + NameKind(FaultNameList()).allowed, NameKind(FaultNameList())), "[]",
            "The faults that may happen; none named: all."},
           [](Fields& condition, Options& o) {
             for (const std::string& name : ReadNames(condition, "faults", FaultNameList())) {
               o.session.faults.push_back(FindFault(name));
             }
           }},
       Key::Number(
           "two_faults", [](auto& o) -> auto& { return o.session.two_faults; }, kShare,
           "The chance that a performance with a fault has a second one."),
       Key::Name(
           "people", [](auto& o) -> auto& { return o.session.people; }, PeopleNames(), FindPeople,
           "Who dances, another person in every trial; `mixed`: toddlers, school children, adults and experts."),
       Key::Number("noise", &Options::noise, {0, 10}, "Times the measured errors of a Kinect-like sensor."),
       Key::Number("turn_deg", &Options::turn_deg, {-180, 180}, "How far the performer is turned away from the sensor.")
           .Unit("degrees"),
       Key{{kSensorKey, TextKind("`v1`, `v2`, a sensor file"), "v2",
            "The skeleton sensor: Kinect v1 as published, v2 as recorded, or one of `etude sensor fit`."},
           [](Fields& condition, Options&) { condition.Raw(kSensorKey); }},
       Key::Number("distance_m", &Options::distance_m, {1, 8}, "From the sensor to the performer, on the floor.")
           .WhenAbsent("(2.5 to 3, thrown in each trial)"),
       Key::Number("sensor_height_m", &Options::sensor_height_m, {0.1, 3}, "Of the sensor above the floor."),
       Key::Name("occluder", &Options::occluder,
                 {{"none", OccluderKind::kNone},
                  {"table", OccluderKind::kTable},
                  {"chair", OccluderKind::kChair},
                  {"person", OccluderKind::kPerson}},
                 "What stands between the sensor and the performer."),
       Key::Number(
           "threshold", [](auto& o) -> auto& { return o.recogniser.threshold; }, kThresholds,
           "The weighted share of a key pose's angles that must be met; for all methods."),
       Key::Number(
           "hold_frames", [](auto& o) -> auto& { return o.recogniser.hold_frames; }, kHolds,
           "For how many frames in a row a key pose must be met; for all methods.")}};
  return table;
}

const FieldTable<DetectionMethod>& DetectionMethodFields() {
  using Method = DetectionMethod;
  using Key = Field<Method>;
  static const std::vector<std::string> recognisers = {"key-pose"};
  static const FieldTable<Method> table{
      {Key::Name(
           "filter", [](auto& m) -> auto& { return m.filter.kind; }, FilterNames(), FilterOf,
           "How the sensed joints are smoothed first."),
       Key::Flags("oracle", {{"stream", &Method::sees_truth}},
                  "What is replaced by the truth: the skeletons as performed instead of as sensed, so what the sensor "
                  "costs."),
       Key{{"recogniser", NameKind(recognisers), recognisers.front(),
            "How a move is recognised: by passing its key poses in order."},
           [](Fields& method, Method&) { method.Choice("recogniser", recognisers, recognisers.front()); }},
       Key::Name(
           "weights", [](auto& m) -> auto& { return m.recogniser.weights; },
           {{"fixed", Weighting::kFixed}, {"adaptive", Weighting::kAdaptive}},
           "How much an angle counts: all alike, or by how well its joints are seen."),
       Key::Number(
           "threshold", [](auto& m) -> auto& { return m.recogniser.threshold; }, kThresholds,
           "The weighted share of a key pose's angles that must be met.")
           .WhenAbsent("(the scenario's)"),
       Key::Number(
           "hold_frames", [](auto& m) -> auto& { return m.recogniser.hold_frames; }, kHolds,
           "For how many frames in a row it must be met.")
           .WhenAbsent("(the scenario's)"),
       Key::Number(
           "inferred_weight", [](auto& m) -> auto& { return m.recogniser.inferred_weight; }, kShare,
           "What an angle with an inferred joint counts.")
           .With("weights", {"adaptive"}),
       Key::Number(
           "not_tracked_weight", [](auto& m) -> auto& { return m.recogniser.not_tracked_weight; }, kShare,
           "What an angle with a joint that is not tracked counts.")
           .With("weights", {"adaptive"})}};
  return table;
}

}  // namespace etude
