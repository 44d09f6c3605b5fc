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
           "0 follows the raw data; larger values are smoother and lag more."),
      holt("correction", &HoltOptions::correction, kShare, "How fast the trend follows: larger values react faster."),
      holt("prediction_frames", &HoltOptions::prediction_frames, {0, 10},
           "Number of frames that the output is predicted ahead, to compensate for the lag of smoothing."),
      holt("jitter_radius_m", &HoltOptions::jitter_radius_m, kLengths,
           "A change of position that is smaller than this radius is damped."),
      holt("max_deviation_radius_m", &HoltOptions::max_deviation_radius_m, kLengths,
           "The output stays this close to the raw position."),
      one_euro("min_cutoff_hz", &OneEuroOptions::min_cutoff_hz, {0.01, 100},
               "Cut-off frequency at rest: lower values are smoother, and lag more in slow motion."),
      one_euro("beta_per_m", &OneEuroOptions::beta_per_m, {0, 1000},
               "Increase of the cut-off frequency for every metre per second of speed."),
      one_euro("derivative_cutoff_hz", &OneEuroOptions::derivative_cutoff_hz, {0.01, 100},
               "Cut-off frequency of the low pass that smooths the speed.")};
}

}  // namespace

Result<SkeletonSensorOptions> SensorOf(const TaskInput& input) {
  const Node* named = input.condition.node().Find(kSensorKey);
  if (named == nullptr) return SensorV2();
  if (named->kind != Node::Kind::kScalar || named->scalar.empty()) {
    return Fail(named->place, "'{}' must be v1, v2, a sensor file or cameras, found {}", kSensorKey, Describe(*named));
  }
  if (named->scalar == kCameraSensor) return SensorV2();
  if (const auto preset = FindSensorPreset(named->scalar)) return *preset;
  return ReadSensorFile(input.texts.at(kSensorKey), named->scalar);
}

const FieldTable<OperatingPoint>& OperatingPointFields() {
  using Key = Field<OperatingPoint>;
  static const FieldTable<OperatingPoint> table{
      {Key::Number("false_alarms_per_min", &OperatingPoint::false_alarms_per_min, {0.01, 60},
                   "Allowed number of false alarms a minute when moves are spotted without a request."),
       Key::Number("recall", &OperatingPoint::recall, {0.01, 1},
                   "Share of the right performances of requested moves that must be judged right."),
       Key::Number("sessions", &OperatingPoint::sessions, {1, 1000},
                   "Number of sessions of other people on which the thresholds are set.")}};
  return table;
}

namespace {

FieldTable<DetectionOptions> MakeConditionFields() {
  using Options = DetectionOptions;
  using Key = Field<Options>;
  FieldTable<Options> made{
      {Key{{kMovesKey, FileKind("a file that `etude teach` wrote"),
            "(each person is judged by what the other people teach)",
            "For recordings of people: the moves that recognisers are taught."},
           [](Fields& condition, Options& o) { o.moves = condition.Text(kMovesKey, ""); }},
       // Keys of the session and the performers.
       Key::Number("events", Path(&Options::session, &SessionOptions::events), {1, 200},
                   "Number of performances in a session."),
       Key::Number("fault_share", Path(&Options::session, &SessionOptions::fault_share), kShare,
                   "Share of the performances that have a fault; whether such a performance is wrong depends on the "
                   "fault's severity."),
       Key::Number("severity", Path(&Options::session, &SessionOptions::severity), kShare,
                   "Severity of every fault: 0 changes nothing, 1 is the worst of its kind.")
           .WhenAbsent("(drawn uniformly for each)"),
       Key{{"faults", ListKind("a list of: " + NameKind(FaultNameList()).allowed, NameKind(FaultNameList())), "[]",
            "The faults that may happen; an empty list: all. For recordings: the faulty copies made of each right "
            "performance (`amplitude`, `wrong_side`, `wrong_move`); an empty list: none."},
           [](Fields& condition, Options& o) {
             for (const std::string& name : ReadNames(condition, "faults", FaultNameList())) {
               if (const auto fault = FindFault(name)) o.session.faults.push_back(*fault);
             }
           }},
       Key::Number("two_faults", Path(&Options::session, &SessionOptions::two_faults), kShare,
                   "Probability that a performance with a fault has a second one."),
       Key::Name("people", Path(&Options::session, &SessionOptions::people), PeopleNames(), FindPeople,
                 "The kind of people who dance, another person in every trial; `mixed`: toddlers, school children, "
                 "adults and experts."),
       // Keys of the sensor and its view.
       Key::Number("noise", &Options::noise, {0, 10}, "Multiplies the measured errors of a Kinect-like sensor."),
       Key::Number("turn_deg", &Options::turn_deg, {-180, 180},
                   "Angle by which the performer is turned away from the sensor.")
           .Unit("degrees"),
       Key{{kSensorKey, FileKind("`v1`, `v2`, a sensor file, `cameras`", IsSensorFile), "v2",
            "The source of skeletons: Kinect v1 as published, v2 as recorded, a file of `etude sensor fit`, or "
            "cameras, with the keys of `task: capture` and each method's `capture`."},
           [](Fields& condition, Options& o) {
             const Node* named = condition.Raw(kSensorKey);
             o.has_cameras = named != nullptr && named->scalar == kCameraSensor;
           }},
       Key::Number("distance_m", &Options::distance_m, {1, 8},
                   "Distance from the sensor to the performer, along the floor.")
           .WhenAbsent("(2.5 to 3, drawn in each trial)"),
       Key::Number("sensor_height_m", &Options::sensor_height_m, {0.1, 3}, "Height of the sensor above the floor."),
       Key::Name("occluder", &Options::occluder,
                 {{"none", OccluderKind::kNone},
                  {"table", OccluderKind::kTable},
                  {"chair", OccluderKind::kChair},
                  {"person", OccluderKind::kPerson}},
                 "What stands between the sensor and the performer."),
       // Keys of the thresholds of methods that do not set one.
       Key::Number("threshold", &Options::threshold, kThresholds,
                   "Lowest evidence at which a move counts as performed; for all methods.")
           .WhenAbsent("(each recogniser's own)"),
       Key{{"operating_point", MappingKind("a mapping", OperatingPointFields().Describe()), "(none)",
            "Sets each method's thresholds from sessions of other people: for spotting, by a rate of false alarms; for "
            "judging requested moves, by a recall."},
           [](Fields& condition, Options& o) {
             if (condition.Raw("operating_point") == nullptr) return;
             ReadNested(condition, "operating_point", OperatingPointFields(), o.operating_point.emplace());
           }}},
      [](Fields& condition, Options& o) {
        CheckSensorKeys(condition, o);
        if (!o.threshold || !o.operating_point) return;
        condition.Complain(condition.Raw("threshold")->place,
                           "'threshold' and 'operating_point' both set thresholds; allowed: one of them");
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
                         fmt::format("'{}' belongs to skeleton sensors; cameras have their own keys", key));
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
                                                     "How the sensed joints are smoothed before recognition.")};
    Append(FilterFields(), fields);
    fields.push_back(
        MethodKey::Flags("oracle", {{"stream", &Method::sees_truth}},
                         "What is replaced by the truth: the sensed skeletons, to show what the sensor costs."));
    fields.push_back(CaptureField<Method>(&Method::capture));
    // Keys of the stages from skeletons to verdicts.
    fields.push_back(MethodKey::Name("recogniser", Path(&Method::recogniser, &RecogniserOptions::kind),
                                     RecogniserNames(), FindRecogniser, "How a move is recognised."));
    const auto settings = Path(&Method::recogniser, &RecogniserOptions::settings);
    Append(SettingFields<Method>("recogniser", AllRecognisers(), settings), fields);
    fields.push_back(
        MethodKey::Name("weights", Path(&Method::recogniser, &RecogniserOptions::weights, &TrackingWeights::weighting),
                        {{"fixed", Weighting::kFixed}, {"adaptive", Weighting::kAdaptive}},
                        "Weights of the sensed values: all equal, or by how well their joints are seen."));
    fields.push_back(
        MethodKey::Number("inferred_weight",
                          Path(&Method::recogniser, &RecogniserOptions::weights, &TrackingWeights::inferred_weight),
                          kShare,
                          "Weight of values that need an inferred joint; values of tracked joints have weight 1.")
            .With("weights", {"adaptive"}));
    fields.push_back(MethodKey::Number("threshold", &Method::threshold, kThresholds,
                                       "Lowest evidence at which a move counts as performed.")
                         .WhenAbsent("(the scenario's, else the recogniser's own)"));
    fields.push_back(MethodKey::Number("refractory_s", &Method::refractory_s, {0, 60},
                                       "Time after a detection in which the same move is not spotted again."));
    return FieldTable<Method>{std::move(fields)};
  }();
  return table;
}

}  // namespace etude
