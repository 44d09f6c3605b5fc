#include "bench/run/plan.h"

#include <algorithm>
#include <charconv>
#include <tuple>
#include <utility>

#include "sim/random/stream.h"

namespace etude {

Result<Shard> ParseShard(const std::string& text) {
  constexpr int kMaxShards = 100'000;
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  const bool has_slash = index.ec == std::errc() && index.ptr != end && *index.ptr == '/';
  const auto count = has_slash ? std::from_chars(index.ptr + 1, end, shard.count) : index;
  if (!has_slash || count.ec != std::errc() || count.ptr != end || shard.index < 1 || shard.count < shard.index ||
      shard.count > kMaxShards) {
    return Fail({}, "'{}' is not a shard; allowed: i/n with 1 ≤ i ≤ n ≤ {}, such as 2/8", text, kMaxShards);
  }
  return shard;
}

std::string ToString(const Shard& shard) { return fmt::format("{}/{}", shard.index, shard.count); }

Plan::Plan(std::span<const PreparedScenario> scenarios) : scenarios_(scenarios), first_cells_{0} {
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const int conditions = static_cast<int>(scenarios[s].scenario().conditions.size());
    for (int c = 0; c < conditions; ++c) {
      for (int t = 0; t < scenarios[s].setup().trials; ++t) {
        worlds_.push_back({static_cast<int>(s), c, t});
        first_cells_.push_back(first_cells_.back() + scenarios[s].scenario().methods.size());
      }
    }
  }
}

std::size_t Plan::WorldOf(std::size_t cell) const {
  const auto after = std::upper_bound(first_cells_.begin(), first_cells_.end(), cell);
  return static_cast<std::size_t>(after - first_cells_.begin()) - 1;
}

Row Plan::IdentityOf(std::size_t cell) const {
  const std::size_t at = WorldOf(cell);
  return scenario_of(at).IdentityOf(worlds_[at].condition, worlds_[at].trial, cell - CellAt(at, 0));
}

std::vector<Order> Plan::OrdersFor(const Shard& shard, const std::vector<bool>& done) const {
  std::vector<Order> orders;
  for (std::size_t world = 0; world < worlds_.size(); ++world) {
    if (!IsIn(shard, world)) continue;
    Order order{world, {}};
    for (std::size_t method = 0; method < MethodCount(world); ++method) {
      if (!done[CellAt(world, method)]) order.methods.push_back(method);
    }
    if (!order.methods.empty()) orders.push_back(std::move(order));
  }
  if (std::ranges::all_of(scenarios_, [](const auto& one) { return one.setup().seed.IsPlain(); })) return orders;
  // Shuffle secret trials. Otherwise a method could learn the trial by counting its problems.
  const auto rank = [this](const Order& order) {
    const World& world = worlds_[order.world];
    const PreparedScenario& scenario = scenarios_[world.scenario];
    const bool is_plain = scenario.setup().seed.IsPlain();
    return std::tuple(
        world.scenario, world.condition,
        is_plain ? 0 : RandomStream(scenario.KeyOf(world.condition, world.trial), "exchange/order").Bits());
  };
  std::ranges::stable_sort(orders, {}, rank);
  return orders;
}

OrderQueue::OrderQueue(const Plan& plan, std::vector<Order> orders, std::function<bool(int scenario)> is_long)
    : is_long_(std::move(is_long)), left_(orders.size()) {
  for (Order& order : orders) {
    const World& world = plan.world(order.world);
    const bool is_same = !conditions_.empty() && conditions_.back().scenario == world.scenario &&
                         plan.world(conditions_.back().first_world).condition == world.condition;
    if (!is_same) conditions_.push_back({world.scenario, order.world});
    conditions_.back().first_world = std::min(conditions_.back().first_world, order.world);
    conditions_.back().orders.push_back(std::move(order));
  }
}

Order OrderQueue::Take(std::size_t& condition) {
  if (condition == kNowhere || conditions_[condition].orders.empty()) condition = Choose();
  std::deque<Order>& orders = conditions_[condition].orders;
  Order order = std::move(orders.front());
  orders.pop_front();
  --left_;
  return order;
}

void OrderQueue::PutBack(Order order) {
  const auto after = std::ranges::upper_bound(conditions_, order.world, {}, &Condition::first_world);
  const auto condition = static_cast<std::size_t>(after - conditions_.begin()) - 1;
  conditions_[condition].orders.push_front(std::move(order));
  ++left_;
  if (std::ranges::find(open_, condition) == open_.end()) open_.push_back(condition);
}

std::size_t OrderQueue::Choose() {
  std::erase_if(open_, [&](std::size_t condition) { return conditions_[condition].orders.empty(); });
  const auto with_most = std::ranges::max_element(open_, {}, [&](std::size_t condition) {
    const Condition& one = conditions_[condition];
    return std::pair(is_long_(one.scenario), one.orders.size());
  });
  if (with_most != open_.end() && (begun_ == conditions_.size() || is_long_(conditions_[*with_most].scenario))) {
    return *with_most;
  }
  open_.push_back(begun_);
  return begun_++;
}

}  // namespace etude
