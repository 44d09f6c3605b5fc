#include <gtest/gtest.h>

#include "engine/transitions/transition_record.h"

namespace etude {
namespace {

TEST(TransitionRecord, NamesBranchesAndOutcomes) {
  std::vector<std::string_view> names;
  for (int b = 0; b <= static_cast<int>(Branch::kUnbroken); ++b) names.push_back(BranchName(static_cast<Branch>(b)));
  for (int o = 0; o <= static_cast<int>(CandidateOutcome::kWorse); ++o) {
    names.push_back(OutcomeName(static_cast<CandidateOutcome>(o)));
  }
  EXPECT_EQ(names,
            (std::vector<std::string_view>{"none", "now", "end", "standing pose", "front half", "rear half",
                                           "in-between", "forced", "unbroken", "taken", "too far", "later", "worse"}));
}

}  // namespace
}  // namespace etude
