#include "bench/run/plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "sim/random/stream.h"
#include "tests/bench/run/prepared.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;

TEST(Plan, NumbersCellsInCanonicalOrder) {
  const auto scenarios = Prepared(SmallSuite());
  const Plan plan(scenarios);
  ASSERT_EQ(plan.world_count(), 6u);
  ASSERT_EQ(plan.cell_count(), 12u);
  EXPECT_EQ(plan.IdentityOf(0).Id(), "small/joint_noise_deg=2/000/fixed");
  EXPECT_EQ(plan.IdentityOf(1).Id(), "small/joint_noise_deg=2/000/least-squares");
  EXPECT_EQ(plan.IdentityOf(11).Id(), "small/joint_noise_deg=5/002/least-squares");
  for (std::size_t world = 0; world < plan.world_count(); ++world) {
    for (std::size_t method = 0; method < plan.MethodCount(world); ++method) {
      EXPECT_EQ(plan.WorldOf(plan.CellAt(world, method)), world);
    }
  }
}

TEST(Plan, ShardsShareOutEveryWorldOnce) {
  const auto scenarios = Prepared(SmallSuite());
  const Plan plan(scenarios);
  const std::vector<bool> nothing(plan.cell_count(), false);
  for (int count : {1, 2, 4, 6, 9}) {
    std::multiset<std::size_t> worlds;
    for (int index = 1; index <= count; ++index) {
      for (const Order& order : plan.OrdersFor({index, count}, nothing)) worlds.insert(order.world);
    }
    EXPECT_THAT(worlds, ::testing::ElementsAre(0, 1, 2, 3, 4, 5)) << count << " shards";
  }
}

TEST(Plan, OrdersOnlyWhatIsLeft) {
  const auto scenarios = Prepared(SmallSuite());
  const Plan plan(scenarios);
  std::vector<bool> done(plan.cell_count(), true);
  done[3] = done[10] = done[11] = false;
  const auto orders = plan.OrdersFor(Shard{}, done);
  ASSERT_EQ(orders.size(), 2u);
  EXPECT_EQ(orders[0].world, 1u);
  EXPECT_THAT(orders[0].methods, ::testing::ElementsAre(1));
  EXPECT_EQ(orders[1].world, 5u);
  EXPECT_THAT(orders[1].methods, ::testing::ElementsAre(0, 1));
}

SuiteSetup SecretSuite(const std::string& text = kSmallScenario) {
  SuiteSetup suite = SmallSuite(text);
  suite.seed = suite.scenarios.front().seed = Seed::Secret({1, 2, 3, 4});
  return suite;
}

std::uint64_t FirstDieOf(const PreparedScenario& scenario, int condition, int trial) {
  return RandomStream(scenario.KeyOf(condition, trial), "pose").Bits();
}

TEST(KeyOfWorld, IsSharedByConditionsOfAnOpenSeedAlone) {
  const auto open = Prepared(SmallSuite()), secret = Prepared(SecretSuite());
  EXPECT_EQ(open[0].KeyOf(0, 1).scenario, "small") << "golden worlds hang on it";
  std::set<std::uint64_t> dice;
  for (int trial = 0; trial < 3; ++trial) {
    EXPECT_EQ(FirstDieOf(open[0], 0, trial), FirstDieOf(open[0], 1, trial));
    for (int condition = 0; condition < 2; ++condition) dice.insert(FirstDieOf(secret[0], condition, trial));
  }
  EXPECT_EQ(dice.size(), 6u);
}

TEST(KeyOfWorld, OfASecretConditionIsThatOfItsValuesWhateverElseIsSwept) {
  std::string more = kSmallScenario;
  more.replace(more.find("[2, 5]"), 6, "[1, 5, 2]");
  const auto secret = Prepared(SecretSuite()), swept_more = Prepared(SecretSuite(more));
  EXPECT_EQ(FirstDieOf(secret[0], 0, 2), FirstDieOf(swept_more[0], 2, 2));
  EXPECT_EQ(FirstDieOf(secret[0], 1, 2), FirstDieOf(swept_more[0], 1, 2));
  EXPECT_NE(FirstDieOf(secret[0], 0, 2), FirstDieOf(swept_more[0], 0, 2));
}

TEST(Plan, OrdersSecretTrialsOtherwiseUnderEveryCondition) {
  SuiteSetup suite = SecretSuite();
  suite.scenarios.front().trials = 12;
  const auto scenarios = Prepared(suite);
  const Plan plan(scenarios);
  std::vector<int> trials[2];
  for (const Order& order : plan.OrdersFor({}, std::vector<bool>(plan.cell_count()))) {
    trials[plan.world(order.world).condition].push_back(plan.world(order.world).trial);
  }
  EXPECT_NE(trials[0], trials[1]);
  EXPECT_FALSE(std::ranges::is_sorted(trials[0]));
}

TEST(Shard, IsReadAndWritten) {
  ASSERT_OK(shard, ParseShard("2/8"));
  EXPECT_EQ(*shard, (Shard{2, 8}));
  EXPECT_EQ(ToString(*shard), "2/8");
  for (const char* bad : {"", "2", "/8", "0/8", "9/8", "2/8x", "a/b", "-1/8", "1/1000000", "2 / 8"}) {
    EXPECT_FALSE(ParseShard(bad)) << bad;
  }
}

/// Two conditions of three worlds each: worlds 0 to 2, and worlds 3 to 5.
class OrderQueueTest : public ::testing::Test {
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
