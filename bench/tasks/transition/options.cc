#include "bench/tasks/transition/options.h"

#include <fmt/ranges.h>

#include <array>

namespace etude {
namespace {

template <typename T, std::size_t N>
std::vector<std::string> NamesOf(const std::array<std::pair<const char*, T>, N>& known) {
  std::vector<std::string> names;
  for (const auto& [name, value] : known) names.emplace_back(name);
  return names;
}

template <typename T, std::size_t N>
T ValueNamed(std::string_view chosen, const std::array<std::pair<const char*, T>, N>& known) {
  for (const auto& [name, value] : known) {
    if (chosen == name) return value;
  }
  return known.front().second;
}

template <typename T, std::size_t N>
T ReadChoice(Fields& fields, std::string_view key, const std::array<std::pair<const char*, T>, N>& known) {
  const std::vector<std::string> names = NamesOf(known);
  return ValueNamed(fields.Choice(key, names, names.front()), known);  // a complaint is kept in `fields`
}

template <typename T, std::size_t N>
std::string ListOf(const std::array<std::pair<const char*, T>, N>& known) {
  return fmt::format("{}", fmt::join(NamesOf(known), ", "));
}

// The first of each is the default: paper A's method.
constexpr std::array<std::pair<const char*, bool>, 2> kWeights = {{{"fixed", false}, {"adaptive", true}}};
constexpr std::array<std::pair<const char*, Pick>, 2> kPicks = {
    {{"first", Pick::kFirst}, {"smallest", Pick::kSmallest}}};

void ReadLimits(Fields& fields, CommonLimits& limits) {
  // Grades lie in [0, 1] and S sums to 8, so no distance exceeds sqrt(8 · 4).
  limits.threshold = fields.Number("threshold", limits.threshold, {0, 6});
  limits.wait_s = fields.Number("wait_s", limits.wait_s, {0, 60});
}

Result<TransitionMethod> ReadMethod(const Node& node, const CommonLimits& defaults) {
  Fields fields(node, "a method of task transition");
  TransitionMethod method;
  method.name = fields.RequiredText("name");
  method.way.choice = FindChoice(fields.Choice("choice", ChoiceNames(), ChoiceNames().front()));
  method.way.join = FindJoin(fields.Choice("join", JoinNames(), JoinNames().front()));
  method.adaptive_weights = ReadChoice(fields, "weights", kWeights);
  CommonLimits limits = defaults;
  ReadLimits(fields, limits);
  method.wait_s = limits.wait_s;
  method.way.rules.threshold = limits.threshold;
  method.way.rules.pick = ReadChoice(fields, "pick", kPicks);
  method.way.rules.within_class = fields.Boolean("within_class", false);
  if (auto ok = fields.Finish(); !ok) return tl::unexpected(ok.error());
  return method;
}

}  // namespace

std::vector<KeyInfo> TransitionConditionKeys() {
  return {
      {"threshold", "0…6", "0.4", "Two bridge frames match when their fuzzy distance is below it; for all methods."},
      {"wait_s", "0…60 (seconds)", "1",
       "How long after the request a switch may come; for all methods, those outside are told it as max_wait_s."}};
}

std::vector<KeyInfo> TransitionMethodKeys() {
  return {{"choice", fmt::format("{}", fmt::join(ChoiceNames(), ", ")), ChoiceNames().front(),
           "Which frames are switched: paper A's matching bridge frames, at once, or after the clip's last frame."},
          {"join", fmt::format("{}", fmt::join(JoinNames(), ", ")), JoinNames().front(),
           "How the clips are put together: the next frame is the new clip's, or what was off dies away smoothly."},
          {"weights", ListOf(kWeights), kWeights.front().first,
           "How much each fuzzy feature counts: as paper A says, or as learnt on all clips but the two judged."},
          {"pick", ListOf(kPicks), kPicks.front().first, "Which of several matching pairs is taken."},
          {"within_class", "true, false", "false", "Whether only frames with the same ten tags are compared."},
          {"threshold", "0…6", "(the scenario's)", "The distance below which two bridge frames match."},
          {"wait_s", "0…60 (seconds)", "(the scenario's)", "How long after the request a switch may come."}};
}

CommonLimits ReadCommonLimits(Fields& condition) {
  CommonLimits common;
  ReadLimits(condition, common);
  return common;
}

Result<std::vector<TransitionMethod>> ReadTransitionMethods(const CommonLimits& common, std::span<const Node> methods) {
  std::vector<TransitionMethod> read;
  for (const Node& node : methods) {
    auto method = ReadMethod(node, common);
    if (!method) return tl::unexpected(method.error());
    read.push_back(*std::move(method));
  }
  return read;
}

}  // namespace etude
