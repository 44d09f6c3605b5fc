#include "bench/tasks/transition/options.h"

#include <fmt/ranges.h>

#include "bench/tasks/base/fuzzy_key.h"
#include "bench/tasks/base/misplaced_keys.h"
#include "bench/tasks/base/setting_fields.h"
#include "bench/tasks/transition/stage_options.h"

namespace etude {
namespace {

// Paper A's first: it is the default.
std::vector<std::string> PickNames() { return {"first", "smallest"}; }

/// Not the Join of engine/base/names, since that is a struct here.
std::string ListOf(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

void ReadLimits(Fields& fields, CommonLimits& limits) {
  // Grades lie in [0, 1] and S sums to 8, so no distance exceeds sqrt(8 · 4).
  limits.threshold = fields.Number("threshold", limits.threshold, {0, 6});
  limits.wait_s = fields.Number("wait_s", limits.wait_s, {0, 60});
}

Result<TransitionMethod> ReadMethod(const Node& node, const CommonLimits& defaults) {
  Fields fields(node, "a method of task transition");
  TransitionMethod method;
  method.name = fields.RequiredText("name");
  const Choice& choice = *FindChoice(fields.Choice("choice", ChoiceNames(), ChoiceNames().front()));
  const Join& join = *FindJoin(fields.Choice("join", JoinNames(), JoinNames().front()));
  MatchRules& rules = method.way.rules;
  method.weights = FindWeightSource(fields.Choice("weights", WeightSourceNames(), WeightSourceNames().front()));
  CommonLimits limits = defaults;
  ReadLimits(fields, limits);
  method.wait_s = limits.wait_s;
  rules.threshold = limits.threshold;
  rules.pick = fields.Choice("pick", PickNames(), PickNames().front()) == "smallest" ? Pick::kSmallest : Pick::kFirst;
  rules.within_class = fields.Boolean("within_class", false);
  method.way.choice_settings = ReadSettings(fields, choice.settings);
  method.way.join_settings = ReadSettings(fields, join.settings);
  RefuseMisplacedKeys(fields, TransitionMethodKeys(), "choice", choice.name);
  RefuseMisplacedKeys(fields, TransitionMethodKeys(), "join", join.name);
  RETURN_IF_ERROR(fields.Finish());
  method.way.choice = &choice;
  method.way.join = &join;
  return method;
}

}  // namespace

std::vector<KeyInfo> TransitionConditionKeys() {
  std::vector<KeyInfo> keys = {
      {"threshold", "0…6", "0.4", "Two bridge frames match when their fuzzy distance is below it; for all methods."},
      {"wait_s", "0…60 (seconds)", "1",
       "How long after the request a switch may come; for all methods, those outside are told it as max_wait_s."}};
  keys.push_back(
      {"explain", "true, false", "false",
       "Whether every cell keeps the ten partial distances of its seams and its candidates, as series; filmed "
       "cells are explained in the report anyway."});
  for (KeyInfo& key : StageKeys()) keys.push_back(std::move(key));
  keys.push_back(FuzzyKey());
  return keys;
}

std::vector<KeyInfo> TransitionMethodKeys() {
  KeyCondition fuzzy{"choice", {}};
  for (const Choice& choice : AllChoices()) {
    if (choice.uses_fuzzy) fuzzy.values.push_back(choice.name);
  }
  std::vector<KeyInfo> keys = {
      {"choice", ListOf(ChoiceNames()), ChoiceNames().front(),
       "Which frames are switched, and when: paper A's bridge frames, or what one would use otherwise."},
      {"join", ListOf(JoinNames()), JoinNames().front(),
       "How the clips are put together: the next frame is the new clip's, or what was off dies away smoothly."},
      {"weights", ListOf(WeightSourceNames()), WeightSourceNames().front(),
       "How much each fuzzy feature counts: as the fuzzy system says, or learnt on all clips but the two judged, by "
       "a logistic regression or a genetic algorithm."},
      {"threshold", "0…6", "(the scenario's)", "The distance below which two frames match.", fuzzy},
      {"within_class", "true, false", "false", "Whether only frames with the same ten tags are compared.", fuzzy},
      {"pick",
       ListOf(PickNames()),
       PickNames().front(),
       "Which of several matching pairs is taken.",
       {"choice", {"fuzzy-bridge"}}},
      {"wait_s", "0…60 (seconds)", "(the scenario's)", "How long after the request a switch may come."}};
  for (KeyInfo& key : SettingKeys("choice", AllChoices())) keys.push_back(std::move(key));
  for (KeyInfo& key : SettingKeys("join", AllJoins())) keys.push_back(std::move(key));
  return keys;
}

CommonLimits ReadCommonLimits(Fields& condition) {
  CommonLimits common;
  ReadLimits(condition, common);
  return common;
}

bool ReadExplain(Fields& condition) { return condition.Boolean("explain", false); }

Result<std::vector<TransitionMethod>> ReadTransitionMethods(const CommonLimits& common, std::span<const Node> methods) {
  std::vector<TransitionMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node, common));
    read.push_back(std::move(method));
  }
  return read;
}

}  // namespace etude
