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
                   "How many right performances a minute may be taken for mistakes."),
       Key::Number("sessions", &CoachOperatingPoint::sessions, {1, 1000},
                   "On how many sessions of other people the thresholds are set.")}};
  return table;
}

std::vector<Field<Method>> CoachFields() {
  using Key = Field<Method>;
  return {Key::Number("most_corrections", Path(&Method::coach, &CoachOptions::most_corrections), {0, 100},
                      "How often at most one performance is corrected before the dance goes on."),
          Key::Flag("follows_tags", Path(&Method::coach, &CoachOptions::follows_tags),
                    "Whether music-time tags slow and hurry the dance.")};
}

/// `policy`, its settings, and what goes with them.
std::vector<Field<Method>> PolicyFields() {
  using Key = Field<Method>;
  std::vector<Key> fields = {Key::Name("policy", Path(&Method::policy, &Coach::PolicyChoice::policy), PolicyNames(),
                                       FindPolicy, "When the coach interrupts.")};
  Append(SettingFields<Method>("policy", AllPolicies(), Path(&Method::policy, &Coach::PolicyChoice::settings)), fields);
  fields.push_back(Key::Name("partner", &Method::partner, PolicyNames(), FindPolicy,
                             "Whose moments it corrects at: this policy's, in another person's session.")
                       .With("policy", {"yoked"}));
  return fields;
}

void CheckMethod(Fields& fields, Method& method) {
  const Node& node = fields.node();
  if (method.knows_truth != method.policy.policy->asks_truth) {
    const Node* named = node.Find(method.knows_truth ? "oracle" : "policy");
    fields.Complain(named->place,
                    "policy 'oracle' and 'oracle: [judgement]' go together: what is told the truth "
                    "competes with none");
  }
  if (method.partner->takes_moments) {
    fields.Complain(node.Find("partner")->place, "a yoked session cannot be another's partner");
  }
  if (method.seat == Seat::kPolicy && node.Find("policy") != nullptr) {
    fields.Complain(node.Find("policy")->place, "'policy' is what the program in that seat does");
  }
  if (method.seat == Seat::kRecogniser && node.Find("recogniser") != nullptr) {
    fields.Complain(node.Find("recogniser")->place, "'recogniser' is what the program in that seat does");
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
    std::vector<std::pair<std::string, std::string>> songs;
    for (const std::string& song : BuiltinSongNames()) songs.emplace_back(song, song);
    std::vector<Key> fields = {
        Key::Name("song", &Condition::song, songs, "What is danced; it begins anew when it is over."),
        Key::Number("session_s", &Condition::session_s, {10, 1800}, "How long a session lasts.").Unit("seconds"),
        Key::Name("learning", Path(&Condition::learner, &LearnerOptions::law), LearningLawNames(), FindLearningLaw,
                  "The law by which the learner learns and forgets."),
        Key::Number(
            "guidance", Path(&Condition::learner, &LearnerOptions::guidance), kShare,
            "How much frequent feedback costs: 0 nothing; at 1 what is taught after every performance does not last."),
        Key::Number("skill", Path(&Condition::learner, &LearnerOptions::skill), kShare, "Where every skill starts.")
            .WhenAbsent("(by the kind of people)"),
        Key::Number("severity", Path(&Condition::learner, &LearnerOptions::severity), kShare,
                    "How bad every fault is that happens: 1 is a full mistake, as bad as that fault gets.")
            .WhenAbsent("(thrown evenly from 0.35 to 1 for each)"),
        Key::Flag("gives_up", Path(&Condition::learner, &LearnerOptions::gives_up),
                  "Whether the learner's patience ends."),
        Key::Number("music_drift", Path(&Condition::music, &MusicClockOptions::drift), {-0.2, 0.2},
                    "The music plays so much faster than its clock: 0.02 is 2 %."),
        Key::Number("stutters_per_min", Path(&Condition::music, &MusicClockOptions::stutters_per_min), {0, 60},
                    "How often the music stands still."),
        Key::Number("stutter_s", Path(&Condition::music, &MusicClockOptions::stutter_s), {0, 5}, "For how long.")
            .Unit("seconds")};
    std::vector<std::string> sight = {"people",     "noise",           "turn_deg", "sensor",
                                      "distance_m", "sensor_height_m", "occluder", "threshold"};
    for (const auto& field : CameraSensingFields().fields) sight.push_back(field.info.key);
    Append(FieldsOf<Condition>(DetectionConditionFields(), &Condition::sight, Keep::kThese, sight), fields);
    fields.push_back(Key{
        {"operating_point", MappingKind("a mapping", OperatingPointFieldsOfCoach().Describe()), "(none)",
         "Sets from which evidence on a performance is right on other people, whom nobody interrupts, so that so many "
         "right performances a minute are taken for mistakes."},
        [](Fields& condition, Condition& c) {
          if (condition.Raw("operating_point") == nullptr) return;
          ReadNested(condition, "operating_point", OperatingPointFieldsOfCoach(), c.operating_point.emplace());
        }});
    return FieldTable<Condition>{std::move(fields), [](Fields& condition, Condition& c) {
                                   CheckSensorKeys(condition, c.sight);
                                   if (!c.sight.threshold || !c.operating_point) return;
                                   condition.Complain(
                                       condition.Raw("threshold")->place,
                                       "'threshold' and 'operating_point' both set thresholds; allowed: one of them");
                                 }};
  }();
  return table;
}

const FieldTable<CoachMethod>& CoachMethodFields() {
  using Key = Field<Method>;
  static const FieldTable<Method> table = [] {
    std::vector<Key> fields =
        FieldsOf<Method>(DetectionMethodFields(), &Method::sight, Keep::kOthers, {"refractory_s", "oracle"});
    fields.push_back(Key::Flags(
        "oracle", {{"stream", Path(&Method::sight, &DetectionMethod::sees_truth)}, {"judgement", &Method::knows_truth}},
        "What is replaced by the truth: the skeletons as danced instead of as sensed, or what is "
        "said of every performance (policy `oracle`)."));
    Append(PolicyFields(), fields);
    Append(FieldsOf<Method>(TransitionMethodFields(), &Method::transition, Keep::kOthers,
                            {"weights", "wait_s", "threshold"}),
           fields);
    Append(CoachFields(), fields);
    NamedValues<Seat> seats;
    for (std::size_t i = 0; i < SeatNames().size(); ++i) {
      seats.emplace_back(SeatNames()[i], static_cast<Seat>(static_cast<int>(Seat::kRecogniser) + static_cast<int>(i)));
    }
    fields.push_back(Key::Name("seat", &Method::seat, seats, "What the program of `exec` does in the loop.")
                         .WhenAbsent("(the coach is built in)")
                         .And("with `exec`"));
    return FieldTable<Method>{std::move(fields), CheckMethod};
  }();
  return table;
}

}  // namespace etude
