#include "bench/outside/conformance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/tasks/registry.h"
#include "io/clips/clip_library.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

struct Examined {
  Result<bool> passed;
  std::vector<ConformanceCheck> checks;
};

Examined Examine(const std::string& task, std::vector<std::string> command, const std::string& seat = "") {
  Examined examined;
  examined.passed = CheckConformance({.command = std::move(command), .task = task, .time_s = 20}, seat,
                                     [&](const ConformanceCheck& check) { examined.checks.push_back(check); });
  return examined;
}

struct Example {
  std::string task, file, seat = "";
};

const std::vector<Example> kExamples = {{"ik", "ik_dls.py"},
                                        {"ik", "ik_lm_numpy.py"},
                                        {"tracking", "tracking_dls.py"},
                                        {"transition", "transition_nearest.py"},
                                        {"transition", "transition_arrays_numpy.py"},
                                        {"detection", "detection_correlation.py"},
                                        {"inbetween", "inbetween_cubic_numpy.py"},
                                        {"inbetween", "inbetween_network_numpy.py"},
                                        {"coach", "coach_recogniser.py", "recogniser"},
                                        {"coach", "coach_policy.py", "policy"},
                                        {"coach", "coach_learner.py", "learner"},
                                        {"capture", "capture_triangulation_numpy.py"},
                                        {"capture", "capture_segmenter.py", "segmenter"}};

class Examples : public ::testing::TestWithParam<Example> {};

TEST_P(Examples, PassEveryCheck) {
  const auto [passed, checks] =
      Examine(GetParam().task, {"/usr/bin/python3", "examples/outside-methods/" + GetParam().file}, GetParam().seat);
  ASSERT_TRUE(passed) << ToString(passed.error());
  EXPECT_TRUE(*passed);
  EXPECT_EQ(checks.size(), 9u);
  for (const ConformanceCheck& check : checks) EXPECT_TRUE(check.passed) << check.name << ": " << check.found;
}

INSTANTIATE_TEST_SUITE_P(Conformance, Examples, ::testing::ValuesIn(kExamples),
                         [](const auto& tested) { return tested.param.file.substr(0, tested.param.file.find('.')); });

TEST(Conformance, KnowsEveryTaskThatHasNoExampleToo) {
  for (const TaskKind& kind : AllTaskKinds()) {
    if (std::ranges::find(kExamples, kind.name, &Example::task) != kExamples.end()) continue;
    const auto specimens = MakeSpecimens(kind.name, kind.seats.empty() ? "" : kind.seats.front());
    if (!kind.has_problems && kind.seats.empty()) {
      EXPECT_FALSE(specimens) << kind.name << " asks no program";
      continue;
    }
    ASSERT_TRUE(specimens) << kind.name << ": " << ToString(specimens.error());
    EXPECT_EQ(specimens->size(), 2u) << kind.name;
  }
}

TEST(Conformance, HEAVY_PassesWhoAnswersThatItSeesNothing) {
  const std::string blind = R"({"poses": [null, null, null]})";
  const auto [passed, checks] = Examine("capture", {"python3", "tests/bench/outside/hostile.py", "is_good", blind});
  ASSERT_TRUE(passed) << ToString(passed.error());
  EXPECT_TRUE(*passed);
  EXPECT_THAT(checks.at(1).found, HasSubstr("0 of 3 answers solve their problem"));
}

struct Misfit {
  std::string behaviour, check, found;
};

class Misfits : public ::testing::TestWithParam<Misfit> {};

TEST_P(Misfits, AreFoundOut) {
  const std::string angles = R"({"angles_deg": [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,)"
                             R"( 0, 0, 0, 0, 0, 0]})";
  const Misfit& misfit = GetParam();
  const auto [passed, checks] = Examine("ik", {"python3", "tests/bench/outside/hostile.py", misfit.behaviour, angles});
  ASSERT_TRUE(passed) << ToString(passed.error());
  EXPECT_FALSE(*passed);
  const auto failed = std::find_if(checks.begin(), checks.end(), [](const auto& check) { return !check.passed; });
  ASSERT_NE(failed, checks.end());
  EXPECT_EQ(failed->name, misfit.check);
  EXPECT_THAT(failed->found, HasSubstr(misfit.found));
}

INSTANTIATE_TEST_SUITE_P(
    Conformance, Misfits,
    ::testing::Values(Misfit{"speaks_another_protocol", "starts and greets", "does not support protocol 1"},
                      Misfit{"prints_garbage", "gives answers that can be scored",
                             "bad_output: wrote something that is not JSON: 'loading"},
                      Misfit{"answers_large", "gives answers that can be scored", "its answer cannot be scored: "},
                      Misfit{"counts_its_problems", "gives the same answer to a repeated problem", "first '"},
                      Misfit{"remembers_the_first_problem",
                             "gives the same answers after a restart and in another order", "first '"},
                      Misfit{"refuses_what_it_does_not_know",
                             "accepts long lines, unknown keys and ids with any characters", "not JSON"},
                      Misfit{"answers_twice", "answers every question once", "answers were repeated"},
                      Misfit{"stays_after_the_end", "ends when its input ends",
                             "the program was still running 2 s "
                             "after its input ended"}),
    [](const auto& tested) { return tested.param.behaviour; });

TEST(Conformance, TellsWhenThereIsNothingToExamine) {
  EXPECT_THAT(ToString(Examine("ki", {"true"}).passed.error()), HasSubstr("did you mean 'ik'?"));
  EXPECT_THAT(ToString(Examine("ik", {"no-such-program"}).passed.error()), HasSubstr("no program 'no-such-program'"));
}

}  // namespace
}  // namespace etude
