#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/run/setup.h"

namespace etude {

/// A scenario of two conditions, three trials and two methods that runs quickly.
inline const std::string kSmallScenario = R"(
scenario: small
question: Does it run?
task: ik
trials: 3
max_sweeps: 20
sweep: {joint_noise_deg: [2, 5]}
methods:
  - {name: fixed, solver: ccd, weights: fixed}
  - {name: least-squares, solver: damped-least-squares}
)";

inline SuiteSetup SmallSuite(const std::string& text = kSmallScenario) {
  SuiteSetup suite{.suite = "small", .seed = 1, .sources = {{"small.yaml", text}}, .scenarios = {}, .scored = {}};
  suite.scenarios.push_back({.file = "small.yaml",
                             .name = "small",
                             .seed = 1,
                             .trials = 3,
                             .clips = {},
                             .joint_map = "",
                             .digest = "of the text"});
  return suite;
}

inline std::vector<PreparedScenario> Prepared(const SuiteSetup& suite) {
  auto scenarios = PrepareAll(suite);
  EXPECT_TRUE(scenarios) << ToString(scenarios.error());
  return std::move(*scenarios);
}

}  // namespace etude
