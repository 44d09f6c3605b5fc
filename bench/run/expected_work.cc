#include "bench/run/expected_work.h"

namespace etude {

ExpectedWork::ExpectedWork(const Plan& plan, const std::map<std::string, KeptCost>& kept) : plan_(plan) {
  double cells_known = 0, work_known = 0;
  for (const PreparedScenario& one : plan.scenarios()) {
    const Scenario& scenario = one.scenario();
    const auto cost = kept.find(WorkOf(scenario));
    const double trials = one.setup().trials;
    const double cells = static_cast<double>(scenario.conditions.size() * scenario.methods.size()) * trials;
    const double work = cost == kept.end() ? 0 : cost->second.once + cost->second.trial * trials;
    per_cell_.push_back(work / cells);
    work_known += work;
    cells_known += work > 0 ? cells : 0;
  }
  is_known_ = work_known > 0;
  const double usual = is_known_ ? work_known / cells_known : 1;
  for (double& work : per_cell_) work = work > 0 ? work : usual;
}

}  // namespace etude
