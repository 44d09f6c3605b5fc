#include "bench/run/order_queue.h"

#include <algorithm>
#include <utility>

namespace etude {

OrderQueue::OrderQueue(const Plan& plan, std::vector<Order> orders) : left_(orders.size()) {
  for (Order& order : orders) {
    const World& world = plan.world(order.world);
    const bool is_same = !conditions_.empty() && plan.world(first_worlds_.back()).scenario == world.scenario &&
                         plan.world(first_worlds_.back()).condition == world.condition;
    if (!is_same) {
      conditions_.emplace_back();
      first_worlds_.push_back(order.world);
    }
    conditions_.back().push_back(std::move(order));
  }
}

Order OrderQueue::Take(std::size_t& condition) {
  if (condition == kNowhere || conditions_[condition].empty()) {
    while (begun_ < conditions_.size() && conditions_[begun_].empty()) ++begun_;
    condition = begun_ < conditions_.size() ? begun_++ : ConditionWithMost();
  }
  Order order = std::move(conditions_[condition].front());
  conditions_[condition].pop_front();
  --left_;
  return order;
}

void OrderQueue::PutBack(Order order) {
  const auto after = std::ranges::upper_bound(first_worlds_, order.world);
  const auto condition = static_cast<std::size_t>(after - first_worlds_.begin()) - 1;
  conditions_[condition].push_front(std::move(order));
  ++left_;
}

std::size_t OrderQueue::ConditionWithMost() const {
  const auto most = std::ranges::max_element(conditions_, {}, &std::deque<Order>::size);
  return static_cast<std::size_t>(most - conditions_.begin());
}

}  // namespace etude
