#include <gtest/gtest.h>

#include "engine/fuzzy/fuzzy_system.h"
#include "tests/support/replaced.h"

namespace etude {
namespace {

// The system of paper A with something else in it, and what is said of that.
std::string ComplaintOf(const std::string& found, const std::string& replacement) {
  const auto read = ReadFuzzySystem(testing::Replaced(WriteFuzzySystem({}), found, replacement), "f.yaml");
  return read ? "none" : ToString(read.error());
}

TEST(FuzzySystem, TakesWhatIsAtABoundAndNothingBeyond) {
  const auto named = [](const std::string& name) { return ComplaintOf("system: paper", "system: '" + name + "'"); };
  const auto posed = [](const std::string& pose) { return ComplaintOf("then: at rest", "then: '" + pose + "'"); };
  const auto shaped = [](const std::string& shape) { return ComplaintOf("{triangular: [20, 90, 180]}", shape); };
  EXPECT_EQ(named(std::string(80, 'a')), "none");
  EXPECT_EQ(named(std::string(81, 'a')),
            "f.yaml:1:9: '" + std::string(40, 'a') +
                "…' is not a valid name; allowed: at most 80 letters, digits, '-', '_', '.'");
  EXPECT_EQ(named("azAZ09-_."), "none");
  for (const char* bad : {"a/", "a:", "a@", "a[", "a`", "a{", "a "}) EXPECT_NE(named(bad), "none") << bad;
  EXPECT_EQ(posed("azAZ09 -x"), "none");
  EXPECT_EQ(posed(std::string(40, 'Z')), "none");
  for (const std::string& bad : {std::string(41, 'z'), std::string("0a"), std::string("a "), std::string("a/"),
                                 std::string("a:"), std::string("a@"), std::string("a["), std::string("a`"),
                                 std::string("a{"), std::string("-a"), std::string("[a"), std::string("{a")}) {
    EXPECT_NE(posed(bad), "none") << bad;
  }
  for (const char* good :
       {"{gaussian: [180, 0.001]}", "{triangular: [-1000000, 90, 1000000]}", "{singleton: 0}",
        "{trapezoidal: [5, 5, 5, 5]}", "{gaussian: [0, 30]}", "{trapezoidal: [180, 180, 190, 200]}"}) {
    EXPECT_EQ(shaped(good), "none");
  }
  EXPECT_EQ(shaped("{gaussian: [90, 0.0009]}"), "f.yaml:8:28: sigma must be at least 0.001, found 0.0009");
  EXPECT_EQ(shaped("{triangular: [20, 90, 1000001]}"), "f.yaml:8:34: 1000001 is out of range; allowed: ±1000000");
  EXPECT_EQ(shaped("{trapezoidal: [181, 182, 183, 184]}"),
            "f.yaml:8:26: no input of the universe [0, 180] has grade 1 here: the top is at 182 to 183");
  EXPECT_EQ(shaped("{singleton: -1}"),
            "f.yaml:8:24: no input of the universe [0, 180] has grade 1 here: the top is at -1");
  EXPECT_EQ(shaped("{triangular: [20, 90, 89]}"),
            "f.yaml:8:34: 'triangular' needs rising numbers [left, peak, right], found 89 after 90");
  EXPECT_EQ(shaped("{a: 1, b: 2}"),
            "f.yaml:8:12: a term needs one shape, such as {triangular: [20, 90, 180]}; found 2 keys. Allowed: "
            "triangular, trapezoidal, gaussian, singleton");
  EXPECT_EQ(ComplaintOf("weight: 1\n", "weight: 1000000\n"), "none");
  EXPECT_NE(ComplaintOf("weight: 1\n", "weight: 1000001\n"), "none");
  EXPECT_EQ(ComplaintOf("universe: [0, 180]", "universe: [-1000000, 1000000]"), "none");
  EXPECT_NE(ComplaintOf("universe: [0, 180]", "universe: [-1000001, 180]"), "none");
  EXPECT_NE(ComplaintOf("universe: [0, 180]", "universe: [180, 180]"), "none");
  std::string rules;
  for (std::size_t i = PaperRules().rules.size(); i < 100; ++i) rules += "  - {if: {RH: up}, then: more}\n";
  EXPECT_EQ(ComplaintOf("rules:\n", "rules:\n" + rules), "none");
  EXPECT_EQ(
      ComplaintOf("rules:\n", "rules:\n  - {if: {RH: up}, then: more}\n" + rules).find("'rules' must be a list of "),
      std::string("f.yaml:59:3: ").size());
}

}  // namespace
}  // namespace etude
