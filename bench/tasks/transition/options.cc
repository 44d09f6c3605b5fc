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
                   "Two bridge frames match if their fuzzy distance is below this threshold. It applies to all methods "
                   "that do not set their own threshold."),
       Key::Number("wait_s", &Options::wait_s, kWaits_s,
                   "Maximum time from the request to the transition. It applies to all methods that do not set their "
                   "own limit. Outside methods get this value as max_wait_s.")
           .Unit("seconds"),
       Key::Flag("explain", &Options::explain,
                 "true: every cell keeps the ten partial distances of its transition points and candidates as series. "
                 "With false, the report explains only cells that have films."),
       // Keys of the rules by which the library is prepared.
       Key::Name("asked_for", Path(&Options::stage, &StageRules::asks_for_acts), {{"any", false}, {"acts", true}},
                 "The clips that may be requested while another clip plays. any: any clip; acts: one of the coach's "
                 "acts, if the library has acts."),
       Key::Number("min_clips", Path(&Options::stage, &StageRules::min_clips), {1, 1000},
                   "A frame is a bridge frame only if its ten tags occur together in at least this number of clips."),
       Key::Number("most_per_class", Path(&Options::stage, &StageRules::most_per_class), {0, 100000},
                   "Maximum number of bridge frames for each clip and each set of ten tags. The frames that are most "
                   "similar to frames of other clips are kept. 0 keeps all frames."),
       Key::Angle("head_bend_deg", Path(&Options::stage, &StageRules::head, &HeadRule::max_bend), {0, 180},
                  "Largest allowed bend of the neck in a bridge frame."),
       Key::Angle("head_turn_dps", Path(&Options::stage, &StageRules::head, &HeadRule::max_turn_speed), {0, 10000},
                  "Largest allowed turning speed of the neck in a bridge frame.")
           .Unit("degrees per second"),
       Key::Number("tween_s", Path(&Options::stage, &StageRules::tween, &TweenRules::shortest_s), {0, 10},
                   "Minimum length of an in-between clip.")
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
                   "The rule that chooses the frames and the time of a transition: paper A's bridge frames, or an "
                   "alternative."),
         Key::Name(
             "join", Path(&TransitionMethod::way, &TransitionWay::join), JoinNames(), FindJoin,
             "How the two clips are joined: by a cut, or by a smooth change from the old motion to the new motion."),
         Key::Name("weights", &TransitionMethod::weights, WeightSourceNames(), FindWeightSource,
                   "Weights of the fuzzy features: the weights of the fuzzy system, or weights that are learnt on all "
                   "clips except the two judged clips, by logistic regression or by a genetic algorithm."),
         Key::Number("threshold", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::threshold),
                     kThresholds, "Two frames match if their fuzzy distance is below this threshold.")
             .WhenAbsent("(the scenario's)")
             .With("choice", FuzzyChoices()),
         Key::Flag("within_class", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::within_class),
                   "true: only frames with the same ten tags are compared.")
             .With("choice", FuzzyChoices()),
         Key::Name("pick", Path(&TransitionMethod::way, &TransitionWay::rules, &MatchRules::pick),
                   {{"first", Pick::kFirst}, {"smallest", Pick::kSmallest}},
                   "The pair of frames that is taken if several pairs match.")
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
