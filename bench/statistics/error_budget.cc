#include "bench/statistics/error_budget.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "bench/statistics/bootstrap.h"

namespace etude {
namespace {

using Stages = std::set<std::string>;

/// A method and the stages that it has true.
struct Member {
  std::string method;
  Stages stages;
};

bool Holds(const Stages& all, const Stages& some) { return std::ranges::includes(all, some); }

Stages Without(const Stages& all, const Stages& some) {
  Stages rest;
  std::ranges::set_difference(all, some, std::inserter(rest, rest.end()));
  return rest;
}

/// The methods that differ in nothing but their oracle, by what they have in common, in the study's order.
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

/// The chain from the member with the fewest stages on, each the smallest that holds the one before.
std::vector<Member> ChainOf(const std::vector<Member>& family) {
  std::vector<Member> chain;
  for (const Member& member : family) {
    if (chain.empty() || Holds(member.stages, chain.back().stages)) chain.push_back(member);
  }
  return chain;
}

/// The values of the members' methods in the worlds where all of them have one, by method.
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

class BudgetMaker {
 public:
  BudgetMaker(const std::vector<Member>& family, const ConditionTable& table, const std::string& metric,
              std::uint64_t seed, std::string purpose)
      : family_(family), table_(table), metric_(metric), seed_(seed), purpose_(std::move(purpose)) {}

  std::optional<ErrorBudget> Make() {
    const Stages stages = Without(family_.back().stages, family_.front().stages);
    const bool is_whole =
        stages.size() <= kMostShapleyStages && family_.size() == std::size_t{1} << stages.size() &&
        std::ranges::all_of(family_, [&](const Member& member) {
          return Holds(family_.back().stages, member.stages) && Holds(member.stages, family_.front().stages);
        });
    const std::vector<Member> members = is_whole ? family_ : ChainOf(family_);
    values_ = ValuesOf(members, table_, metric_);
    if (values_.empty() || members.size() < 2) return std::nullopt;
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
  void AddStep(const Member& before, const Member& after) {
    std::string name;
    for (const std::string& stage : Without(after.stages, before.stages)) name += (name.empty() ? "" : ", ") + stage;
    std::vector<double> saved = values_[before.method];
    const std::vector<double>& left = values_[after.method];
    for (std::size_t i = 0; i < saved.size(); ++i) saved[i] -= left[i];
    AddShare(name, saved);
  }

  // By world: Σ |S|! (n − |S| − 1)! / n! · (v(S) − v(S ∪ stage)) over all S without the stage.
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
    std::string purpose = "budget/" + study.scenario + "/" + metric + "/" + family.front().method;
    for (const SweptValue& swept : table.condition) purpose += "/" + swept.key + "=" + swept.value;
    if (auto budget = BudgetMaker(family, table, metric, seed, std::move(purpose)).Make()) {
      budgets.push_back(std::move(*budget));
    }
  }
  return budgets;
}

}  // namespace etude
