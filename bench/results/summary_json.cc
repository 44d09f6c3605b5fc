#include "bench/results/summary_json.h"

#include <nlohmann/json.hpp>

namespace etude {
namespace {

constexpr int kVerdicts = 4, kIntervalKinds = 7;

Json Number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> AsOptional(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

/// The value among the first `count` of an enum whose name this is.
template <typename Enum>
Enum ByName(const std::string& name, std::string_view (*name_of)(Enum), int count) {
  for (int i = 0; i < count; ++i) {
    if (name_of(static_cast<Enum>(i)) == name) return static_cast<Enum>(i);
  }
  throw Json::other_error::create(501, "unknown name '" + name + "'", nullptr);
}

SamplingUnit FindUnit(const std::string& name) {
  if (const auto unit = FindValue(kSamplingUnits, name)) return *unit;
  throw Json::other_error::create(501, "unknown unit '" + name + "'", nullptr);
}

Json Encode(const std::vector<SweptValue>& condition) {
  Json json = Json::array();
  for (const SweptValue& swept : condition) json.push_back({{"key", swept.key}, {"value", swept.value}});
  return json;
}

Json Encode(const MetricSummary& metric) {
  return {{"id", metric.id},
          {"present", metric.present},
          {"missing", metric.missing},
          {"median", Number(metric.median)},
          {"mean", Number(metric.mean)},
          {"ci95_low", Number(metric.ci_low)},
          {"ci95_high", Number(metric.ci_high)},
          {"interval", IntervalKindName(metric.interval)}};
}

Json Encode(const MethodSummary& method) {
  Json statuses = Json::object();
  for (const auto& [status, count] : method.statuses) statuses[std::string(StatusName(status))] = count;
  Json metrics = Json::array();
  for (const MetricSummary& metric : method.metrics) metrics.push_back(Encode(metric));
  return {{"method", method.method},
          {"statuses", std::move(statuses)},
          {"ok", method.ok},
          {"attempted", method.attempted},
          {"ok_share_ci95_low", Number(method.ok_low)},
          {"ok_share_ci95_high", Number(method.ok_high)},
          {"metrics", std::move(metrics)}};
}

Json Encode(const PairedTest& test) { return {{"p", Number(test.p)}, {"how", test.how}}; }

Json Encode(const Beyond& beyond) {
  Json left_out = Json::array();
  for (const LeftOut& left : beyond.left_out) left_out.push_back({{"unit", left.unit}, {"mean", left.difference}});
  return {{"units", beyond.units},
          {"differing", beyond.differing},
          {"mean", Number(beyond.difference)},
          {"ci95_low", Number(beyond.low)},
          {"ci95_high", Number(beyond.high)},
          {"median_ci95_low", Number(beyond.median_low)},
          {"median_ci95_high", Number(beyond.median_high)},
          {"test", Encode(beyond.test)},
          {"p_holm", Number(beyond.p_holm)},
          {"verdict", beyond.verdict ? Json(VerdictName(*beyond.verdict)) : Json(nullptr)},
          {"why_open", beyond.why_open},
          {"left_out", std::move(left_out)}};
}

Json Encode(const Comparison& comparison) {
  return {{"metric", comparison.metric},
          {"baseline", comparison.baseline},
          {"method", comparison.method},
          {"pairs", comparison.pairs},
          {"differing", comparison.differing},
          {"only_baseline", comparison.only_baseline},
          {"only_method", comparison.only_method},
          {"neither", comparison.neither},
          {"difference", Number(comparison.difference)},
          {"ci95_low", Number(comparison.ci_low)},
          {"ci95_high", Number(comparison.ci_high)},
          {"interval", IntervalKindName(comparison.interval)},
          {"mean", Number(comparison.mean)},
          {"mean_ci95_low", Number(comparison.mean_low)},
          {"mean_ci95_high", Number(comparison.mean_high)},
          {"signed_rank", Encode(comparison.signed_rank)},
          {"sign_flip", Encode(comparison.sign_flip)},
          {"p_holm", Number(comparison.p_holm)},
          {"share_better", comparison.share_better},
          {"effect_size", Number(comparison.effect_size)},
          {"verdict", VerdictName(comparison.verdict)},
          {"why_open", comparison.why_open},
          {"notes", comparison.notes},
          {"beyond", Encode(comparison.beyond)}};
}

Json Encode(const ErrorBudget& budget) {
  Json shares = Json::array();
  for (const BudgetShare& share : budget.shares) {
    shares.push_back({{"stage", share.stage},
                      {"mean", share.mean},
                      {"mean_ci95_low", Number(share.ci_low)},
                      {"mean_ci95_high", Number(share.ci_high)}});
  }
  return {{"metric", budget.metric},    {"method", budget.method}, {"shapley", budget.is_shapley},
          {"worlds", budget.worlds},    {"total", budget.total},   {"rest", budget.rest},
          {"shares", std::move(shares)}};
}

ErrorBudget DecodeBudget(const Json& json) {
  ErrorBudget budget{.metric = json.at("metric").get<std::string>(),
                     .method = json.at("method").get<std::string>(),
                     .is_shapley = json.at("shapley").get<bool>(),
                     .worlds = json.at("worlds").get<int>(),
                     .total = json.at("total").get<double>(),
                     .rest = json.at("rest").get<double>(),
                     .shares = {}};
  for (const Json& share : json.at("shares")) {
    budget.shares.push_back({share.at("stage").get<std::string>(), share.at("mean").get<double>(),
                             AsOptional(share.at("mean_ci95_low")), AsOptional(share.at("mean_ci95_high"))});
  }
  return budget;
}

std::vector<SweptValue> DecodeCondition(const Json& json) {
  std::vector<SweptValue> condition;
  for (const Json& swept : json) {
    condition.push_back({swept.at("key").get<std::string>(), swept.at("value").get<std::string>()});
  }
  return condition;
}

MetricSummary DecodeMetric(const Json& json) {
  MetricSummary metric;
  metric.id = json.at("id").get<std::string>();
  metric.present = json.at("present").get<int>();
  metric.missing = json.at("missing").get<int>();
  metric.median = AsOptional(json.at("median"));
  metric.mean = AsOptional(json.at("mean"));
  metric.ci_low = AsOptional(json.at("ci95_low"));
  metric.ci_high = AsOptional(json.at("ci95_high"));
  metric.interval = ByName<IntervalKind>(json.at("interval").get<std::string>(), IntervalKindName, kIntervalKinds);
  return metric;
}

MethodSummary DecodeMethod(const Json& json) {
  MethodSummary method;
  method.method = json.at("method").get<std::string>();
  for (const auto& [name, count] : json.at("statuses").items()) {
    method.statuses.emplace_back(ByName<Status>(name, StatusName, kStatusCount), count.get<int>());
  }
  for (const Json& metric : json.at("metrics")) method.metrics.push_back(DecodeMetric(metric));
  method.ok = json.at("ok").get<int>();
  method.attempted = json.at("attempted").get<int>();
  method.ok_low = AsOptional(json.at("ok_share_ci95_low"));
  method.ok_high = AsOptional(json.at("ok_share_ci95_high"));
  return method;
}

PairedTest DecodeTest(const Json& json) { return {AsOptional(json.at("p")), json.at("how").get<std::string>()}; }

Beyond DecodeBeyond(const Json& json) {
  Beyond beyond;
  beyond.units = json.at("units").get<int>();
  beyond.differing = json.at("differing").get<int>();
  beyond.difference = AsOptional(json.at("mean"));
  beyond.low = AsOptional(json.at("ci95_low"));
  beyond.high = AsOptional(json.at("ci95_high"));
  beyond.median_low = AsOptional(json.at("median_ci95_low"));
  beyond.median_high = AsOptional(json.at("median_ci95_high"));
  beyond.test = DecodeTest(json.at("test"));
  beyond.p_holm = AsOptional(json.at("p_holm"));
  if (!json.at("verdict").is_null()) {
    beyond.verdict = ByName<Verdict>(json.at("verdict").get<std::string>(), VerdictName, kVerdicts);
  }
  beyond.why_open = json.at("why_open").get<std::string>();
  for (const Json& left : json.at("left_out")) {
    beyond.left_out.push_back({left.at("unit").get<std::string>(), left.at("mean").get<double>()});
  }
  return beyond;
}

Comparison DecodeComparison(const Json& json) {
  Comparison comparison;
  comparison.metric = json.at("metric").get<std::string>();
  comparison.baseline = json.at("baseline").get<std::string>();
  comparison.method = json.at("method").get<std::string>();
  comparison.pairs = json.at("pairs").get<int>();
  comparison.differing = json.at("differing").get<int>();
  comparison.only_baseline = json.at("only_baseline").get<int>();
  comparison.only_method = json.at("only_method").get<int>();
  comparison.neither = json.at("neither").get<int>();
  comparison.difference = AsOptional(json.at("difference"));
  comparison.ci_low = AsOptional(json.at("ci95_low"));
  comparison.ci_high = AsOptional(json.at("ci95_high"));
  comparison.interval = ByName<IntervalKind>(json.at("interval").get<std::string>(), IntervalKindName, kIntervalKinds);
  comparison.mean = AsOptional(json.at("mean"));
  comparison.mean_low = AsOptional(json.at("mean_ci95_low"));
  comparison.mean_high = AsOptional(json.at("mean_ci95_high"));
  comparison.signed_rank = DecodeTest(json.at("signed_rank"));
  comparison.sign_flip = DecodeTest(json.at("sign_flip"));
  comparison.p_holm = AsOptional(json.at("p_holm"));
  comparison.share_better = json.at("share_better").get<double>();
  comparison.effect_size = AsOptional(json.at("effect_size"));
  comparison.verdict = ByName<Verdict>(json.at("verdict").get<std::string>(), VerdictName, kVerdicts);
  comparison.why_open = json.at("why_open").get<std::string>();
  comparison.notes = json.at("notes").get<std::vector<std::string>>();
  comparison.beyond = DecodeBeyond(json.at("beyond"));
  return comparison;
}

Json Encode(const AcrossVerdict& verdict) {
  Json each = Json::array();
  for (const AcrossVerdict::Each& under : verdict.each) {
    each.push_back(
        {{"value", under.value}, {"verdict", VerdictName(under.verdict)}, {"difference", Number(under.difference)}});
  }
  return {{"condition", Encode(verdict.condition)},
          {"metric", verdict.metric},
          {"baseline", verdict.baseline},
          {"method", verdict.method},
          {"verdict", VerdictName(verdict.verdict)},
          {"each", std::move(each)}};
}

AcrossVerdict DecodeAcross(const Json& json) {
  const auto verdict_in = [](const Json& name) {
    return ByName<Verdict>(name.get<std::string>(), VerdictName, kVerdicts);
  };
  AcrossVerdict verdict{.condition = DecodeCondition(json.at("condition")),
                        .metric = json.at("metric").get<std::string>(),
                        .baseline = json.at("baseline").get<std::string>(),
                        .method = json.at("method").get<std::string>(),
                        .each = {},
                        .verdict = verdict_in(json.at("verdict"))};
  for (const Json& under : json.at("each")) {
    verdict.each.push_back(
        {under.at("value").get<std::string>(), verdict_in(under.at("verdict")), AsOptional(under.at("difference"))});
  }
  return verdict;
}

}  // namespace

Json EncodeSummaries(const std::vector<ScenarioSummary>& scenarios) {
  Json list = Json::array();
  for (const ScenarioSummary& scenario : scenarios) {
    Json conditions = Json::array();
    for (const ConditionSummary& condition : scenario.conditions) {
      Json methods = Json::array(), comparisons = Json::array(), rivals = Json::array();
      for (const MethodSummary& method : condition.methods) methods.push_back(Encode(method));
      for (const Comparison& comparison : condition.comparisons) comparisons.push_back(Encode(comparison));
      for (const Comparison& comparison : condition.rivals) rivals.push_back(Encode(comparison));
      conditions.push_back({{"condition", Encode(condition.condition)},
                            {"methods", std::move(methods)},
                            {"comparisons", std::move(comparisons)},
                            {"rivals", std::move(rivals)}});
      // Only where there are some: most scenarios have none.
      for (const ErrorBudget& budget : condition.budgets) conditions.back()["error_budgets"].push_back(Encode(budget));
    }
    Json expectations = Json::array();
    for (const ExpectationResult& expectation : scenario.expectations) {
      expectations.push_back(
          {{"text", expectation.text}, {"outcome", RulingName(expectation.ruling)}, {"detail", expectation.detail}});
    }
    Json across = Json::array();
    for (const AcrossVerdict& verdict : scenario.across) across.push_back(Encode(verdict));
    list.push_back({{"name", scenario.name},
                    {"task", scenario.task},
                    {"question", scenario.question},
                    {"unit", SamplingUnitName(scenario.unit)},
                    {"methods", scenario.methods},
                    {"headline_metrics", scenario.headline_metrics},
                    {"comparisons_in_family", scenario.family},
                    {"conditions", std::move(conditions)},
                    {"expectations", std::move(expectations)}});
    if (!across.empty()) list.back()["across"] = std::move(across);  // most scenarios have none
  }
  return {{"scenarios", std::move(list)}};
}

Result<std::vector<ScenarioSummary>> DecodeSummaries(const Json& json, const Place& place) {
  std::vector<ScenarioSummary> scenarios;
  try {
    for (const Json& entry : json.at("scenarios")) {
      ScenarioSummary scenario{entry.at("name").get<std::string>(),
                               entry.at("task").get<std::string>(),
                               entry.at("question").get<std::string>(),
                               FindUnit(entry.at("unit").get<std::string>()),
                               entry.at("methods").get<std::vector<std::string>>(),
                               entry.at("headline_metrics").get<std::vector<std::string>>(),
                               {},
                               {},
                               entry.at("comparisons_in_family").get<int>(),
                               {}};
      if (entry.contains("across")) {
        for (const Json& verdict : entry.at("across")) scenario.across.push_back(DecodeAcross(verdict));
      }
      for (const Json& part : entry.at("conditions")) {
        ConditionSummary condition{DecodeCondition(part.at("condition")), {}, {}, {}, {}};
        for (const Json& method : part.at("methods")) condition.methods.push_back(DecodeMethod(method));
        for (const Json& row : part.at("comparisons")) condition.comparisons.push_back(DecodeComparison(row));
        for (const Json& row : part.at("rivals")) condition.rivals.push_back(DecodeComparison(row));
        if (part.contains("error_budgets")) {
          for (const Json& budget : part.at("error_budgets")) condition.budgets.push_back(DecodeBudget(budget));
        }
        scenario.conditions.push_back(std::move(condition));
      }
      for (const Json& expectation : entry.at("expectations")) {
        scenario.expectations.push_back({expectation.at("text").get<std::string>(),
                                         ByName<Ruling>(expectation.at("outcome").get<std::string>(), RulingName, 3),
                                         expectation.at("detail").get<std::string>()});
      }
      scenarios.push_back(std::move(scenario));
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not a summary: {}", error.what());
  }
  return scenarios;
}

}  // namespace etude
