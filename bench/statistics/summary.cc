#include "bench/statistics/summary.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "bench/statistics/answers.h"
#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/interval.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// Returns the metrics that the condition's cells report: the metrics of the catalogue in its order, then AddedMetrics.
std::vector<const MetricInfo*> MetricsIn(const ConditionTable& table) {
  std::vector<const MetricInfo*> present;
  for (const MetricInfo& metric : AllMetrics()) {
    const auto reports = [&](const MethodColumns& method) { return method.Reports(metric.id); };
    if (std::any_of(table.methods.begin(), table.methods.end(), reports)) present.push_back(&metric);
  }
  for (const auto& [id, metric] : AddedMetrics()) {
    const auto reports = [&, &metric = metric](const MethodColumns& method) { return method.Reports(metric.id); };
    if (std::any_of(table.methods.begin(), table.methods.end(), reports)) present.push_back(&metric);
  }
  return present;
}

/// Returns the interval of the values' aggregate. If a metric's aggregate is the mean of values from 0 to 1, and all
/// values are 0 or 1, this is Wilson's interval, because the bootstrap interval of, say, 60 zeros has no width. An
/// amount is never a share, even if all its values are 0.
std::optional<Interval> IntervalOf(std::span<const double> values, const MetricInfo& metric, std::uint64_t seed,
                                   const std::string& purpose) {
  const bool is_share = metric.reading != Reading::kAmount && metric.aggregate == Aggregate::kMean &&
                        std::ranges::all_of(values, [](double value) { return value == 0 || value == 1; });
  if (!is_share) return BootstrapInterval(values, metric.aggregate, seed, purpose);
  const auto count = std::count(values.begin(), values.end(), 1.0);
  return WilsonInterval(static_cast<int>(count), static_cast<int>(values.size()));
}

MetricSummary SummariseMetric(const MetricInfo& metric, const MethodColumns& method, std::uint64_t seed,
                              const std::string& purpose) {
  MetricSummary summary;
  summary.id = metric.id;
  const std::vector<double> values = method.ValuesOf(metric.id, summary.missing);
  summary.present = static_cast<int>(values.size());
  if (values.empty()) return summary;
  summary.median = Quantile(values, 0.5);
  // A weighted mean is the mean of its linearised values (Taylor expansion of a ratio), so the interval of this mean is
  // the interval of the weighted mean.
  std::vector<double> linear = values;
  if (!metric.weight.empty()) {
    const std::vector<double> weights = method.WeightsOf(metric);
    double mean = 0;
    for (std::size_t i = 0; i < values.size(); ++i) mean += weights[i] * values[i] / static_cast<double>(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) linear[i] = mean + weights[i] * (values[i] - mean);
  }
  summary.mean = Mean(linear);
  if (const auto interval = IntervalOf(linear, metric, seed, purpose)) {
    summary.ci_low = interval->low;
    summary.ci_high = interval->high;
    summary.interval = interval->kind;
  }
  return summary;
}

MethodSummary SummariseMethod(const MethodColumns& method, const ConditionTable& table,
                              std::span<const MetricInfo* const> metrics, const Study& study, std::uint64_t seed) {
  MethodSummary summary;
  summary.method = method.name();
  for (const auto& [name, status] : kStatuses) {
    int count = 0;
    for (int trial = 0; trial < table.trials(); ++trial) count += method.StatusAt(trial) == status;
    if (count > 0) summary.statuses.emplace_back(status, count);
    if (status == Status::kOk) summary.ok = count;
    if (status != Status::kSkipped) summary.attempted += count;
  }
  if (summary.attempted > 0) {
    const Interval interval = WilsonInterval(summary.ok, summary.attempted);
    summary.ok_low = interval.low;
    summary.ok_high = interval.high;
  }
  for (const MetricInfo* metric : metrics) {
    const std::string purpose = PurposeOf(study.scenario, table.condition, metric->id);
    summary.metrics.push_back(SummariseMetric(*metric, method, seed, purpose));
  }
  return summary;
}

/// The inputs that all comparisons of a scenario share.
struct Family {
  const Study& study;
  std::uint64_t seed = 1;
  int size = 0;  ///< number of comparisons that are judged together

  /// Estimates the difference for other units. Empty if every world is its own unit.
  Beyond MeasureUnits(const PairedWorlds& worlds, const ConditionTable& table, const MetricInfo& metric) const {
    if (WorldsAreUnits(study.unit)) return {};
    Beyond beyond = MeasureBeyond(UnitsOf(worlds, table, metric), size);
    beyond.not_alike = worlds.not_alike;
    return beyond;
  }

  /// Measures one comparison. Its verdict is left open, because it depends on the other comparisons.
  Question Ask(const PairedWorlds& worlds, const ConditionTable& table, const MetricInfo& metric,
               const std::string& purpose) const {
    Question question{ComparePaired(worlds.pairs, metric, seed, purpose), std::nullopt};
    question.comparison.only_baseline = worlds.only_baseline;
    question.comparison.only_method = worlds.only_method;
    question.comparison.neither = worlds.neither;
    question.comparison.not_alike = worlds.not_alike;
    question.comparison.beyond = MeasureUnits(worlds, table, metric);
    if (const auto all = WithFailures(worlds, metric)) {
      question.with_failures = ComparePaired(all->pairs, metric, seed, purpose + "/failures");
      question.with_failures->not_alike = worlds.not_alike;
      question.with_failures->beyond = MeasureUnits(*all, table, metric);
    }
    return question;
  }
};

int SizeOf(const Study& study, int methods) {
  return methods * static_cast<int>(study.metrics.size() * study.conditions.size());
}

void AskAgainstBaseline(const Study& study, const ConditionTable& condition, const ComparedMethod& entry,
                        std::uint64_t seed, std::vector<Question>& questions) {
  if (entry.name == entry.against) return;
  const Family family{study, seed, CountComparisons(study)};
  for (const std::string& id : study.metrics) {
    const std::string purpose = PurposeOf(study.scenario, condition.condition, id);
    const PairedWorlds worlds = PairsOf(condition, entry.against, entry.name, id);
    questions.push_back(family.Ask(worlds, condition, *FindMetric(id), purpose));
    questions.back().comparison.baseline = entry.against;
    questions.back().comparison.method = entry.name;
  }
}

/// Compares a competing method with its strongest rival.
void AskAgainstRival(const Study& study, const ConditionTable& condition, const ComparedMethod& entry,
                     std::uint64_t seed, std::vector<Question>& questions) {
  const auto rival = FindRival(study, condition, entry);
  if (!rival) return;
  const auto asking =
      std::ranges::count_if(study.methods, [&](const ComparedMethod& method) { return HasRival(study, method); });
  const Family family{study, seed, SizeOf(study, static_cast<int>(asking))};
  for (const std::string& id : study.metrics) {
    const std::string purpose = PurposeOf(study.scenario, condition.condition, id);
    const PairedWorlds worlds = WorldsAgainst(*rival, condition, entry.name, id);
    questions.push_back(family.Ask(worlds, condition, *FindMetric(id), purpose));
    Comparison& comparison = questions.back().comparison;
    comparison.baseline = rival->Name();
    comparison.method = entry.name;
    if (const std::string note = rival->Note(); !note.empty()) comparison.notes.push_back(note);
  }
}

/// Judges the comparisons of all conditions as one family, and moves each to the summary of its condition. Returns the
/// number of comparisons.
int JudgeTogether(std::vector<ConditionFindings>& findings, SamplingUnit unit,
                  std::vector<Question> ConditionFindings::*asked, std::vector<Comparison> ConditionSummary::*judged) {
  std::vector<Question*> family;
  for (ConditionFindings& of_condition : findings) {
    for (Question& question : of_condition.*asked) family.push_back(&question);
  }
  JudgeFamily(family, unit);
  for (ConditionFindings& of_condition : findings) {
    for (Question& question : of_condition.*asked) {
      (of_condition.summary.*judged).push_back(std::move(question.comparison));
    }
  }
  return static_cast<int>(family.size());
}

}  // namespace

int CountComparisons(const Study& study) {
  const auto compared = std::count_if(study.methods.begin(), study.methods.end(),
                                      [](const ComparedMethod& method) { return method.name != method.against; });
  return SizeOf(study, static_cast<int>(compared));
}

ConditionFindings MeasureMethod(const Study& study, const ConditionTable& table, std::size_t method,
                                std::uint64_t seed) {
  const ComparedMethod& entry = study.methods[method];
  ConditionFindings findings;
  findings.summary.condition = table.condition;
  findings.summary.methods.push_back(SummariseMethod(table.methods[method], table, MetricsIn(table), study, seed));
  if (method == 0 && !study.metrics.empty()) {
    findings.summary.budgets = ComputeErrorBudgets(study, table, study.metrics.front(), seed);
  }
  if (auto answer = MeasureAnswerAgainstBaseline(study, table, entry, seed)) {
    findings.summary.answers.push_back(*std::move(answer));
  }
  if (auto answer = MeasureAnswerAgainstRival(study, table, entry, seed)) {
    findings.summary.rival_answers.push_back(*std::move(answer));
  }
  AskAgainstBaseline(study, table, entry, seed, findings.against_baselines);
  AskAgainstRival(study, table, entry, seed, findings.against_rivals);
  return findings;
}

void Append(ConditionFindings more, ConditionFindings& findings) {
  const auto move = [](auto& from, auto& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move(more.summary.methods, findings.summary.methods);
  move(more.summary.answers, findings.summary.answers);
  move(more.summary.rival_answers, findings.summary.rival_answers);
  move(more.against_baselines, findings.against_baselines);
  move(more.against_rivals, findings.against_rivals);
}

ScenarioSummary JudgeFindings(const Study& study, const ScenarioTable& table, std::vector<ConditionFindings> findings,
                              std::uint64_t seed) {
  ScenarioSummary summary{study.scenario, study.task, study.question, study.unit, {}, study.metrics, {}, {}};
  summary.description = study.description;
  for (const ComparedMethod& entry : study.methods) {
    summary.methods.push_back(entry.name);
    summary.descriptions.push_back(entry.description);
  }
  if (std::ranges::all_of(summary.descriptions, &std::string::empty)) summary.descriptions.clear();
  summary.family =
      JudgeTogether(findings, study.unit, &ConditionFindings::against_baselines, &ConditionSummary::comparisons);
  JudgeTogether(findings, study.unit, &ConditionFindings::against_rivals, &ConditionSummary::rivals);
  for (ConditionFindings& of_condition : findings) summary.conditions.push_back(std::move(of_condition.summary));
  JudgeAnswers(study, summary.conditions);
  summary.across = JudgeAcross(study, summary.conditions);
  for (const Expectation& expectation : study.expectations) {
    summary.expectations.push_back(JudgeExpectation(expectation, study, table, seed));
  }
  return summary;
}

ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed) {
  std::vector<ConditionFindings> findings;
  for (const ConditionTable& condition : table.conditions()) {
    findings.push_back(MeasureMethod(study, condition, 0, seed));
    for (std::size_t method = 1; method < study.methods.size(); ++method) {
      Append(MeasureMethod(study, condition, method, seed), findings.back());
    }
  }
  return JudgeFindings(study, table, std::move(findings), seed);
}

namespace {

using Stages = std::set<std::string>;

/// A method, and the stages in it that are replaced by the truth.
struct Member {
  std::string method;
  Stages stages;
};

/// Returns true if `all` contains every stage of `some`.
bool Holds(const Stages& all, const Stages& some) { return std::ranges::includes(all, some); }

Stages Without(const Stages& all, const Stages& some) {
  Stages rest;
  std::ranges::set_difference(all, some, std::inserter(rest, rest.end()));
  return rest;
}

/// Returns the groups of methods whose settings are equal apart from the oracle. Each group is sorted by the number of
/// stages.
std::vector<std::vector<Member>> FamiliesOf(const Study& study) {
  std::vector<std::pair<std::string, std::vector<Member>>> families;
  for (const ComparedMethod& method : study.methods) {
    if (method.settings.empty()) continue;
    auto family = std::ranges::find(families, method.settings, &std::pair<std::string, std::vector<Member>>::first);
    if (family == families.end()) family = families.insert(families.end(), {method.settings, {}});
    const Member member{method.name, Stages(method.oracle.begin(), method.oracle.end())};
    const bool is_known =
        std::ranges::any_of(family->second, [&](const Member& other) { return other.stages == member.stages; });
    if (!is_known) family->second.push_back(member);
  }
  std::vector<std::vector<Member>> members;
  for (auto& [settings, family] : families) {
    if (family.size() < 2) continue;
    std::ranges::stable_sort(family, {}, [](const Member& member) { return member.stages.size(); });
    members.push_back(std::move(family));
  }
  return members;
}

/// Returns a chain of members. The first member has the fewest stages; each next member is the smallest one that
/// contains all stages of the member before it.
std::vector<Member> ChainOf(const std::vector<Member>& family) {
  std::vector<Member> chain;
  for (const Member& member : family) {
    if (chain.empty() || Holds(member.stages, chain.back().stages)) chain.push_back(member);
  }
  return chain;
}

/// Returns the values of the metric for each member, by the name of its method, in the worlds in which all members
/// have a value.
std::map<std::string, std::vector<double>> ValuesOf(const std::vector<Member>& members, const ConditionTable& table,
                                                    const std::string& metric) {
  std::map<std::string, std::vector<double>> values;
  for (int trial = 0; trial < table.trials(); ++trial) {
    std::vector<double> row;
    for (const Member& member : members) {
      const std::optional<double> value = table.Of(member.method).ValueAt(metric, trial);
      if (value) row.push_back(*value);
    }
    if (row.size() != members.size()) continue;
    for (std::size_t i = 0; i < members.size(); ++i) values[members[i].method].push_back(row[i]);
  }
  return values;
}

/// Computes the error budget of one family: methods that differ only in `oracle`.
class BudgetMaker {
 public:
  BudgetMaker(const std::vector<Member>& family, const ConditionTable& table, const std::string& metric,
              std::uint64_t seed, std::string purpose)
      : family_(family), table_(table), metric_(metric), seed_(seed), purpose_(std::move(purpose)) {}

  std::optional<ErrorBudget> Make() {
    // Use Shapley values if every subset of the stages is among the methods.
    const Stages stages = Without(family_.back().stages, family_.front().stages);
    const bool is_whole =
        stages.size() <= kMaxShapleyStages && family_.size() == std::size_t{1} << stages.size() &&
        std::ranges::all_of(family_, [&](const Member& member) {
          return Holds(family_.back().stages, member.stages) && Holds(member.stages, family_.front().stages);
        });
    // Otherwise, use the chain.
    const std::vector<Member> members = is_whole ? family_ : ChainOf(family_);
    values_ = ValuesOf(members, table_, metric_);
    if (values_.empty() || members.size() < 2) return std::nullopt;
    // Compute the error with the fewest replaced stages, the error that remains with the most replaced stages, and the
    // shares of the stages in between.
    budget_.metric = metric_;
    budget_.method = members.front().method;
    budget_.is_shapley = is_whole;
    budget_.worlds = static_cast<int>(values_[budget_.method].size());
    budget_.total = Mean(values_[members.front().method]);
    budget_.rest = Mean(values_[members.back().method]);
    if (is_whole) {
      for (const std::string& stage : stages) AddShare(stage, ShapleyValues(stage, stages.size()));
    } else {
      for (std::size_t i = 1; i < members.size(); ++i) AddStep(members[i - 1], members[i]);
    }
    return budget_;
  }

 private:
  /// Adds one step of the chain. The step replaces some stages by the truth; their share is the reduction of the error.
  void AddStep(const Member& before, const Member& after) {
    std::string name;
    for (const std::string& stage : Without(after.stages, before.stages)) name += (name.empty() ? "" : ", ") + stage;
    std::vector<double> saved = values_[before.method];
    const std::vector<double>& left = values_[after.method];
    for (std::size_t i = 0; i < saved.size(); ++i) saved[i] -= left[i];
    AddShare(name, saved);
  }

  // Returns, for each world, Σ |S|! (n − |S| − 1)! / n! · (v(S) − v(S ∪ stage)) over all sets S without the stage. v is
  // the error and n the number of stages.
  std::vector<double> ShapleyValues(const std::string& stage, std::size_t count) {
    std::vector<double> shares(values_.begin()->second.size(), 0.0);
    for (const Member& member : family_) {
      if (member.stages.contains(stage)) continue;
      Stages with = member.stages;
      with.insert(stage);
      const auto other = std::ranges::find(family_, with, &Member::stages);
      const std::size_t size = Without(member.stages, family_.front().stages).size();
      double weight = 1 / static_cast<double>(count);  // 1 / (n · choose(n − 1, |S|))
      for (std::size_t i = 0; i < size; ++i) weight *= static_cast<double>(i + 1) / static_cast<double>(count - 1 - i);
      for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] += weight * (values_[member.method][i] - values_[other->method][i]);
      }
    }
    return shares;
  }

  void AddShare(const std::string& stage, const std::vector<double>& values) {
    BudgetShare share{.stage = stage, .mean = Mean(values)};
    if (const auto interval = BootstrapInterval(values, Aggregate::kMean, seed_, purpose_ + "/" + stage)) {
      share.ci_low = interval->low;
      share.ci_high = interval->high;
    }
    budget_.shares.push_back(std::move(share));
  }

  const std::vector<Member>& family_;
  const ConditionTable& table_;
  const std::string& metric_;
  const std::uint64_t seed_;
  const std::string purpose_;
  std::map<std::string, std::vector<double>> values_;
  ErrorBudget budget_;
};

}  // namespace

std::vector<ErrorBudget> ComputeErrorBudgets(const Study& study, const ConditionTable& table, const std::string& metric,
                                             std::uint64_t seed) {
  std::vector<ErrorBudget> budgets;
  for (const std::vector<Member>& family : FamiliesOf(study)) {
    std::string purpose = "budget/" + study.scenario + "/" + metric;
    for (const SweptValue& swept : table.condition) purpose += "/" + swept.key + "=" + swept.value;
    if (auto budget = BudgetMaker(family, table, metric, seed, std::move(purpose)).Make()) {
      budgets.push_back(std::move(*budget));
    }
  }
  return budgets;
}

}  // namespace etude
