#pragma once

#include <string>
#include <vector>

#include "bench/gate/self_test.h"
#include "bench/gate/tail_rule.h"

namespace etude {

/// Makes few worlds of a snapshot far worse, and counts in how many gates that is found: every one in which the tail
/// rule says so, and no other by this rule.
class InjectedTails {
 public:
  /// Changes `target` (scenario 0, cells 0, this metric) of copies of `first`: n worlds worse by twice the rule's
  /// `times`, n = 1, 2, 3, 5, 10 and as many as fail by the rule; that many by nine tenths of it; one value lost.
  /// `seed` keys which worlds.
  void Try(const Snapshot& first, const std::string& target, std::uint64_t seed, const TailRule& rule);

  std::vector<PowerResult> Results() const;
  /// Whether all gates did as the rule says.
  bool AsTheRuleSays() const { return as_the_rule_says_; }

 private:
  struct Case {
    std::string change;
    int found = 0, of = 0;
  };
  void Count(const std::string& change, bool must_be_found, const SnapshotComparison& comparison);

  std::vector<Case> cases_;
  bool as_the_rule_says_ = true;
};

}  // namespace etude
