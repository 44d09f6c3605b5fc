#include "bench/run/order_queue.h"

#include <algorithm>
#include <utility>

namespace etude {

OrderQueue::OrderQueue(const Plan& plan, std::vector<Order> orders, std::function<bool(int scenario)> is_long)
    : is_long_(std::move(is_long)), left_(orders.size()) {
  for (Order& order : orders) {
    const World& world = plan.world(order.world);
    const bool is_same = !conditions_.empty() && conditions_.back().scenario == world.scenario &&
                         plan.world(conditions_.back().first_world).condition == world.condition;
    if (!is_same) conditions_.push_back({world.scenario, order.world});
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
