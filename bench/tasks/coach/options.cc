#include "bench/tasks/coach/options.h"

#include "bench/keys/field_table.h"
#include "sim/choreography/song.h"

namespace etude {
namespace {

constexpr Range kShare{0, 1};

using Condition = CoachCondition;
using Method = CoachMethod;

const FieldTable<CoachOperatingPoint>& OperatingPointFieldsOfCoach() {
  using Key = Field<CoachOperatingPoint>;
  static const FieldTable<CoachOperatingPoint> table{
      {Key::Number("needless_per_min", &CoachOperatingPoint::needless_per_min, {0, 60},
                   "Allowed number of right performances per minute that the method takes for mistakes."),
       Key::Number("sessions", &CoachOperatingPoint::sessions, {1, 1000},
                   "Number of sessions of other people from which the thresholds are computed.")}};
  return table;
}

std::vector<Field<Method>> CoachFields() {
  using Key = Field<Method>;
  return {Key::Number("most_corrections", Path(&Method::coach, &CoachOptions::most_corrections), {0, 100},
                      "Maximum number of corrections of one performance. After them, the coach continues the dance."),
          Key::Flag("follows_tags", Path(&Method::coach, &CoachOptions::follows_tags),
                    "true: the dance slows down and speeds up with the time tags of the music.")};
}

/// Returns the key `policy`, the policies' settings, and the keys that depend on `policy`.
std::vector<Field<Method>> PolicyFields() {
  using Key = Field<Method>;
  std::vector<Key> fields = {Key::Name("policy", Path(&Method::policy, &Coach::PolicyChoice::policy), PolicyNames(),
                                       FindPolicy, "The policy that decides when the coach interrupts.")};
  Append(SettingFields<Method>("policy", AllPolicies(), Path(&Method::policy, &Coach::PolicyChoice::settings)), fields);
  fields.push_back(Key::Name("partner", &Method::partner, PolicyNames(), FindPolicy,
                             "The policy that coaches another person. The method corrects its learner at the moments "
                             "at which this policy corrects the other person.")
                       .With("policy", {"yoked"}));
  return fields;
}

void CheckMethod(Fields& fields, Method& method) {
  const Node& node = fields.node();
  if (method.knows_truth != method.policy.policy->asks_truth) {
    const Node* named = node.Find(method.knows_truth ? "oracle" : "policy");
    fields.Complain(named->place, "'policy: oracle' and 'oracle: [judgement]' are allowed only together");
  }
  if (method.partner->takes_moments) {
    fields.Complain(node.Find("partner")->place,
                    "'partner' must not be a yoked policy, because a yoked policy itself needs a partner");
  }
  if (method.seat == Seat::kPolicy && node.Find("policy") != nullptr) {
    fields.Complain(node.Find("policy")->place,
                    "'policy' has no effect, because the program in 'seat: policy' replaces the policy");
  }
  if (method.seat == Seat::kRecogniser && node.Find("recogniser") != nullptr) {
    fields.Complain(node.Find("recogniser")->place,
                    "'recogniser' has no effect, because the program in 'seat: recogniser' replaces the recogniser");
  }
}

}  // namespace

const std::vector<std::string>& SeatNames() {
  static const std::vector<std::string> names = {"recogniser", "policy", "learner"};
  return names;
}

const FieldTable<CoachCondition>& CoachConditionFields() {
  using Key = Field<Condition>;
  static const FieldTable<Condition> table = [] {
    // Keys of the song, the learner and the music.
    std::vector<std::pair<std::string, std::string>> songs;
    for (const std::string& song : BuiltinSongNames()) songs.emplace_back(song, song);
    std::vector<Key> fields = {
        Key::Name("song", &Condition::song, songs,
                  "The song to which the learner dances. It is repeated until the session ends."),
        Key::Number("session_s", &Condition::session_s, {10, 1800}, "Length of a session.").Unit("seconds"),
        Key::Name("learning", Path(&Condition::learner, &LearnerOptions::law), LearningLawNames(), FindLearningLaw,
                  "The mathematical law by which the learner learns and forgets."),
        Key::Number("guidance", Path(&Condition::learner, &LearnerOptions::guidance), kShare,
                    "How much frequent feedback harms lasting learning. 0: no harm; 1: what the learner learns with "
                    "feedback after every performance does not last."),
        Key::Number("skill", Path(&Condition::learner, &LearnerOptions::skill), kShare,
                    "Initial value of each skill of the learner.")
            .WhenAbsent("(depends on the kind of people)"),
        Key::Number("severity", Path(&Condition::learner, &LearnerOptions::severity), kShare,
                    "Severity of each fault that happens. 1 is the worst fault of its kind.")
            .WhenAbsent("(drawn uniformly from 0.35 to 1 for each fault)"),
        Key::Flag("gives_up", Path(&Condition::learner, &LearnerOptions::gives_up),
                  "true: the learner can lose patience and give up."),
        Key::Number(
            "music_drift", Path(&Condition::music, &MusicClockOptions::drift), {-0.2, 0.2},
            "Relative error of the music's speed: with 0.02, the music plays 2 % faster than its clock states."),
        Key::Number("stutters_per_min", Path(&Condition::music, &MusicClockOptions::stutters_per_min), {0, 60},
                    "How often the music stops for a moment, per minute."),
        Key::Number("stutter_s", Path(&Condition::music, &MusicClockOptions::stutter_s), {0, 5},
                    "Duration of each stop.")
            .Unit("seconds")};
    // The keys of the sensor, which task detection declares.
    std::vector<std::string> sight = {"people",     "noise",           "turn_deg", "sensor",
                                      "distance_m", "sensor_height_m", "occluder", "threshold"};
    for (const auto& field : CameraSensingFields().fields) sight.push_back(field.info.key);
    Append(FieldsOf<Condition>(DetectionConditionFields(), &Condition::sight, Keep::kThese, sight), fields);
    fields.push_back(
        Key{{"operating_point", MappingKind("a mapping", OperatingPointFieldsOfCoach().Describe()), "(none)",
             "Computes the threshold of evidence from sessions of other people without interruptions. With this "
             "threshold, the given number of right performances per minute is taken for mistakes."},
            [](Fields& condition, Condition& c) {
              if (condition.Raw("operating_point") == nullptr) return;
              ReadNested(condition, "operating_point", OperatingPointFieldsOfCoach(), c.operating_point.emplace());
            }});
    return FieldTable<Condition>{std::move(fields), [](Fields& condition, Condition& c) {
                                   CheckSensorKeys(condition, c.sight);
                                   if (!c.sight.threshold || !c.operating_point) return;
                                   condition.Complain(condition.Raw("threshold")->place,
                                                      "'threshold' and 'operating_point' both set the threshold; "
                                                      "allowed: only one of these keys");
                                 }};
  }();
  return table;
}

const FieldTable<CoachMethod>& CoachMethodFields() {
  using Key = Field<Method>;
  static const FieldTable<Method> table = [] {
    // The keys of the recogniser, the policy and the transitions, which other tables declare; then the key `seat`.
    std::vector<Key> fields =
        FieldsOf<Method>(DetectionMethodFields(), &Method::sight, Keep::kOthers, {"refractory_s", "oracle"});
    fields.push_back(Key::Flags(
        "oracle", {{"stream", Path(&Method::sight, &DetectionMethod::sees_truth)}, {"judgement", &Method::knows_truth}},
        "The data that are replaced by the truth. stream: the sensed skeletons; judgement: the judgement of every "
        "performance, which needs policy `oracle`."));
    Append(PolicyFields(), fields);
    Append(FieldsOf<Method>(TransitionMethodFields(), &Method::transition, Keep::kOthers,
                            {"weights", "wait_s", "threshold"}),
           fields);
    Append(CoachFields(), fields);
    NamedValues<Seat> seats;
    for (std::size_t i = 0; i < SeatNames().size(); ++i) {
      seats.emplace_back(SeatNames()[i], static_cast<Seat>(static_cast<int>(Seat::kRecogniser) + static_cast<int>(i)));
    }
    fields.push_back(
        Key::Name("seat", &Method::seat, seats, "The part of the coaching loop that the program of `exec` replaces.")
            .WhenAbsent("(the coach is built in)")
            .And("with `exec`"));
    return FieldTable<Method>{std::move(fields), CheckMethod};
  }();
  return table;
}

}  // namespace etude
