#include "bench/tasks/transition/options.h"

#include "bench/keys/field_table.h"
#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

// Grades are in [0, 1], a feature has at most 4 terms, and the features' weights have sum 8 (S, paper A, equation 1),
// so no distance exceeds sqrt(8 · 4).
constexpr Range kThresholds{0, 6};
constexpr Range kWaits_s{0, 60};

std::vector<std::string> FuzzyChoices() {
  std::vector<std::string> names;
  for (const Choice& choice : AllChoices()) {
    if (choice.uses_fuzzy) names.push_back(choice.name);
  }
  return names;
}

}  // namespace

TransitionWay DefaultWay() {
  TransitionWay way;
  way.choice = &AllChoices().front();
  way.join = &AllJoins().front();
  return way;
}

const FieldTable<TransitionCondition>& TransitionConditionFields() {
  using Options = TransitionCondition;
  using Key = Field<Options>;
  // The settings that all methods share come first.
  static const FieldTable<Options> table{
      {Key::Number("threshold", &Options::threshold, kThresholds,
                   "Fuzzy distance below which two bridge frames match; for all methods."),
       Key::Number(
           "wait_s", &Options::wait_s, kWaits_s,
           "Maximum time from the request to the transition; for all methods (outside methods get it as max_wait_s).")
           .Unit("seconds"),
       Key::Flag("explain", &Options::explain,
                 "Whether every cell keeps the ten partial distances of its transition points and candidates as "
                 "series; the report always explains cells that have films."),
       // Keys of the rules by which the library is prepared.
       Key::Name("asked_for", Path(&Options::stage, &StageRules::asks_for_acts), {{"any", false}, {"acts", true}},
                 "Which clips are requested while another clip plays: any clip, or one of the coach's acts if the library "
                 "has acts."),
       Key::Number("min_clips", Path(&Options::stage, &StageRules::min_clips), {1, 1000},
                   "Minimum number of clips in which a bridge frame's ten tags must occur together."),
       Key::Number("most_per_class", Path(&Options::stage, &StageRules::most_per_class), {0, 100000},
                   "Maximum number of bridge frames per clip and set of ten tags; those most like other clips' frames "
                   "are kept; 0: all."),
       Key::Angle("head_bend_deg", Path(&Options::stage, &StageRules::head, &HeadRule::max_bend), {0, 180},
                  "Largest bend of the neck in a bridge frame."),
       Key::Angle("head_turn_dps", Path(&Options::stage, &StageRules::head, &HeadRule::max_turn_speed), {0, 10000},
                  "Fastest turn of the neck in a bridge frame.")
           .Unit("degrees per second"),
       Key::Number("tween_s", Path(&Options::stage, &StageRules::tween, &TweenRules::shortest_s), {0, 10},
                   "Minimum length of an in-between.")
           .Unit("seconds"),
       FuzzyField<Options>()}};
  return table;
}

const FieldTable<TransitionMethod>& TransitionMethodFields() {
  using Key = Field<TransitionMethod>;
  static const FieldTable<TransitionMethod> table = [] {
    // Keys of the choice, the join, the weights, the matching rules and the wait.
    FieldTable<TransitionMethod> made{
        {Key::Name("choice", Path(&TransitionMethod::way, &TransitionWay::choice), ChoiceNames(), FindChoice,
                   "Which frames a transition takes, and when: paper A's bridge frames, or an alternative."),
         Key::Name("join", Path(&TransitionMethod::way, &TransitionWay::join), JoinNames(), FindJoin,
                   "The join of two clips: a cut, or a smooth change from the old motion to the new one."),
         Key::Name("weights", &TransitionMethod::weights, WeightSourceNames(), FindWeightSource,
                   "Weights of the fuzzy features: the fuzzy system's, or learnt on all clips but the two judged, by "
                   "logistic regression or a genetic algorithm."),
         Key::Number("threshold", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::threshold),
                     kThresholds, "The distance below which two frames match.")
             .WhenAbsent("(the scenario's)")
             .With("choice", FuzzyChoices()),
         Key::Flag("within_class", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::within_class),
                   "Whether only frames with the same ten tags are compared.")
             .With("choice", FuzzyChoices()),
         Key::Name("pick", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::pick),
                   {{"first", Pick::kFirst}, {"smallest", Pick::kSmallest}},
                   "Which of several matching pairs is taken.")
             .With("choice", {"fuzzy-bridge"}),
         Key::Number("wait_s", &TransitionMethod::wait_s, kWaits_s, "Maximum time from the request to the transition.")
             .Unit("seconds")
             .WhenAbsent("(the scenario's)")}};
    // Add the settings of each choice and each join.
    for (const Key& key : SettingFields<TransitionMethod>(
             "choice", AllChoices(), Path(&TransitionMethod::way, &TransitionWay::choice_settings))) {
      made.fields.push_back(key);
    }
    for (const Key& key : SettingFields<TransitionMethod>(
             "join", AllJoins(), Path(&TransitionMethod::way, &TransitionWay::join_settings))) {
      made.fields.push_back(key);
    }
    return made;
  }();
  return table;
}

}  // namespace etude
