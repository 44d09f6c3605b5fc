#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/plausibility.h"
#include "tests/bench/metrics/evaluators.h"

namespace etude {
namespace {

using enum FaultKind;

std::vector<MotionFault> FaultsIn(const Json& in) {
  std::vector<MotionFault> faults;
  for (const Json& fault : in.at("faults")) {
    FaultKind kind = kFloats;
    while (FaultName(kind) != fault.at("kind").get<std::string>())
      kind = static_cast<FaultKind>(static_cast<int>(kind) + 1);
    faults.push_back({kind, fault.at("from_s"), fault.at("to_s"), std::nullopt, fault.at("size")});
  }
  return faults;
}

template <FaultKind kind>
Value Share(const Json& in) {
  return FaultyShare(FaultsIn(in), kind, in.at("duration_s"));
}

template <FaultKind kind, int factor>
Value Largest(const Json& in) {
  return factor * LargestFault(FaultsIn(in), kind);
}

template <FaultKind kind>
Value Count(const Json& in) {
  return FaultCount(FaultsIn(in), kind);
}

Value WithinLimits(const Json& in) {
  const auto limits = in.at("limits").get<std::map<std::string, double>>();
  if (limits.empty()) return std::nullopt;
  return BeyondLimits(in.at("values").get<std::map<std::string, double>>(), limits).empty() ? 1 : 0;
}

}  // namespace

std::span<const Evaluator> PlausibilityEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"faults", [](const Json& in) -> Value { return static_cast<double>(FaultsIn(in).size()); }},
      {"floats_share", Share<kFloats>},
      {"floats_max_cm", Largest<kFloats, 100>},
      {"sinks_share", Share<kSinks>},
      {"sinks_max_cm", Largest<kSinks, 100>},
      {"skates_share", Share<kSkates>},
      {"skates_max_cmps", Largest<kSkates, 100>},
      {"jumps", Count<kJumps>},
      {"jumps_max_cm", Largest<kJumps, 100>},
      {"pops", Count<kPops>},
      {"pops_max_cm", Largest<kPops, 100>},
      {"freezes_share", Share<kFreezes>},
      {"stretches_max_percent", Largest<kStretches, 100>},
      {"torn_max_cm", Largest<kTorn, 100>},
      {"gaps_share", Share<kGaps>},
      {"bends_share", Share<kBends>},
      {"bends_max_deg", Largest<kBends, 1>},
      {"passes_share", Share<kPasses>},
      {"wrong_rate",
       [](const Json& in) -> Value {
         return FaultCount(FaultsIn(in), kRate) + FaultCount(FaultsIn(in), kSpeed) > 0 ? 1 : 0;
       }},
      {"fault_free", [](const Json& in) -> Value { return FaultsIn(in).empty() ? 1 : 0; }},
      {"within_limits", WithinLimits},
  };
  return kAll;
}

}  // namespace etude
