#include "bench/tasks/transition/stage_options.h"

#include "engine/base/angles.h"

namespace etude {

StageRules ReadStageRules(Fields& condition, const FuzzySystem& fuzzy) {
  StageRules rules;
  rules.fuzzy = fuzzy;
  const auto read_degrees = [&](const char* key, Range range, double& radians) {
    if (const auto degrees = condition.OptionalNumber(key, range)) radians = Radians(*degrees);
  };
  rules.asks_for_acts = condition.Choice("asked_for", {"any", "acts"}, "any") == "acts";
  rules.min_clips = condition.Integer("min_clips", rules.min_clips, {1, 1000});
  rules.most_per_class = condition.Integer("most_per_class", rules.most_per_class, {0, 100000});
  read_degrees("head_bend_deg", {0, 180}, rules.head.max_bend);
  read_degrees("head_turn_dps", {0, 10000}, rules.head.max_turn_speed);
  read_degrees("tween_dps", {10, 10000}, rules.tween.turn_speed);
  rules.tween.shortest_s = condition.Number("tween_s", rules.tween.shortest_s, {0, 10});
  read_degrees("tween_deg", {0, 180}, rules.tween.widest_turn);
  return rules;
}

std::vector<KeyInfo> StageKeys() {
  return {{"asked_for", "any, acts", "any",
           "Which clips are asked for: any other one, or, while the other clips play, the coach's acts, where there "
           "are any."},
          {"min_clips", "1…1000", "2", "In how many clips a bridge frame's ten tags occur together at least."},
          {"most_per_class", "0…100000", "0",
           "Of each clip's frames with the same ten tags, only so many are bridge frames: those most alike to other "
           "clips'; 0: all."},
          {"head_bend_deg", "0…180", "30", "A bridge frame's neck is bent by no more."},
          {"head_turn_dps", "0…10000 (degrees per second)", "60", "A bridge frame's neck turns no faster."},
          {"tween_dps", "10…10000 (degrees per second)", "360", "The fastest that any limb turns in an in-between."},
          {"tween_s", "0…10 (seconds)", "0.3", "An in-between takes at least this, however little there is to do."},
          {"tween_deg", "0…180", "120",
           "An in-between that would turn a limb by more goes by way of the most frequent pose."}};
}

}  // namespace etude
