#include "reports/junit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/reports/support/count_of.h"
#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns true if elements are closed in order, and no attribute holds a raw special character.
bool IsWellFormed(const std::string& xml) {
  std::vector<std::string> open;
  const std::regex tag(R"re(<(/?)([A-Za-z-]+)((?: [a-z]+="[^"<&]*(?:&(?:amp|lt|gt|quot|#39);[^"<&]*)*")*)(/?)>)re");
  std::size_t from = xml.find("?>") + 2;
  for (std::smatch match; from < xml.size();) {
    const std::string rest = xml.substr(from);
    if (!std::regex_search(rest, match, tag)) break;
    const std::string between = match.prefix();
    if (between.find('<') != std::string::npos) return false;
    if (match[1] == "/") {
      if (open.empty() || open.back() != match[2]) return false;
      open.pop_back();
    } else if (match[4] != "/") {
      open.push_back(match[2]);
    }
    from += between.size() + match.length();
  }
  return open.empty() && xml.find('<', from) == std::string::npos;
}

TEST(Junit, CountsWhatItHolds) {
  const std::string xml = WriteJunit(ExampleRun());
  // Three cases per scenario, and five expectations. One expectation is unmet, and cells of two scenarios failed.
  EXPECT_EQ(CountOf(xml, "<testcase "), 4 * 3 + 5);
  EXPECT_EQ(CountOf(xml, "<failure "), 1 + 2);
  EXPECT_EQ(CountOf(xml, "<skipped "), 1);
  EXPECT_EQ(CountOf(xml, "<testsuite "), 4);
  EXPECT_THAT(xml, HasSubstr("<testsuites name=\"quick\" tests=\"17\" failures=\"3\" errors=\"0\" skipped=\"1\">"));
}

TEST(Junit, FailsAScenarioThatLacksARow) {
  RunData run = ExampleRun();
  EXPECT_EQ(CountOf(WriteJunit(run), "name=\"every cell has a row\"/>"), 4);
  run.rows.pop_back();
  EXPECT_EQ(CountOf(WriteJunit(run), "name=\"every cell has a row\"/>"), 3);
}

TEST(Junit, IsWellFormedWhateverTheNames) {
  RunData run = ExampleRun();
  run.suite = "a\"<b>&'\x01";
  run.scenarios[0].expectations[0] = {"</testcase>", ClaimOutcome::kUnmet, "]]> & <x>\nand more"};
  const std::string xml = WriteJunit(run);
  EXPECT_THAT(xml, HasSubstr("<failure message=\"]]&gt; &amp; &lt;x&gt;\">]]&gt; &amp; &lt;x&gt;\nand more</failure>"));
  EXPECT_TRUE(IsWellFormed(xml)) << xml;
  EXPECT_FALSE(IsWellFormed("<?xml?><a><b></a></b>"));
  EXPECT_FALSE(IsWellFormed("<?xml?><a b=\"<\"/>"));
}

TEST(Junit, SaysWhatItsVerdictsAreAbout) {
  const std::string xml = WriteJunit(UnitRun());
  EXPECT_THAT(xml, HasSubstr("on these clips, no verdict for other clips: “"));
  EXPECT_THAT(xml, HasSubstr("<system-out>judged on these clips</system-out>"));
  EXPECT_THAT(xml, HasSubstr("<system-out>judged on these worlds</system-out>"));
  EXPECT_TRUE(IsWellFormed(xml)) << xml;
}

}  // namespace
}  // namespace etude
