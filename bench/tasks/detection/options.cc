#include "bench/tasks/detection/options.h"

namespace etude {
namespace {

constexpr Range kShare{0, 1};
constexpr Range kThresholds{0.01, 1};  // 0 would call every performance right
constexpr Range kLengths{0, 1};        // metres

using Method = DetectionMethod;
using MethodKey = Field<Method>;

bool IsSensorFile(std::string_view reference) { return !FindSensorPreset(reference) && reference != kCameraSensor; }

std::vector<MethodKey> FilterFields() {
  const auto holt = [](const std::string& key, double HoltOptions::*member, Range range, const std::string& meaning) {
    const auto value = Path(&Method::filter, &FilterOptions::holt, member);
    return MethodKey::Number(key, value, range, meaning).With("filter", {"holt"});
  };
  const auto one_euro = [](const std::string& key, double OneEuroOptions::*member, Range range,
                           const std::string& meaning) {
    const auto value = Path(&Method::filter, &FilterOptions::one_euro, member);
    return MethodKey::Number(key, value, range, meaning).With("filter", {"one-euro"});
  };
  return {
      holt("smoothing", &HoltOptions::smoothing, kShare,
           "Strength of smoothing. 0 follows the raw data. Larger values make the motion smoother and increase the "
           "lag."),
      holt("correction", &HoltOptions::correction, kShare,
           "How fast the filter's trend follows the motion. Larger values react faster."),
      holt("prediction_frames", &HoltOptions::prediction_frames, {0, 10},
           "Number of frames by which the output is predicted ahead. The prediction compensates for the lag of "
           "smoothing."),
      holt("jitter_radius_m", &HoltOptions::jitter_radius_m, kLengths,
           "The filter damps changes of position that are smaller than this radius."),
      holt("max_deviation_radius_m", &HoltOptions::max_deviation_radius_m, kLengths,
           "Largest allowed distance between the output and the raw position."),
      one_euro("min_cutoff_hz", &OneEuroOptions::min_cutoff_hz, {0.01, 100},
               "Cut-off frequency at rest. Lower values make the motion smoother and increase the lag of slow motion."),
      one_euro("beta_per_m", &OneEuroOptions::beta_per_m, {0, 1000},
               "Increase of the cut-off frequency per metre per second of speed."),
      one_euro("derivative_cutoff_hz", &OneEuroOptions::derivative_cutoff_hz, {0.01, 100},
               "Cut-off frequency of the low-pass filter that smooths the speed.")};
}

}  // namespace

Result<SkeletonSensorOptions> SensorOf(const TaskInput& input) {
  const Node* named = input.condition.node().Find(kSensorKey);
  if (named == nullptr) return SensorV2();
  if (named->kind != Node::Kind::kScalar || named->scalar.empty()) {
    return Fail(named->place, "'{}' must be v1, v2, cameras or a sensor file, found {}", kSensorKey, Describe(*named));
  }
  if (named->scalar == kCameraSensor) return SensorV2();
  if (const auto preset = FindSensorPreset(named->scalar)) return *preset;
  return ReadSensorFile(input.texts.at(kSensorKey), named->scalar);
}

const FieldTable<OperatingPoint>& OperatingPointFields() {
  using Key = Field<OperatingPoint>;
  static const FieldTable<OperatingPoint> table{
      {Key::Number("false_alarms_per_min", &OperatingPoint::false_alarms_per_min, {0.01, 60},
                   "Allowed number of false alarms per minute while moves are spotted without a request."),
       Key::Number("recall", &OperatingPoint::recall, {0.01, 1},
                   "Share of the right performances that the method must judge right, for requested moves."),
       Key::Number("sessions", &OperatingPoint::sessions, {1, 1000},
                   "Number of sessions of other people from which the thresholds are computed.")}};
  return table;
}

namespace {

FieldTable<DetectionOptions> MakeConditionFields() {
  using Options = DetectionOptions;
  using Key = Field<Options>;
  FieldTable<Options> made{
      {Key{{kMovesKey, FileKind("a file that `etude teach` wrote"),
            "(for each person, the recordings of the other people teach the moves)",
            "For recordings of people: a file with the moves that the recognisers learn."},
           [](Fields& condition, Options& o) { o.moves = condition.Text(kMovesKey, ""); }},
       // Keys of the session and the performers.
       Key::Number("events", Path(&Options::session, &SessionOptions::events), {1, 200},
                   "Number of performances in a session."),
       Key::Number("fault_share", Path(&Options::session, &SessionOptions::fault_share), kShare,
                   "Share of the performances that have a fault. Whether such a performance is wrong depends on the "
                   "severity of the fault."),
       Key::Number("severity", Path(&Options::session, &SessionOptions::severity), kShare,
                   "Severity of each fault. 0 changes nothing, and 1 is the worst fault of its kind.")
           .WhenAbsent("(drawn uniformly for each fault)"),
       Key{{"faults", ListKind("a list of: " + NameKind(FaultNameList()).allowed, NameKind(FaultNameList())), "[]",
            "For simulated people: the faults that may happen; an empty list allows all faults. For recordings: the "
            "faulty copies that are made of each right performance (`amplitude`, `wrong_side`, `wrong_move`); with an "
            "empty list, no copies are made."},
           [](Fields& condition, Options& o) {
             for (const std::string& name : ReadNames(condition, "faults", FaultNameList())) {
               if (const auto fault = FindFault(name)) o.session.faults.push_back(*fault);
             }
           }},
       Key::Number("two_faults", Path(&Options::session, &SessionOptions::two_faults), kShare,
                   "Probability that a performance with a fault has a second fault."),
       Key::Name("people", Path(&Options::session, &SessionOptions::people), PeopleNames(), FindPeople,
                 "The kind of people who dance. Every trial has a different person. `mixed`: toddlers, school "
                 "children, adults and experts."),
       // Keys of the sensor and its view.
       Key::Number("noise", &Options::noise, {0, 10},
                   "Factor that multiplies the measured errors of a Kinect-like sensor."),
       Key::Number("turn_deg", &Options::turn_deg, {-180, 180},
                   "Angle by which the performer is turned away from the sensor.")
           .Unit("degrees"),
       Key{{kSensorKey, FileKind("`v1`, `v2`, a sensor file, `cameras`", IsSensorFile), "v2",
            "The source of skeletons: a Kinect v1 with published errors, a Kinect v2 with errors from a recording, a "
            "sensor file that `etude sensor fit` wrote, or cameras. Cameras have the keys of `task: capture` and each "
            "method's key `capture`."},
           [](Fields& condition, Options& o) {
             const Node* named = condition.Raw(kSensorKey);
             o.has_cameras = named != nullptr && named->scalar == kCameraSensor;
           }},
       Key::Number("distance_m", &Options::distance_m, {1, 8},
                   "Distance from the sensor to the performer, along the floor.")
           .WhenAbsent("(drawn from 2.5 to 3 for each trial)"),
       Key::Number("sensor_height_m", &Options::sensor_height_m, {0.1, 3}, "Height of the sensor above the floor."),
       Key::Name("occluder", &Options::occluder,
                 {{"none", OccluderKind::kNone},
                  {"table", OccluderKind::kTable},
                  {"chair", OccluderKind::kChair},
                  {"person", OccluderKind::kPerson}},
                 "The obstacle between the sensor and the performer."),
       // Keys of the thresholds of methods that do not set one.
       Key::Number("threshold", &Options::threshold, kThresholds,
                   "Lowest evidence at which a move counts as performed. It applies to all methods that do not set "
                   "their own threshold.")
           .WhenAbsent("(the recogniser's default)"),
       Key{{"operating_point", MappingKind("a mapping", OperatingPointFields().Describe()), "(none)",
            "Computes each method's thresholds from sessions of other people. The threshold for spotting gives a "
            "chosen rate of false alarms. The threshold for judging requested moves gives a chosen recall."},
           [](Fields& condition, Options& o) {
             if (condition.Raw("operating_point") == nullptr) return;
             ReadNested(condition, "operating_point", OperatingPointFields(), o.operating_point.emplace());
           }}},
      [](Fields& condition, Options& o) {
        CheckSensorKeys(condition, o);
        if (!o.threshold || !o.operating_point) return;
        condition.Complain(condition.Raw("threshold")->place,
                           "'threshold' and 'operating_point' both set the threshold; allowed: only one of these keys");
      }};
  const auto studio = Path(&DetectionOptions::cameras, &CameraSensing::studio);
  Append(FieldsOf<Options>(CameraSensingFields(), studio, Keep::kOthers, {}), made.fields);
  return made;
}

}  // namespace

void CheckSensorKeys(Fields& condition, DetectionOptions& options) {
  if (!options.has_cameras) return;
  for (const char* key : {"noise", "turn_deg", "distance_m", "sensor_height_m", "occluder"}) {
    if (const Node* written = condition.Raw(key)) {
      condition.Complain(written->place,
                         fmt::format("'{}' is not allowed with cameras, because it describes a skeleton sensor", key));
    }
  }
  CameraSensingFields().check(condition, options.cameras.studio);
}

const FieldTable<DetectionOptions>& DetectionConditionFields() {
  static const FieldTable<DetectionOptions> table = MakeConditionFields();
  return table;
}

std::span<const std::string_view> PeopleKeys() {
  static constexpr std::string_view kKeys[] = {"events", "fault_share", "severity", "two_faults", "people"};
  return kKeys;
}

std::span<const std::string_view> SensingKeys() {
  static constexpr std::string_view kKeys[] = {"noise",      "turn_deg",        kSensorKey,
                                               "distance_m", "sensor_height_m", "occluder"};
  return kKeys;
}

const FieldTable<DetectionMethod>& DetectionMethodFields() {
  static const FieldTable<Method> table = [] {
    // Keys of the stages from the sensor to skeletons.
    std::vector<MethodKey> fields = {MethodKey::Name("filter", Path(&Method::filter, &FilterOptions::kind),
                                                     FilterNames(), FilterOf,
                                                     "The filter that smooths the sensed joints before recognition.")};
    Append(FilterFields(), fields);
    fields.push_back(MethodKey::Flags(
        "oracle", {{"stream", &Method::sees_truth}},
        "stream: the true skeletons replace the sensed skeletons, to measure how much the sensor's errors cost."));
    fields.push_back(CaptureField<Method>(&Method::capture));
    // Keys of the stages from skeletons to verdicts.
    fields.push_back(MethodKey::Name("recogniser", Path(&Method::recogniser, &RecogniserOptions::kind),
                                     RecogniserNames(), FindRecogniser, "The method that recognises moves."));
    const auto settings = Path(&Method::recogniser, &RecogniserOptions::settings);
    Append(SettingFields<Method>("recogniser", AllRecognisers(), settings), fields);
    fields.push_back(
        MethodKey::Name("weights", Path(&Method::recogniser, &RecogniserOptions::weights, &TrackingWeights::weighting),
                        {{"fixed", Weighting::kFixed}, {"adaptive", Weighting::kAdaptive}},
                        "Weights of the sensed values. fixed: all weights are equal; adaptive: a weight depends on how "
                        "well the sensor sees the joints of the value."));
    fields.push_back(
        MethodKey::Number("inferred_weight",
                          Path(&Method::recogniser, &RecogniserOptions::weights, &TrackingWeights::inferred_weight),
                          kShare,
                          "Weight of values that depend on an inferred joint. Values of tracked joints have weight 1.")
            .With("weights", {"adaptive"}));
    fields.push_back(MethodKey::Number("threshold", &Method::threshold, kThresholds,
                                       "Lowest evidence at which a move counts as performed.")
                         .WhenAbsent("(the scenario's `threshold`; without it, the recogniser's default)"));
    fields.push_back(MethodKey::Number("refractory_s", &Method::refractory_s, {0, 60},
                                       "After a detection, the same move is not spotted again during this time."));
    return FieldTable<Method>{std::move(fields)};
  }();
  return table;
}

}  // namespace etude
