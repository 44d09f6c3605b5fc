#include "bench/run/plan.h"

#include <gmock/gmock.h>

#include <set>

#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

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
    EXPECT_THAT(worlds, testing::ElementsAre(0, 1, 2, 3, 4, 5)) << count << " shards";
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
  EXPECT_THAT(orders[0].methods, testing::ElementsAre(1));
  EXPECT_EQ(orders[1].world, 5u);
  EXPECT_THAT(orders[1].methods, testing::ElementsAre(0, 1));
}

TEST(Shard, IsReadAndWritten) {
  const auto shard = ParseShard("2/8");
  ASSERT_TRUE(shard);
  EXPECT_EQ(*shard, (Shard{2, 8}));
  EXPECT_EQ(ToString(*shard), "2/8");
  for (const char* bad : {"", "2", "/8", "0/8", "9/8", "2/8x", "a/b", "-1/8", "1/1000000", "2 / 8"}) {
    EXPECT_FALSE(ParseShard(bad)) << bad;
  }
}

}  // namespace
}  // namespace etude
