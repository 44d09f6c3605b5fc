#include "engine/coaching/policy.h"

#include <fmt/format.h>

#include "engine/base/named.h"

namespace etude {
namespace {

using Values = std::span<const double>;

/// Options of `after-n`: after this number of consecutive mistakes in a move, the coach corrects it.
struct AfterOptions {
  int mistakes = 2;
};
const SettingTable<AfterOptions>& AfterSettings() {
  static const SettingTable<AfterOptions> table({
      {"mistakes", &AfterOptions::mistakes, 1, 100,
       "Number of successive mistakes in one move after which the coach corrects the player."},
  });
  return table;
}

struct ConfidenceOptions {
  double sure_below = 0.5;
};
const SettingTable<ConfidenceOptions>& ConfidenceSettings() {
  static const SettingTable<ConfidenceOptions> table({
      {"sure_below", &ConfidenceOptions::sure_below, 0, 1,
       "The coach corrects the player if the evidence is below this fraction of the evidence that counts as right."},
  });
  return table;
}

struct FadingOptions {
  double mistakes_per_correction = 1;
};
const SettingTable<FadingOptions>& FadingSettings() {
  static const SettingTable<FadingOptions> table({
      {"mistakes_per_correction", &FadingOptions::mistakes_per_correction, 0, 10,
       "Number of further successive mistakes that the coach tolerates for each earlier correction of the same move."},
  });
  return table;
}

PolicyDecision AfterMistakes(const PolicyInput& input, int wanted) {
  if (input.verdict != WindowVerdict::kWrong) return {false, "no mistake"};
  const int found = input.move.mistakes_in_row;
  return {found >= wanted,
          fmt::format("{} successive mistakes in this move; the coach corrects after {}", found, wanted)};
}

PolicyDecision Never(const PolicyInput& /*input*/, Values /*values*/) { return {false, "never corrects"}; }

PolicyDecision AtFirst(const PolicyInput& input, Values /*values*/) { return AfterMistakes(input, 1); }

PolicyDecision AfterN(const PolicyInput& input, Values values) {
  return AfterMistakes(input, AfterSettings().Apply(values).mistakes);
}

PolicyDecision Confident(const PolicyInput& input, Values values) {
  if (input.verdict != WindowVerdict::kWrong) return {false, "no mistake"};
  const double sure = ConfidenceSettings().Apply(values).sure_below * input.right_from;
  return {input.evidence < sure || input.evidence == 0,
          fmt::format("the evidence for a right move is {:.2f}; a mistake counts as certain below {:.2f}",
                      input.evidence, sure)};
}

PolicyDecision Fading(const PolicyInput& input, Values values) {
  const double more = FadingSettings().Apply(values).mistakes_per_correction * input.move.corrections;
  return AfterMistakes(input, 1 + static_cast<int>(more));
}

PolicyDecision AtMoments(const PolicyInput& /*input*/, Values /*values*/) {
  return {false, "the coach corrects only at given moments"};
}

}  // namespace

std::span<const Policy> AllPolicies() {
  // The policies that need only the recogniser's evidence, then the two for experiments: `oracle` and `yoked`.
  static const std::vector<Policy> policies = {
      {.name = "at-first-mistake", .description = "corrects every mistake (paper A)", .decide = AtFirst},
      {.name = "never", .description = "never corrects the player; the dance always continues", .decide = Never},
      {.name = "after-n",
       .description = "corrects after several successive mistakes in one move",
       .settings = AfterSettings().Describe(),
       .decide = AfterN},
      {.name = "confidence",
       .description = "corrects only if the recogniser is certain of a mistake",
       .settings = ConfidenceSettings().Describe(),
       .decide = Confident},
      {.name = "fading",
       .description = "corrects less and less often: each correction of a move raises the number of mistakes that the "
                      "next correction needs",
       .settings = FadingSettings().Describe(),
       .decide = Fading},
      {.name = "oracle",
       .description = "knows which performances are right, and corrects every mistake and nothing else",
       .asks_truth = true,
       .decide = AtFirst},
      {.name = "yoked",
       .description = "control for the timing of corrections: corrects at the times at which another person's session "
                      "was corrected, whatever the player does",
       .takes_moments = true,
       .decide = AtMoments},
  };
  return policies;
}

std::vector<std::string> PolicyNames() { return NamesOf(AllPolicies()); }

std::vector<std::string> LivePolicyNames() {
  std::vector<std::string> names;
  for (const Policy& policy : AllPolicies()) {
    if (!policy.asks_truth && !policy.takes_moments) names.push_back(policy.name);
  }
  return names;
}

const Policy* FindPolicy(std::string_view name) { return FindByName(AllPolicies(), name); }

}  // namespace etude
