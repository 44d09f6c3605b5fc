#include "bench/statistics/summary.h"

#include <algorithm>

#include "bench/statistics/beyond.h"
#include "bench/statistics/bootstrap.h"
#include "bench/statistics/error_budget.h"
#include "bench/statistics/interval.h"
#include "bench/statistics/judging.h"
#include "bench/statistics/scenario_table.h"

namespace etude {
namespace {

/// The metrics that the condition's cells report, in the order of the catalogue.
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

/// A share of worlds has its own interval: a bootstrap of none in sixty sees no chance of one.
std::optional<Interval> IntervalOf(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                   const std::string& purpose) {
  const bool is_share =
      std::all_of(values.begin(), values.end(), [](double value) { return value == 0 || value == 1; });
  if (aggregate == Aggregate::kMedian || !is_share) return BootstrapInterval(values, aggregate, seed, purpose);
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
  summary.mean = Mean(values);
  if (const auto interval = IntervalOf(values, metric.aggregate, seed, purpose)) {
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
    const std::string purpose = PurposeOf(study.scenario, table.condition, metric->id, "", method.name());
    summary.metrics.push_back(SummariseMetric(*metric, method, seed, purpose));
  }
  return summary;
}

/// The inputs that all comparisons of a scenario share.
struct Family {
  const Study& study;
  std::uint64_t seed = 1;
  int size = 0;  ///< comparisons that are judged together

  Beyond MeasureUnits(const PairedWorlds& worlds, const ConditionTable& table, const MetricInfo& metric,
                      const std::string& purpose) const {
    if (IsEveryWorldItsOwn(study.unit)) return {};
    return MeasureBeyond(UnitsOf(worlds, table, metric), size, seed, purpose);
  }

  /// One comparison, verdict left open: that depends on the others.
  Question Ask(const PairedWorlds& worlds, const ConditionTable& table, const MetricInfo& metric,
               const std::string& purpose) const {
    Question question{ComparePaired(worlds.pairs, metric, seed, purpose), std::nullopt};
    question.comparison.only_baseline = worlds.only_baseline;
    question.comparison.only_method = worlds.only_method;
    question.comparison.neither = worlds.neither;
    question.comparison.beyond = MeasureUnits(worlds, table, metric, purpose);
    if (const auto all = WithFailures(worlds, metric)) {
      question.with_failures = ComparePaired(all->pairs, metric, seed, purpose + "/failures");
      question.with_failures->beyond = MeasureUnits(*all, table, metric, purpose + "/failures");
    }
    return question;
  }
};

int SizeOf(const Study& study, int methods) {
  return methods * static_cast<int>(study.metrics.size() * study.conditions.size());
}

/// Every method against its baseline.
std::vector<Question> AskAgainstBaselines(const Study& study, const ConditionTable& condition, std::uint64_t seed) {
  const Family family{study, seed, CountComparisons(study)};
  std::vector<Question> questions;
  for (const ComparedMethod& entry : study.methods) {
    if (entry.name == entry.against) continue;
    for (const std::string& id : study.metrics) {
      const std::string purpose = PurposeOf(study.scenario, condition.condition, id, entry.against, entry.name);
      const PairedWorlds worlds = PairsOf(condition, entry.against, entry.name, id);
      questions.push_back(family.Ask(worlds, condition, *FindMetric(id), purpose));
      questions.back().comparison.baseline = entry.against;
      questions.back().comparison.method = entry.name;
    }
  }
  return questions;
}

/// Every method that competes against its strongest rival.
std::vector<Question> AskAgainstRivals(const Study& study, const ConditionTable& condition, std::uint64_t seed) {
  const auto asking =
      std::ranges::count_if(study.methods, [&](const ComparedMethod& method) { return HasRival(study, method); });
  const Family family{study, seed, SizeOf(study, static_cast<int>(asking))};
  std::vector<Question> questions;
  for (const ComparedMethod& entry : study.methods) {
    const auto rival = FindRival(study, condition, entry);
    if (!rival) continue;
    for (const std::string& id : study.metrics) {
      const std::string purpose = PurposeOf(study.scenario, condition.condition, id, "rival", entry.name);
      const PairedWorlds worlds = WorldsAgainst(*rival, condition, entry.name, id);
      questions.push_back(family.Ask(worlds, condition, *FindMetric(id), purpose));
      Comparison& comparison = questions.back().comparison;
      comparison.baseline = rival->Name();
      comparison.method = entry.name;
      if (const std::string note = rival->Note(); !note.empty()) comparison.notes.push_back(note);
    }
  }
  return questions;
}

/// Judges all of them together and gives each condition its own; returns how many they are.
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

ConditionFindings MeasureCondition(const Study& study, const ConditionTable& table, std::uint64_t seed) {
  ConditionFindings findings;
  findings.summary.condition = table.condition;
  const std::vector<const MetricInfo*> metrics = MetricsIn(table);
  for (const MethodColumns& method : table.methods) {
    findings.summary.methods.push_back(SummariseMethod(method, table, metrics, study, seed));
  }
  if (!study.metrics.empty()) {
    findings.summary.budgets = ComputeErrorBudgets(study, table, study.metrics.front(), seed);
  }
  findings.against_baselines = AskAgainstBaselines(study, table, seed);
  findings.against_rivals = AskAgainstRivals(study, table, seed);
  return findings;
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
  summary.across = JudgeAcross(study, summary.conditions);
  for (const Expectation& expectation : study.expectations) {
    summary.expectations.push_back(JudgeExpectation(expectation, study, table, seed));
  }
  return summary;
}

ScenarioSummary Summarise(const Study& study, const ScenarioTable& table, std::uint64_t seed) {
  std::vector<ConditionFindings> findings;
  for (const ConditionTable& condition : table.conditions()) {
    findings.push_back(MeasureCondition(study, condition, seed));
  }
  return JudgeFindings(study, table, std::move(findings), seed);
}

}  // namespace etude
