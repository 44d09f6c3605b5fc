#include "bench/run/sum_up.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "bench/results/summary_json.h"
#include "bench/run/forked.h"

namespace etude {
namespace {

/// The findings of a condition as the summaries of two: the questions without failures, and with them. A question that
/// has no answer with failures has one of no pairs there, which no other has.
Result<std::string> EncodeFindings(const ConditionFindings& findings) {
  ScenarioSummary both;
  ConditionSummary& without = both.conditions.emplace_back(findings.summary);
  ConditionSummary with;
  const auto add = [](const std::vector<Question>& questions, std::vector<Comparison>& plain,
                      std::vector<Comparison>& failures) {
    for (const Question& question : questions) {
      plain.push_back(question.comparison);
      failures.push_back(question.with_failures.value_or(Comparison()));
    }
  };
  add(findings.against_baselines, without.comparisons, with.comparisons);
  add(findings.against_rivals, without.rivals, with.rivals);
  both.conditions.push_back(std::move(with));
  return WriteJson(EncodeSummaries({both}));
}

Result<ConditionFindings> DecodeFindings(const std::string& text) {
  const Place place{"a condition's findings", 0, 0};
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, place.file));
  ASSIGN_OR_RETURN(auto both, DecodeSummaries(json, place));
  ConditionSummary &without = both.front().conditions.at(0), &with = both.front().conditions.at(1);
  const auto take = [](std::vector<Comparison>& plain, std::vector<Comparison>& failures) {
    std::vector<Question> questions;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      questions.push_back({std::move(plain[i]), std::nullopt});
      if (failures[i].pairs > 0) questions.back().with_failures = std::move(failures[i]);
    }
    plain.clear();
    return questions;
  };
  ConditionFindings findings;
  findings.against_baselines = take(without.comparisons, with.comparisons);
  findings.against_rivals = take(without.rivals, with.rivals);
  findings.summary = std::move(without);
  return findings;
}

}  // namespace

Result<ScenarioSummary> SumUp(const Study& study, const ScenarioTable& table, std::uint64_t seed, int jobs) {
  constexpr std::size_t kWorthSharing = 20'000;  // rows; fewer are summed up before copies would be made
  const auto conditions = table.conditions();
  const std::size_t rows = conditions.size() * static_cast<std::size_t>(study.trials) * study.methods.size();
  if (rows < kWorthSharing || conditions.size() == 1 || jobs == 1) return Summarise(study, table, seed);
  ASSIGN_OR_RETURN(const auto texts, RunForked(conditions.size(), jobs, [&](std::size_t condition) {
                     return EncodeFindings(MeasureCondition(study, conditions[condition], seed));
                   }));
  std::vector<ConditionFindings> findings;
  for (const std::string& text : texts) {
    ASSIGN_OR_RETURN(auto of_condition, DecodeFindings(text));
    findings.push_back(std::move(of_condition));
  }
  return JudgeFindings(study, table, std::move(findings), seed);
}

}  // namespace etude
