#include "bench/results/summary_json.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <span>
#include <tuple>
#include <type_traits>

namespace etude {
namespace {

enum class When { kAlways, kIfAny };

/// A key of a record in the JSON, and the member that holds the key's value. With kIfAny, an empty value is not
/// written.
template <typename Record, typename Value>
struct Key {
  constexpr Key(const char* key, Value Record::*held, When stands = When::kAlways)
      : name(key), member(held), when(stands) {}

  const char* name;
  Value Record::*member;
  When when;
};

/// The keys of each type of record, in the order of writing. They are used for writing and reading.
template <typename Record>
constexpr std::tuple<> kKeys = {};

template <>
constexpr std::tuple kKeys<SweptValue> = {Key("key", &SweptValue::key), Key("value", &SweptValue::value)};

template <>
constexpr std::tuple kKeys<MetricSummary> = {Key("id", &MetricSummary::id),
                                             Key("present", &MetricSummary::present),
                                             Key("missing", &MetricSummary::missing),
                                             Key("median", &MetricSummary::median),
                                             Key("mean", &MetricSummary::mean),
                                             Key("ci95_low", &MetricSummary::ci_low),
                                             Key("ci95_high", &MetricSummary::ci_high),
                                             Key("interval", &MetricSummary::interval)};

template <>
constexpr std::tuple kKeys<MethodSummary> = {Key("method", &MethodSummary::method),
                                             Key("statuses", &MethodSummary::statuses),
                                             Key("ok", &MethodSummary::ok),
                                             Key("attempted", &MethodSummary::attempted),
                                             Key("ok_share_ci95_low", &MethodSummary::ok_low),
                                             Key("ok_share_ci95_high", &MethodSummary::ok_high),
                                             Key("metrics", &MethodSummary::metrics)};

template <>
constexpr std::tuple kKeys<PairedTest> = {Key("p", &PairedTest::p), Key("how", &PairedTest::how)};

template <>
constexpr std::tuple kKeys<LeftOut> = {Key("unit", &LeftOut::unit), Key("mean", &LeftOut::difference)};

template <>
constexpr std::tuple kKeys<Beyond> = {Key("units", &Beyond::units),
                                      Key("differing", &Beyond::differing),
                                      Key("difference", &Beyond::difference),
                                      Key("ci95_low", &Beyond::low),
                                      Key("ci95_high", &Beyond::high),
                                      Key("mean", &Beyond::mean),
                                      Key("mean_ci95_low", &Beyond::mean_low),
                                      Key("mean_ci95_high", &Beyond::mean_high),
                                      Key("test", &Beyond::test),
                                      Key("p_holm", &Beyond::p_holm),
                                      Key("verdict", &Beyond::verdict),
                                      Key("why_open", &Beyond::why_open),
                                      Key("left_out", &Beyond::left_out)};

template <>
constexpr std::tuple kKeys<Comparison> = {Key("metric", &Comparison::metric),
                                          Key("baseline", &Comparison::baseline),
                                          Key("method", &Comparison::method),
                                          Key("pairs", &Comparison::pairs),
                                          Key("differing", &Comparison::differing),
                                          Key("only_baseline", &Comparison::only_baseline),
                                          Key("only_method", &Comparison::only_method),
                                          Key("neither", &Comparison::neither),
                                          Key("difference", &Comparison::difference),
                                          Key("ci95_low", &Comparison::ci_low),
                                          Key("ci95_high", &Comparison::ci_high),
                                          Key("interval", &Comparison::interval),
                                          Key("mean", &Comparison::mean),
                                          Key("mean_ci95_low", &Comparison::mean_low),
                                          Key("mean_ci95_high", &Comparison::mean_high),
                                          Key("signed_rank", &Comparison::signed_rank),
                                          Key("sign_flip", &Comparison::sign_flip),
                                          Key("p_holm", &Comparison::p_holm),
                                          Key("better", &Comparison::better),
                                          Key("worse", &Comparison::worse),
                                          Key("share_better", &Comparison::share_better),
                                          Key("effect_size", &Comparison::effect_size),
                                          Key("verdict", &Comparison::verdict),
                                          Key("why_open", &Comparison::why_open),
                                          Key("notes", &Comparison::notes),
                                          Key("beyond", &Comparison::beyond)};

template <>
constexpr std::tuple kKeys<Answer> = {Key("method", &Answer::method),   Key("baseline", &Answer::baseline),
                                      Key("verdict", &Answer::verdict), Key("decided_by", &Answer::decided_by),
                                      Key("beyond", &Answer::beyond),   Key("value_metric", &Answer::value_metric),
                                      Key("success", &Answer::success), Key("both_succeed", &Answer::both_succeed),
                                      Key("tail", &Answer::tail)};

template <>
constexpr std::tuple kKeys<BudgetShare> = {Key("stage", &BudgetShare::stage), Key("mean", &BudgetShare::mean),
                                           Key("mean_ci95_low", &BudgetShare::ci_low),
                                           Key("mean_ci95_high", &BudgetShare::ci_high)};

template <>
constexpr std::tuple kKeys<ErrorBudget> = {
    Key("metric", &ErrorBudget::metric), Key("method", &ErrorBudget::method), Key("shapley", &ErrorBudget::is_shapley),
    Key("worlds", &ErrorBudget::worlds), Key("total", &ErrorBudget::total),   Key("rest", &ErrorBudget::rest),
    Key("shares", &ErrorBudget::shares)};

template <>
constexpr std::tuple kKeys<ConditionSummary> = {Key("condition", &ConditionSummary::condition),
                                                Key("methods", &ConditionSummary::methods),
                                                Key("answers", &ConditionSummary::answers),
                                                Key("rival_answers", &ConditionSummary::rival_answers),
                                                Key("comparisons", &ConditionSummary::comparisons),
                                                Key("rivals", &ConditionSummary::rivals),
                                                Key("error_budgets", &ConditionSummary::budgets, When::kIfAny)};

template <>
constexpr std::tuple kKeys<AcrossVerdict::Each> = {Key("value", &AcrossVerdict::Each::value),
                                                   Key("verdict", &AcrossVerdict::Each::verdict),
                                                   Key("difference", &AcrossVerdict::Each::difference)};

template <>
constexpr std::tuple kKeys<AcrossVerdict> = {
    Key("condition", &AcrossVerdict::condition), Key("metric", &AcrossVerdict::metric),
    Key("baseline", &AcrossVerdict::baseline),   Key("method", &AcrossVerdict::method),
    Key("verdict", &AcrossVerdict::verdict),     Key("each", &AcrossVerdict::each)};

template <>
constexpr std::tuple kKeys<ExpectationResult> = {Key("text", &ExpectationResult::text),
                                                 Key("outcome", &ExpectationResult::outcome),
                                                 Key("detail", &ExpectationResult::detail)};

template <>
constexpr std::tuple kKeys<ScenarioSummary> = {Key("name", &ScenarioSummary::name),
                                               Key("task", &ScenarioSummary::task),
                                               Key("question", &ScenarioSummary::question),
                                               Key("unit", &ScenarioSummary::unit),
                                               Key("methods", &ScenarioSummary::methods),
                                               Key("headline_metrics", &ScenarioSummary::headline_metrics),
                                               Key("comparisons_in_family", &ScenarioSummary::family),
                                               Key("conditions", &ScenarioSummary::conditions),
                                               Key("expectations", &ScenarioSummary::expectations),
                                               Key("across", &ScenarioSummary::across, When::kIfAny),
                                               Key("description", &ScenarioSummary::description, When::kIfAny),
                                               Key("descriptions", &ScenarioSummary::descriptions, When::kIfAny)};

std::span<const Named<IntervalKind>> NamesOf(IntervalKind) { return kIntervalKinds; }
std::span<const Named<AnswerStep>> NamesOf(AnswerStep) { return kAnswerSteps; }
std::span<const Named<ClaimOutcome>> NamesOf(ClaimOutcome) { return kClaimOutcomes; }
std::span<const Named<SamplingUnit>> NamesOf(SamplingUnit) { return kSamplingUnits; }
std::span<const Named<Status>> NamesOf(Status) { return kStatuses; }
std::span<const Named<Verdict>> NamesOf(Verdict) { return kVerdicts; }

template <typename Enum>
Enum ByName(const std::string& name) {
  if (const auto value = FindValue(NamesOf(Enum{}), name)) return *value;
  if constexpr (std::is_same_v<Enum, Verdict>) {
    if (name == "inconclusive") return Verdict::kUndecided;  // the name in results of earlier builds
  }
  const char* what = std::is_same_v<Enum, SamplingUnit> ? "unit" : "name";
  throw Json::other_error::create(501, fmt::format("unknown {} '{}'", what, name), nullptr);
}

template <typename Value>
Json Encode(const Value& value);
template <typename Value>
void Decode(const Json& json, Value& value);

template <typename Value>
Json Encode(const std::optional<Value>& value) {
  return value ? Encode(*value) : Json(nullptr);
}

template <typename Value>
void Decode(const Json& json, std::optional<Value>& value) {
  if (!json.is_null()) Decode(json, value.emplace());
}

template <typename Value>
Json Encode(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(Encode(value));
  return list;
}

template <typename Value>
void Decode(const Json& json, std::vector<Value>& values) {
  for (const Json& entry : json) Decode(entry, values.emplace_back());
}

void Decode(const Json& json, std::vector<std::string>& texts) { json.get_to(texts); }

Json Encode(const std::vector<std::pair<Status, int>>& counts) {
  Json json = Json::object();
  for (const auto& [status, count] : counts) json[std::string(StatusName(status))] = count;
  return json;
}

void Decode(const Json& json, std::vector<std::pair<Status, int>>& counts) {
  for (const auto& [name, count] : json.items()) counts.emplace_back(ByName<Status>(name), count.get<int>());
}

template <typename Value>
Json Encode(const Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    return NameOfValue(NamesOf(value), value);
  } else if constexpr (std::tuple_size_v<decltype(kKeys<Value>)> == 0) {
    return value;
  } else {
    Json json;
    const auto write = [&](const auto& key) {
      Json held = Encode(value.*key.member);
      const bool is_empty = held.empty() || held == Json("");
      if (key.when == When::kAlways || !is_empty) json[key.name] = std::move(held);
    };
    std::apply([&](const auto&... key) { (write(key), ...); }, kKeys<Value>);
    return json;
  }
}

template <typename Value>
void Decode(const Json& json, Value& value) {
  if constexpr (std::is_enum_v<Value>) {
    value = ByName<Value>(json.get<std::string>());
  } else if constexpr (std::tuple_size_v<decltype(kKeys<Value>)> == 0) {
    json.get_to(value);
  } else {
    const auto read = [&](const auto& key) {
      if (key.when == When::kAlways || json.contains(key.name)) Decode(json.at(key.name), value.*key.member);
    };
    std::apply([&](const auto&... key) { (read(key), ...); }, kKeys<Value>);
  }
}

}  // namespace

Json EncodeSummaries(const std::vector<ScenarioSummary>& scenarios) { return {{"scenarios", Encode(scenarios)}}; }

Result<std::vector<ScenarioSummary>> DecodeSummaries(const Json& json, const Place& place) {
  std::vector<ScenarioSummary> scenarios;
  try {
    Decode(json.at("scenarios"), scenarios);
  } catch (const Json::exception& error) {
    return Fail(place, "not a summary: {}", error.what());
  }
  return scenarios;
}

}  // namespace etude
