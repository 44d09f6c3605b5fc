#include "engine/base/cyclic_lookup.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace etude {
namespace {

TEST(CyclicLookup, FindsWhatAMapFindsInWhateverOrderItIsAsked) {
  CyclicLookup<int> things;
  std::map<std::string, int> oracle;
  std::minstd_rand dice(1);
  int found = 0, missed = 0;
  for (int i = 0; i < 5000; ++i) {
    // Names come in a cycle, with jumps and some new names.
    const std::string name = "n" + std::to_string(dice() % 10 == 0 ? dice() % 40 : static_cast<unsigned>(i) % 12);
    int* const thing = things.Find(name);
    const auto known = oracle.find(name);
    ASSERT_EQ(thing != nullptr, known != oracle.end()) << name;
    ASSERT_EQ(thing == nullptr, std::as_const(things).Find(name) == nullptr);
    if (thing == nullptr) {
      things.Add(name, i);
      oracle[name] = i;
      ++missed;
    } else {
      ASSERT_EQ(*thing, known->second);
      ++*thing, ++known->second;
      ++found;
    }
  }
  EXPECT_EQ(missed, 40);
  EXPECT_EQ(found, 5000 - missed);
  EXPECT_EQ(std::distance(things.begin(), things.end()), 40);
}

}  // namespace
}  // namespace etude
