#include "bench/run/order_queue.h"

#include <gmock/gmock.h>

#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

using testing::ElementsAre;

/// Two conditions of three worlds each: worlds 0 to 2, and 3 to 5.
class OrderQueueTest : public testing::Test {
 protected:
  std::size_t TakenBy(std::size_t& worker) { return queue_.Take(worker).world; }

  const std::vector<PreparedScenario> scenarios_ = Prepared(SmallSuite());
  const Plan plan_{scenarios_};
  bool long_worlds_ = false;
  OrderQueue queue_{plan_, plan_.OrdersFor({}, std::vector<bool>(plan_.cell_count())),
                    [this](int) { return long_worlds_; }};
  std::size_t anna_ = OrderQueue::kNowhere, bert_ = OrderQueue::kNowhere;
};

TEST_F(OrderQueueTest, OneWorkerTakesAllInTheOrderOfThePlan) {
  std::vector<std::size_t> worlds;
  while (!queue_.empty()) worlds.push_back(TakenBy(anna_));
  EXPECT_THAT(worlds, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST_F(OrderQueueTest, WorkersStayWithAConditionOfTheirOwnAndThenHelpTheOther) {
  EXPECT_EQ(TakenBy(anna_), 0u);
  EXPECT_EQ(TakenBy(bert_), 3u);
  EXPECT_EQ(TakenBy(anna_), 1u);
  EXPECT_EQ(TakenBy(anna_), 2u);
  EXPECT_EQ(TakenBy(anna_), 4u) << "hers is done";
  EXPECT_EQ(TakenBy(bert_), 5u);
  EXPECT_TRUE(queue_.empty());
}

TEST_F(OrderQueueTest, WhatIsPutBackComesFirstInItsCondition) {
  Order first = queue_.Take(anna_);
  Order other = queue_.Take(bert_);
  first.methods = {1};
  queue_.PutBack(std::move(first));
  queue_.PutBack(std::move(other));
  EXPECT_EQ(queue_.size(), 6u);
  const Order again = queue_.Take(anna_);
  EXPECT_EQ(again.world, 0u);
  EXPECT_THAT(again.methods, ElementsAre(1u));
  EXPECT_EQ(TakenBy(bert_), 3u);
}

TEST_F(OrderQueueTest, ANewWorkerGoesWhereMostIsLeftWhenEveryConditionWasBegun) {
  TakenBy(anna_), TakenBy(anna_), TakenBy(bert_);
  std::size_t carla = OrderQueue::kNowhere;
  EXPECT_EQ(TakenBy(carla), 4u);
  EXPECT_EQ(TakenBy(carla), 5u);
  EXPECT_EQ(TakenBy(carla), 2u);
  EXPECT_TRUE(queue_.empty());
}

TEST_F(OrderQueueTest, LongWorldsAreHelpedWithBeforeAnotherConditionIsBegun) {
  long_worlds_ = true;
  EXPECT_EQ(TakenBy(anna_), 0u);
  EXPECT_EQ(TakenBy(bert_), 1u);
  EXPECT_EQ(TakenBy(anna_), 2u);
  EXPECT_EQ(TakenBy(bert_), 3u);
}

}  // namespace
}  // namespace etude
