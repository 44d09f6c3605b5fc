#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/scenario/scenario.h"

namespace etude {

inline const std::string kHead = "scenario: s\nquestion: q?\ntask: ik\n";
inline const std::string kMethods = "methods: [{name: a}, {name: b}]\n";

/// Parses the scenarios of "s.yaml", which may include the texts of `more`.
inline Result<std::vector<Scenario>> Parse(const std::string& yaml, SourceTexts more = {}) {
  more["s.yaml"] = yaml;
  return ParseScenarios("s.yaml", more);
}

inline Scenario ParseOne(const std::string& yaml) {
  const auto scenarios = Parse(yaml);
  EXPECT_TRUE(scenarios) << ToString(scenarios.error()) << "\n" << yaml;
  if (!scenarios) return {};
  EXPECT_EQ(scenarios->size(), 1u);
  return scenarios->front();
}

/// Returns the error message about an invalid text in one line; "" if the text is valid.
inline std::string Complaint(const std::string& yaml, const SourceTexts& more = {}) {
  const auto scenarios = Parse(yaml, more);
  const std::string complaint = scenarios ? "" : ToString(scenarios.error());
  EXPECT_THAT(complaint, ::testing::Not(::testing::HasSubstr("\n")));
  return complaint;
}

}  // namespace etude
