#include "reports/words/sentence.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/words/beyond.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

std::string Amount(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + words.difference_suffix;
}

// "58 of 60 worlds", or a share when ties (which count half) leave no whole number.
std::string WorldsWon(double share, int pairs) {
  const double won = share * pairs;
  if (std::abs(won - std::round(won)) < 1e-6) {
    return fmt::format("{} of {}", FormatCount(std::llround(won)), Plural(pairs, "world"));
  }
  return fmt::format("{:.0f} % of {}", 100 * share, Plural(pairs, "world"));
}

std::string_view VerbFor(double difference, const MetricWords& words) {
  if (words.direction == Direction::kNeither) return "changes";
  return difference < 0 ? "lowers" : "raises";
}

std::string_view ChangeWords(const MetricWords& words) { return words.by_mean ? "mean change" : "median change"; }

std::string ClearSentence(const Comparison& c, const std::string& other, const MetricWords& words) {
  const double difference = *c.difference;
  const bool worse = c.verdict == Verdict::kWorse;
  const std::string worlds = WorldsWon(worse ? 1 - c.share_better : c.share_better, c.pairs);
  if (difference == 0) {
    return fmt::format("“{}” has the {} {} than {} on {}, with equal halves on the others — {}", c.method,
                       worse ? "worse" : "better", words.label, other, worlds, VerdictName(c.verdict));
  }
  // "Lowers by 12.3 (10.1–14.0)": the verb carries the sign, so the interval is turned with it.
  std::optional<double> low = c.ci_low, high = c.ci_high;
  if (difference < 0 && low && high) {
    low = -*c.ci_high;
    high = -*c.ci_low;
  }
  return fmt::format("“{}” {} the {} by {} (95 % CI {}) compared with {}, on {} — {}", c.method,
                     VerbFor(difference, words), words.label, Amount(std::abs(difference), words),
                     FormatInterval(low, high, words), other, worlds, VerdictName(c.verdict));
}

/// Without its end: on which worlds, and why it is open.
std::string SentenceFor(const Comparison& c, const std::string& other, const MetricWords& words) {
  if (c.pairs == 0 || !c.difference) {
    return fmt::format("“{}” could not be compared with {} by {}: no world gave both a value — inconclusive",
                       c.method, other, words.label);
  }
  if (!c.ci_low) {
    return fmt::format("“{}” and {} met in {} only: too few to judge the {} — inconclusive", c.method, other,
                       Plural(c.pairs, "world"), words.label);
  }
  const std::string figures =
      fmt::format("{} {} (95 % CI {}) on {}", ChangeWords(words), Amount(*c.difference, words),
                  FormatInterval(c.ci_low, c.ci_high, words), Plural(c.pairs, "world"));
  switch (c.verdict) {
    case Verdict::kBetter:
    case Verdict::kWorse:
      return ClearSentence(c, other, words);
    case Verdict::kNoDifference:
      return fmt::format("“{}” makes no difference that matters to the {} compared with {}: {} — no difference",
                         c.method, words.label, other, figures);
    case Verdict::kInconclusive:
      break;
  }
  return fmt::format("It is open whether “{}” changes the {} compared with {}: {} — inconclusive", c.method,
                     words.label, other, figures);
}

// ": median change 5.1° (noise=5) to 12.3° (noise=20)"
std::string RangeOfChanges(const std::vector<Judged>& judged, const MetricWords& words) {
  std::vector<Judged> known;
  std::ranges::copy_if(judged, std::back_inserter(known),
                       [](const Judged& j) { return j.comparison->difference.has_value(); });
  if (known.empty()) return "";
  const auto [smallest, largest] =
      std::ranges::minmax_element(known, {}, [](const Judged& j) { return std::abs(*j.comparison->difference); });
  const auto end = [&](const Judged& j) {
    return fmt::format("{} ({})", Amount(*j.comparison->difference, words), ConditionLabel(j.condition->condition));
  };
  return fmt::format(": {} {} to {}", ChangeWords(words), end(*smallest), end(*largest));
}

// All conditions agree that it is better, or worse: "lowers the error under both conditions".
std::string ClearSentenceOverConditions(const std::vector<Judged>& judged, const MetricWords& words) {
  const Comparison& first = *judged.front().comparison;
  return fmt::format("“{}” {} the {} compared with {} under {}{} — {}", first.method,
                     VerbFor(*first.difference, words), words.label, OthersOf(judged), AllConditions(judged.size()), RangeOfChanges(judged, words),
                     VerdictName(first.verdict));
}

std::string SentenceOverConditions(const std::vector<Judged>& judged, const MetricWords& words) {
  const Comparison& first = *judged.front().comparison;
  const auto verdict = CommonVerdict(judged);
  if (verdict == Verdict::kBetter || verdict == Verdict::kWorse) return ClearSentenceOverConditions(judged, words);
  return fmt::format("“{}” compared with {} by {} is {}{}", first.method, OthersOf(judged), words.label,
                     CountVerdicts(VerdictsOf(judged), judged.size()), RangeOfChanges(judged, words));
}

// A method that fails in hard worlds must not look better for being judged on the easy ones alone.
std::string UnpairedWords(const std::vector<Judged>& judged) {
  int only_baseline = 0, only_method = 0;
  for (const Judged& j : judged) {
    only_baseline += j.comparison->only_baseline;
    only_method += j.comparison->only_method;
  }
  const Comparison& first = *judged.front().comparison;
  std::string text;
  const auto add = [&](const std::string& name, int worlds) {
    if (worlds > 0) text += fmt::format("{}only {} in {}", text.empty() ? "" : ", ", name, Plural(worlds, "world"));
  };
  add(OthersOf(judged), only_baseline);
  add(fmt::format("“{}”", first.method), only_method);
  return text.empty() ? "" : fmt::format(" Not in this difference, since one of the two has no value there: {}.", text);
}

}  // namespace

std::string SentenceOf(const std::vector<Judged>& judged, SamplingUnit unit) {
  const Comparison& first = *judged.front().comparison;
  const MetricWords words = WordsFor(first.metric);
  const bool swept = judged.size() > 1;
  const std::string sentence = swept ? SentenceOverConditions(judged, words) : SentenceFor(first, OthersOf(judged), words);
  const bool is_open = !swept && first.verdict == Verdict::kInconclusive && first.pairs > 0;
  const std::string why = is_open && !first.why_open.empty() ? ": " + first.why_open : "";
  std::string beyond = BeyondInWords(judged, unit).words;
  beyond.front() = beyond.front() == 'o' ? 'O' : 'F';
  return fmt::format("{} on {}{}. {}.{}", sentence, TheseUnits(unit), why, beyond, UnpairedWords(judged));
}

}  // namespace etude
