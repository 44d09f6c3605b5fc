#include "bench/statistics/answers.h"

#include <algorithm>
#include <cstddef>

#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/compare.h"
#include "bench/statistics/distributions.h"
#include "bench/statistics/judging.h"
#include "bench/statistics/paired_tests.h"
#include "bench/statistics/summary.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns the size of a family of answers, whose p-values are corrected together: the number of answers that compare a
/// method with its baseline. The family of comparisons with rivals has about the same size.
int CountAnswers(const Study& study) {
  const auto compared =
      std::ranges::count_if(study.methods, [](const ComparedMethod& method) { return method.name != method.against; });
  return static_cast<int>(compared) * static_cast<int>(study.conditions.size());
}

bool IsDecided(Verdict verdict) { return verdict == Verdict::kBetter || verdict == Verdict::kWorse; }

/// Returns the metric by which a step of an answer is judged. The metric is a share of worlds; its practical threshold
/// is `matters`.
MetricInfo ShareMetric(const std::string& id, double matters) {
  MetricInfo metric = *FindMetric(id);
  metric.direction = Direction::kHigherIsBetter;
  metric.aggregate = Aggregate::kMean;
  metric.reading = metric.reading == Reading::kAmount ? Reading::kYesNo : metric.reading;  // the tail is always a share
  metric.practical = matters;
  return metric;
}

MetricInfo SuccessMetric(const Study& study) { return ShareMetric(study.success, study.success_matters); }
/// `value` is the metric of which the worlds are far better or worse.
MetricInfo TailMetric(const Study& study, const std::string& value) {
  return ShareMetric(value, study.gate.tail.share);
}

/// Returns a cell's success: its value, or 0 if the cell failed without a value. Returns nullopt if the cell was
/// skipped, or if its status is ok but it has no value.
std::optional<double> SuccessAt(const MethodColumns& method, const std::string& success, int trial) {
  const Status status = method.StatusAt(trial).value_or(Status::kSkipped);
  if (status == Status::kSkipped) return std::nullopt;
  if (const auto value = method.ValueAt(success, trial)) return value;
  return status == Status::kOk ? std::nullopt : std::optional(0.0);
}

/// A method and the other method with which it is compared in each trial. The other method may change between trials,
/// because the two halves of the worlds may have different rivals (FindRival).
struct Pairing {
  const MethodColumns* method;
  std::vector<const MethodColumns*> other;  ///< the other method in each trial
};

PairedWorlds SuccessesOf(const Pairing& pairing, const std::string& success) {
  PairedWorlds worlds;
  for (std::size_t i = 0; i < pairing.other.size(); ++i) {
    const int trial = static_cast<int>(i);
    const auto theirs = SuccessAt(*pairing.other[i], success, trial), mine = SuccessAt(*pairing.method, success, trial);
    if (!theirs || !mine) continue;
    worlds.pairs.push_back({*theirs, *mine});
    worlds.trials.push_back(trial);
  }
  return worlds;
}

/// Returns one pair for each world: the pair's difference is −1 if the method's value is far worse, 1 if it is far
/// better, and else 0.
PairedWorlds FarOff(const PairedWorlds& values, const MetricInfo& metric, double times) {
  PairedWorlds far = values;
  const double sign = metric.direction == Direction::kLowerIsBetter ? -1 : 1;
  for (Pair& pair : far.pairs) {
    const double gain = sign * (pair.method - pair.baseline), limit = times * metric.practical;
    pair = {gain < -limit ? 1.0 : 0.0, gain > limit ? 1.0 : 0.0};
  }
  return far;
}

/// Measures the answers of one condition.
class Measurer {
 public:
  Measurer(const Study& study, const ConditionTable& table, std::uint64_t seed)
      : study_(study), table_(table), seed_(seed) {}

  /// `other` is the name of the other method.
  Answer Measure(const Pairing& pairing, const PairedWorlds& values, const std::string& other) const {
    Answer answer = MeasureSteps(pairing, values);
    answer.baseline = other;
    for (std::optional<Comparison>* step : {&answer.success, &answer.both_succeed, &answer.tail}) {
      if (!*step) continue;
      (*step)->method = answer.method;
      (*step)->baseline = other;
    }
    return answer;
  }

 private:
  Comparison Compare(const PairedWorlds& worlds, const MetricInfo& metric, const std::string& purpose) const {
    Comparison found = ComparePaired(worlds.pairs, metric, seed_, purpose);
    if (!worlds.pairs.empty() && metric.aggregate == Aggregate::kMean && AreShares(worlds.pairs, metric)) {
      const auto count = [&](double sign) {
        return static_cast<int>(std::ranges::count_if(
            worlds.pairs, [&](const Pair& pair) { return sign * (pair.method - pair.baseline) > 0; }));
      };
      found.sign_flip = {McNemarMidP(count(1), count(-1)), kMidP};
    }
    if (!WorldsAreUnits(study_.unit))
      found.beyond = MeasureBeyond(UnitsOf(worlds, table_, metric), CountAnswers(study_));
    found.not_alike = found.beyond.not_alike = worlds.not_alike;
    return found;
  }

  Answer MeasureSteps(const Pairing& pairing, const PairedWorlds& values) const {
    const std::string method = pairing.method->name(), value = ValueMetricOf(study_);
    const auto purpose = [&](const std::string& step) { return PurposeOf(study_.scenario, table_.condition, step); };
    Answer answer{.method = method, .value_metric = value};
    // Compare success; a failed cell counts 0.
    const PairedWorlds successes = study_.success.empty() ? PairedWorlds() : SuccessesOf(pairing, study_.success);
    if (!successes.pairs.empty()) {
      answer.success = Compare(successes, SuccessMetric(study_), purpose("success"));
    }
    if (value.empty()) return answer;
    // Compare the value in the worlds in which both methods succeeded.
    if (!successes.pairs.empty() && AreShares(successes.pairs, SuccessMetric(study_))) {
      PairedWorlds both;
      both.not_alike = values.not_alike;
      for (std::size_t i = 0; i < values.pairs.size(); ++i) {
        const auto at = std::ranges::lower_bound(successes.trials, values.trials[i]);
        if (at == successes.trials.end() || *at != values.trials[i]) continue;
        const Pair& succeeded = successes.pairs[static_cast<std::size_t>(at - successes.trials.begin())];
        if (succeeded.baseline == 0 || succeeded.method == 0) continue;
        both.pairs.push_back(values.pairs[i]);
        both.trials.push_back(values.trials[i]);
      }
      if (!both.pairs.empty() && both.pairs.size() < values.pairs.size()) {
        answer.both_succeed = Compare(both, *FindMetric(value), purpose("both succeed"));
      }
    }
    // Compare the tail: the worlds in which the value is far better or far worse. Only amounts have a tail. A yes-or-no
    // value has no tail, because all its differences have the same size.
    const MetricInfo& metric = *FindMetric(value);
    if (!values.pairs.empty() && metric.direction != Direction::kNeither && metric.reading == Reading::kAmount) {
      const PairedWorlds far = FarOff(values, metric, study_.gate.tail.times);
      answer.tail = Compare(far, TailMetric(study_, value), purpose("tail"));
    }
    return answer;
  }

  const Study& study_;
  const ConditionTable& table_;
  const std::uint64_t seed_;
};

/// Corrects the p-values of one step of the comparisons (success, value or tail) over a family of answers (Holm), and
/// sets the verdicts of this step. `metric_of(answer)` returns the metric of this step; the verdict depends on the
/// metric's practical threshold.
template <typename MetricOf>
void JudgeStep(const std::vector<Answer*>& family, std::optional<Comparison> Answer::*step, SamplingUnit unit,
               const MetricOf& metric_of) {
  std::vector<std::optional<double>> p_here, p_beyond;
  std::vector<Comparison*> judged;
  for (Answer* answer : family) {
    if (!(answer->*step)) continue;
    judged.push_back(&*(answer->*step));
    p_here.push_back(DecidingP(*judged.back(), metric_of(*answer)));
    p_beyond.push_back(judged.back()->beyond.test.p);
  }
  const auto here = HolmCorrected(p_here), beyond = HolmCorrected(p_beyond);
  std::size_t i = 0;
  for (Answer* answer : family) {
    if (!(answer->*step)) continue;
    const MetricInfo metric = metric_of(*answer);
    Comparison& comparison = *judged[i];
    comparison.p_holm = here[i];
    comparison.verdict = VerdictOf(comparison, metric);
    const int comparisons = static_cast<int>(judged.size());
    comparison.why_open = WhyOpen(comparison, metric, comparisons, unit);
    comparison.beyond.p_holm = beyond[i++];
    comparison.beyond.verdict =
        WorldsAreUnits(unit) ? std::optional(comparison.verdict) : VerdictBeyond(comparison.beyond, metric);
    comparison.beyond.why_open =
        WorldsAreUnits(unit) ? comparison.why_open : WhyOpenBeyond(comparison.beyond, metric, unit, comparisons);
  }
}

/// Decides an answer from its judged steps and from the comparison of the value over all worlds (`value`, may be null).
void Decide(Answer& answer, const Comparison* value) {
  const auto decide = [&](AnswerStep step, Verdict verdict, std::optional<Verdict> beyond) {
    answer.decided_by = step;
    answer.verdict = verdict;
    answer.beyond = beyond;
  };
  if (answer.success && IsDecided(answer.success->verdict)) {
    return decide(AnswerStep::kSuccess, answer.success->verdict, answer.success->beyond.verdict);
  }
  const bool contradicts = value != nullptr && answer.both_succeed && IsDecided(answer.both_succeed->verdict) &&
                           answer.both_succeed->verdict != value->verdict;
  if (value != nullptr && IsDecided(value->verdict) && !contradicts) {
    return decide(AnswerStep::kValue, value->verdict, value->beyond.verdict);
  }
  if (answer.tail && IsDecided(answer.tail->verdict)) {
    return decide(AnswerStep::kTail, answer.tail->verdict, answer.tail->beyond.verdict);
  }
  // No step decides. The answer is "no difference" only if the verdict on the value is "no difference" and the verdict
  // on success is not open.
  const auto is_open = [](const std::optional<Comparison>& step) {
    return step && step->verdict == Verdict::kUndecided && (step->differing > 0 || step->pairs < kMinSample);
  };
  const Verdict of_value = value != nullptr ? value->verdict
                           : answer.success ? answer.success->verdict
                                            : Verdict::kUndecided;
  const bool open = contradicts || is_open(answer.success) || of_value != Verdict::kNoDifference;
  decide(AnswerStep::kNone, open ? Verdict::kUndecided : Verdict::kNoDifference,
         value != nullptr && value->pairs > 0 ? value->beyond.verdict
         : answer.success                     ? answer.success->beyond.verdict
                                              : std::nullopt);
  // The answer for other units must not claim more than the answer for these worlds. "Better" and "worse" therefore
  // become undecided. If the answer for these worlds is undecided (`open`), the answer for other units is too.
  if (answer.beyond && (open || IsDecided(*answer.beyond))) answer.beyond = Verdict::kUndecided;
}

/// Judges the answers of all conditions, either those against the baselines or those against the rivals.
void JudgeFamilyOfAnswers(const Study& study, std::vector<ConditionSummary>& conditions,
                          std::vector<Answer> ConditionSummary::*answers,
                          std::vector<Comparison> ConditionSummary::*comparisons) {
  std::vector<Answer*> family;
  for (ConditionSummary& condition : conditions) {
    for (Answer& answer : condition.*answers) family.push_back(&answer);
  }
  JudgeStep(family, &Answer::success, study.unit, [&](const Answer&) { return SuccessMetric(study); });
  JudgeStep(family, &Answer::both_succeed, study.unit, [](const Answer& a) { return *FindMetric(a.value_metric); });
  JudgeStep(family, &Answer::tail, study.unit, [&](const Answer& a) { return TailMetric(study, a.value_metric); });
  for (ConditionSummary& condition : conditions) {
    for (Answer& answer : condition.*answers) {
      const auto value = std::ranges::find_if(condition.*comparisons, [&](const Comparison& c) {
        return c.method == answer.method && c.metric == answer.value_metric;
      });
      Decide(answer, value == (condition.*comparisons).end() ? nullptr : &*value);
    }
  }
}

}  // namespace

std::string ValueMetricOf(const Study& study) {
  const MetricInfo* success = FindMetric(study.success);
  const bool is_graded = success != nullptr && success->reading != Reading::kYesNo;
  if (is_graded && !study.metrics.empty() && study.metrics.front() == study.success) return "";
  const auto found = std::ranges::find_if(study.metrics, [&](const std::string& id) { return id != study.success; });
  return found == study.metrics.end() ? "" : *found;
}

std::optional<Comparison> CompareSuccess(const Study& study, const ConditionTable& table, const std::string& method,
                                         const std::string& other, std::uint64_t seed) {
  if (study.success.empty()) return std::nullopt;
  const std::vector<const MethodColumns*> others(static_cast<std::size_t>(table.trials()), &table.Of(other));
  const PairedWorlds worlds = SuccessesOf({&table.Of(method), others}, study.success);
  if (worlds.pairs.empty()) return std::nullopt;
  return ComparePaired(worlds.pairs, SuccessMetric(study), seed, PurposeOf(study.scenario, table.condition, "success"));
}

int WorldsNeeded(const Study& study) {
  const MetricInfo *success = FindMetric(study.success), *value = FindMetric(ValueMetricOf(study));
  int needed = PairsNeeded(CountComparisons(study), kAlpha);
  // McNemar's mid-p judges yes-or-no success and tails. Its smallest value is half of the smallest p of the other
  // tests, so at kAlpha it needs as many worlds as another test at 2 · kAlpha.
  if (success != nullptr) {
    needed =
        std::min(needed, PairsNeeded(CountAnswers(study), success->reading == Reading::kScore ? kAlpha : 2 * kAlpha));
  }
  if (value != nullptr && value->direction != Direction::kNeither && value->reading == Reading::kAmount) {
    needed = std::min(needed, PairsNeeded(CountAnswers(study), 2 * kAlpha));
  }
  return std::max(needed, kMinSample);
}

double McNemarMidP(int gained, int lost) {
  const int all = gained + lost, more = std::max(gained, lost);
  if (all == 0) return 1;
  const double above = more == all ? 0 : FairCoinUpperTail(more + 1, all);
  return std::min(1.0, KeepThirtyBits(FairCoinUpperTail(more, all) + above));
}

std::optional<Answer> MeasureAnswerAgainstBaseline(const Study& study, const ConditionTable& table,
                                                   const ComparedMethod& method, std::uint64_t seed) {
  if (method.name == method.against) return std::nullopt;
  const std::string value = ValueMetricOf(study);
  const std::vector<const MethodColumns*> other(static_cast<std::size_t>(table.trials()), &table.Of(method.against));
  const PairedWorlds values = value.empty() ? PairedWorlds() : PairsOf(table, method.against, method.name, value);
  return Measurer(study, table, seed).Measure({&table.Of(method.name), other}, values, method.against);
}

std::optional<Answer> MeasureAnswerAgainstRival(const Study& study, const ConditionTable& table,
                                                const ComparedMethod& method, std::uint64_t seed) {
  const auto rival = FindRival(study, table, method);
  if (!rival) return std::nullopt;
  const std::string value = ValueMetricOf(study);
  std::vector<const MethodColumns*> other;
  for (int trial = 0; trial < table.trials(); ++trial) {
    other.push_back(&table.Of(rival->of_half[static_cast<std::size_t>(HalfOf(table, trial))]));
  }
  const PairedWorlds values = value.empty() ? PairedWorlds() : WorldsAgainst(*rival, table, method.name, value);
  return Measurer(study, table, seed).Measure({&table.Of(method.name), other}, values, rival->Name());
}

void JudgeAnswers(const Study& study, std::vector<ConditionSummary>& conditions) {
  JudgeFamilyOfAnswers(study, conditions, &ConditionSummary::answers, &ConditionSummary::comparisons);
  JudgeFamilyOfAnswers(study, conditions, &ConditionSummary::rival_answers, &ConditionSummary::rivals);
}

}  // namespace etude
