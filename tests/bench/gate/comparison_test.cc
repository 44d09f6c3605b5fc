#include "bench/gate/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/gate/example.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const TailRules kNoTails = {{"s", TailRule{.times = 1, .worlds = 0, .lost = 0}}};

Snapshot SnapshotOf(const MakeResult& make, const std::string& extra = "") {
  return TakeSnapshot(ExampleRun(make, extra));
}

Snapshot Reference() {
  return SnapshotOf([](int trial, const std::string&) { return ExampleResult(trial); });
}

/// Returns the move of method a's metric, which must be the same under both conditions.
MetricMove MoveOf(const Snapshot& after, const std::string& metric, const std::set<std::string>& exact = {},
                  const TailRules& tails = {}) {
  const SnapshotComparison comparison = CompareSnapshots(Reference(), after, exact, tails);
  EXPECT_EQ(comparison.moves.size(), 2u * 2 * 3);  // conditions, methods; two metrics and the share of ok cells
  for (const MetricMove& move : comparison.moves) {
    if (move.identity.method == "b") {
      EXPECT_EQ(move.movement, Movement::kSame);
    }
  }
  for (const MetricMove& move : comparison.moves) {
    if (move.identity.method == "a" && move.identity.metric == metric) return move;
  }
  ADD_FAILURE() << metric;
  return {};
}

/// Returns a snapshot in which method a is shifted by `shift(trial)`.
Snapshot Shifted(const std::function<double(int)>& shift) {
  return SnapshotOf(
      [&](int trial, const std::string& method) { return ExampleResult(trial, method == "a" ? shift(trial) : 0); });
}

TEST(Snapshots, OfTheSameRunDoNotDiffer) {
  for (const std::set<std::string>& exact : {std::set<std::string>{}, {"s"}}) {
    const SnapshotComparison comparison = CompareSnapshots(Reference(), Reference(), exact);
    EXPECT_EQ(comparison.moves.size(), 12u);
    for (const MetricMove& move : comparison.moves) EXPECT_EQ(move.movement, Movement::kSame);
    EXPECT_THAT(comparison.only_before, IsEmpty());
    EXPECT_THAT(comparison.only_after, IsEmpty());
  }
}

TEST(Snapshots, WeighCellsAsTheSummaryDoes) {
  // The last of four windows has as much power as the other three together.
  const auto snapshot = [](std::optional<double> last) {
    SnapshotScenario scenario;
    scenario.name = "s";
    scenario.trials = 4;
    SnapshotCells cells;
    cells.method = "a";
    cells.statuses = "oooo";
    cells.metrics = {{"npss", {0.1, 0.2, 0.3, last}}, {"npss_power", {1.0, 1.0, 1.0, 3.0}}};
    scenario.cells = {cells};
    Snapshot made;
    made.scenarios = {scenario};
    return made;
  };
  const auto npss_of = [&](std::optional<double> before, std::optional<double> after) {
    std::vector<MetricMove> moves = CompareSnapshots(snapshot(before), snapshot(after), {}).moves;
    return *std::ranges::find(moves, "npss", [](const MetricMove& move) { return move.identity.metric; });
  };
  const MetricMove worse = npss_of(1.0, 1.5);
  EXPECT_NEAR(*worse.before, (0.1 + 0.2 + 0.3 + 3 * 1.0) / 6, 1e-12);
  EXPECT_NEAR(*worse.after, (0.1 + 0.2 + 0.3 + 3 * 1.5) / 6, 1e-12);
  EXPECT_NEAR(*worse.comparison.mean, 3 * 0.5 / 6, 1e-8);
  // A lost world changes only the mean of the snapshot that lost it.
  const MetricMove lost = npss_of(1.0, std::nullopt);
  EXPECT_NEAR(*lost.before, (0.1 + 0.2 + 0.3 + 3 * 1.0) / 6, 1e-12);
  EXPECT_NEAR(*lost.after, (0.1 + 0.2 + 0.3) / 3, 1e-12);
  EXPECT_EQ(lost.lost, 1);
}

/// Returns a snapshot of 24 clips with one method, as task evaluation makes it.
Snapshot SnapshotOfFiles(double error_mm, double seen_share, const JudgedOn& judged) {
  SnapshotScenario scenario;
  scenario.name = "evaluate";
  scenario.trials = 24;
  SnapshotCells cells{"-", "mine", std::string(24, 'o'), {{"seen_share", {}}, {"mpjpe_unaligned_mm", {}}}};
  for (int trial = 0; trial < 24; ++trial) {
    cells.metrics[0].values.emplace_back(seen_share);
    cells.metrics[1].values.emplace_back(error_mm + 0.1 * trial);
  }
  cells.judged.assign(24, judged);
  scenario.worlds = {{"-", "w"}};
  scenario.methods = {{"mine", "m"}};
  scenario.metrics = {{"seen_share", 2}, {"mpjpe_unaligned_mm", 1}};
  scenario.cells = {cells};
  Snapshot made;
  made.scenarios = {scenario};
  return made;
}

TEST(Snapshots, AreNotBetterByFewerJointsOrFrames) {
  const JudgedOn all = {{"head", "left_wrist"}, 30, {}}, fewer_joints = {{"head"}, 30, {}};
  const JudgedOn fewer_frames = {{"head", "left_wrist"}, 30, {{"mpjpe_unaligned_mm", 0.96}}};
  const Snapshot before = SnapshotOfFiles(40, 1, all);
  const auto moves_to = [&](const Snapshot& after) {
    const SnapshotComparison comparison = CompareSnapshots(before, after, {});
    EXPECT_EQ(comparison.moves.size(), 3u);  // the share of ok cells, and two metrics
    return std::pair(comparison.moves[1], comparison.moves[2]);
  };
  EXPECT_EQ(moves_to(SnapshotOfFiles(30, 1, all)).second.movement, Movement::kBetter);
  const auto [wrists, error] = moves_to(SnapshotOfFiles(30, 0.5, fewer_joints));
  EXPECT_EQ(wrists.movement, Movement::kWorse);
  EXPECT_EQ(error.movement, Movement::kUndecided);
  EXPECT_EQ(error.comparison.not_alike, "not judged alike: only “before” is judged on left_wrist");
  const auto [share, of_frames] = moves_to(SnapshotOfFiles(30, 0.96, fewer_frames));
  EXPECT_EQ(share.movement, Movement::kWorse);
  EXPECT_EQ(of_frames.movement, Movement::kUndecided);
  // A method that answers more is not worse, either: values that are far worse do not count.
  const SnapshotComparison more =
      CompareSnapshots(SnapshotOfFiles(40, 0.5, fewer_joints), SnapshotOfFiles(400, 1, all), {});
  EXPECT_EQ(more.moves[1].movement, Movement::kBetter);
  EXPECT_EQ(more.moves[2].movement, Movement::kUndecided);
  EXPECT_THAT(more.moves[2].tail, IsEmpty());
}

TEST(Snapshots, TellAClearDifferenceThatMattersFromOneThatDoesNot) {
  const auto wobble = [](int trial) { return 0.001 * (trial % 5); };
  const auto movement = [&](double size) {
    return MoveOf(Shifted([&](int trial) { return size + wobble(trial); }), "position_error_cm").movement;
  };
  EXPECT_EQ(movement(1), Movement::kWorse);
  EXPECT_EQ(movement(-1), Movement::kBetter);
  EXPECT_EQ(movement(0.01), Movement::kNoMatter);  // 0.05 cm is the practical threshold
}

TEST(Snapshots, CallADifferenceUnclearThatTheWorldsDoNotSettle) {
  const auto torn = Shifted([](int trial) { return trial % 2 == 0 ? 3.0 : -3.1; });
  EXPECT_EQ(MoveOf(torn, "position_error_cm", {}, kNoTails).movement, Movement::kUndecided);
  EXPECT_EQ(MoveOf(torn, "position_error_cm").movement, Movement::kWorse);  // twelve worlds are far worse
}

TEST(Snapshots, SeeARegressionInFewerThanHalfOfTheWorlds) {
  const auto third = Shifted([](int trial) { return trial % 3 == 0 ? 2.0 + 0.01 * trial : 0.0; });
  const MetricMove move = MoveOf(third, "position_error_cm");
  EXPECT_EQ(move.comparison.difference, 0);  // the median alone shows no difference
  EXPECT_EQ(move.differing, 8);
  EXPECT_EQ(move.movement, Movement::kWorse);
  EXPECT_TRUE(move.by_mean);
  // A test of very few worlds has no power: the change must not be called too small to matter.
  const auto once = Shifted([](int trial) { return trial == 7 ? 50.0 : 0.0; });
  EXPECT_EQ(MoveOf(once, "position_error_cm").movement, Movement::kUndecided);
}

TEST(Snapshots, DifferByTheLastDigitUnderTheExactRuleInEitherDirection) {
  for (double sign : {-1, 1}) {
    const auto last_digit = Shifted([&](int trial) { return trial == 7 ? sign * 4e-15 : 0.0; });
    const MetricMove move = MoveOf(last_digit, "position_error_cm", {"s"});
    EXPECT_EQ(move.movement, Movement::kChanged);
    EXPECT_EQ(move.differing, 1);
    EXPECT_NE(MoveOf(last_digit, "position_error_cm").movement, Movement::kWorse);
  }
}

Snapshot Ending(Status status, int trials) {
  return SnapshotOf([&](int trial, const std::string& method) {
    if (method != "a" || trial >= trials) return ExampleResult(trial);
    CellResult result = CellResult::Ended(status, "gave up");
    result.Missing("position_error_cm", "gave up");
    result.Measure("solved_practical", 0);
    return result;
  });
}

TEST(Snapshots, CountFailuresAndLostValuesAgainstTheMethod) {
  for (Status status : {Status::kFailed, Status::kUnsolved, Status::kBadOutput}) {
    const Snapshot after = Ending(status, 12);
    EXPECT_EQ(MoveOf(after, kOkShare).movement, Movement::kWorse);
    const MetricMove lost = MoveOf(after, "position_error_cm");
    EXPECT_EQ(lost.lost, 12);
    EXPECT_EQ(lost.comparison.pairs, 12);
    EXPECT_EQ(lost.movement, Movement::kWorse);  // the remaining values did not change
  }
  for (Status status : {Status::kFailed, Status::kUnsolved}) {  // Ending leaves out the value of kUnsolved, too
    EXPECT_EQ(MoveOf(Ending(status, 1), "position_error_cm").movement, Movement::kWorse);
    EXPECT_EQ(MoveOf(Ending(status, 1), "position_error_cm", {}, kNoTails).movement, Movement::kUndecided);
  }
  EXPECT_EQ(MoveOf(Ending(Status::kFailed, 1), kOkShare).movement, Movement::kWorse);
  EXPECT_EQ(MoveOf(Ending(Status::kUnsolved, 1), kOkShare).movement, Movement::kUndecided);
  EXPECT_EQ(MoveOf(Ending(Status::kFailed, 1), "position_error_cm", {"s"}).movement, Movement::kChanged);
}

TEST(Snapshots, LeaveOutWorldsWhoseEndDependsOnTheMachine) {
  for (Status status : {Status::kTimeout, Status::kCrashed, Status::kOutOfMemory}) {
    const MetricMove move = MoveOf(Ending(status, 12), kOkShare);
    EXPECT_EQ(move.movement, Movement::kSame);
    EXPECT_EQ(move.worlds, 12);
  }
}

TEST(Snapshots, SeeAStatusChangeUnderTheExactRule) {
  const auto with = [](Status status) {
    return SnapshotOf([=](int trial, const std::string& method) {
      CellResult result = ExampleResult(trial);
      if (method == "a") result.status = status;
      return result;
    });
  };
  for (const auto& [exact, expected] : {std::pair<std::set<std::string>, Movement>{{"s"}, Movement::kChanged},
                                        std::pair<std::set<std::string>, Movement>{{}, Movement::kSame}}) {
    const SnapshotComparison found = CompareSnapshots(with(Status::kUnsolved), with(Status::kFailed), exact);
    EXPECT_EQ(found.moves[0].identity.metric, kOkShare);
    EXPECT_EQ(found.moves[0].movement, expected);
  }
}

TEST(Snapshots, ListWhatOnlyOneOfThemHolds) {
  Snapshot less = Reference();
  less.scenarios[0].cells[3].metrics.pop_back();
  less.scenarios[0].cells.erase(less.scenarios[0].cells.begin());
  const SnapshotComparison comparison = CompareSnapshots(Reference(), less, {});
  EXPECT_THAT(comparison.only_before,
              ElementsAre("s, joint_noise_deg=1, a", "s, joint_noise_deg=2, b, solved_practical"));
  EXPECT_EQ(CompareSnapshots(less, Reference(), {}).only_after, comparison.only_before);
  EXPECT_EQ(comparison.moves.size(), 12u - 3 - 1);
  EXPECT_THAT(CompareSnapshots(Reference(), {}, {}).only_before, ElementsAre("s"));
}

/// Returns the reference with one file per world: "f0", "f1", … by trial, each with its own truth.
Snapshot OfFiles() {
  Snapshot snapshot = Reference();
  for (int t = 0; t < snapshot.scenarios[0].trials; ++t) {
    snapshot.scenarios[0].files.emplace_back("f" + std::to_string(t), "truth" + std::to_string(t));
  }
  return snapshot;
}

Snapshot Without(Snapshot snapshot, int trial) {
  SnapshotScenario& scenario = snapshot.scenarios[0];
  --scenario.trials;
  scenario.files.erase(scenario.files.begin() + trial);
  for (SnapshotCells& cells : scenario.cells) {
    cells.statuses.erase(static_cast<std::size_t>(trial), 1);
    for (SnapshotValues& values : cells.metrics) values.values.erase(values.values.begin() + trial);
  }
  return snapshot;
}

TEST(Snapshots, OfFilesAreComparedByNameWhateverTheTrial) {
  const Snapshot all = OfFiles(), fewer = Without(OfFiles(), 3);
  EXPECT_THAT(WhyNotComparable(fewer, all), IsEmpty());
  const SnapshotComparison more = CompareSnapshots(fewer, all, {});
  for (const MetricMove& move : more.moves) EXPECT_EQ(move.movement, Movement::kSame) << move.identity.metric;
  EXPECT_THAT(more.only_before, IsEmpty());
  EXPECT_THAT(more.only_after, ElementsAre("s, f3"));
  EXPECT_THAT(CompareSnapshots(all, fewer, {}).only_before, ElementsAre("s, f3"));
  // The control: if worlds are matched by trial instead of file, most of them differ.
  Snapshot nameless = fewer, others = all;
  nameless.scenarios[0].files.clear();
  others.scenarios[0].files.clear();
  EXPECT_THAT(WhyNotComparable(nameless, others), ElementsAre("s: the number of trials was 23 and is 24"));
  const SnapshotComparison shifted = CompareSnapshots(nameless, others, {});
  EXPECT_TRUE(std::ranges::any_of(shifted.moves, [](const MetricMove& move) { return move.differing > 5; }));
}

TEST(Snapshots, OfFilesLeaveOutAWorldWhoseTruthIsAnother) {
  Snapshot changed = OfFiles();
  changed.scenarios[0].files[7].second = "another";
  const SnapshotComparison comparison = CompareSnapshots(OfFiles(), changed, {});
  EXPECT_THAT(comparison.only_before, ElementsAre("s, f7, its truth"));
  EXPECT_THAT(comparison.only_after, ElementsAre("s, f7, its truth"));
  EXPECT_EQ(comparison.moves.front().worlds, 23);
}

TEST(Snapshots, AFarWorseFileIsNamedByItsTrialInTheLaterRun) {
  Snapshot later = Without(OfFiles(), 3);
  SnapshotValues& values = later.scenarios[0].cells[0].metrics[0];
  ASSERT_TRUE(values.values[9]);
  *values.values[9] += 1e6;  // the value of file "f10"
  const SnapshotComparison comparison = CompareSnapshots(OfFiles(), later, {});
  const auto move = std::ranges::find_if(comparison.moves, [&](const MetricMove& one) {
    return one.identity.metric == values.metric && !one.tail.empty();
  });
  ASSERT_NE(move, comparison.moves.end());
  EXPECT_EQ(move->tail.front().trial, 9);
}

TEST(Snapshots, AreComparableWhateverDoesNotShapeWorlds) {
  const auto same = [](int trial, const std::string&) { return ExampleResult(trial); };
  const Snapshot annotated = SnapshotOf(same, "expect: [{metric: position_error_cm, of: a, at_most: 99}]  # new\n");
  EXPECT_THAT(WhyNotComparable(Reference(), annotated), IsEmpty());
  EXPECT_THAT(WhyNotComparable(Reference(), SnapshotOf(same, "max_sweeps: 7\n")),
              ElementsAre(HasSubstr("joint_noise_deg=1, the two runs have different parameters"),
                          HasSubstr("joint_noise_deg=2, the")));
}

TEST(Snapshots, AreNotComparableWithOtherSeedsTrialsClipsOrMetricVersions) {
  const auto complaint = [](const std::function<void(SnapshotScenario&)>& change) {
    Snapshot after = Reference();
    change(after.scenarios[0]);
    const std::vector<std::string> reasons = WhyNotComparable(Reference(), after);
    Snapshot before = Reference();
    EXPECT_EQ(DropIncomparable(before, after), reasons);
    EXPECT_EQ(before.scenarios.size(), reasons.empty() ? 1u : 0u);
    return reasons.empty() ? "" : reasons.front();
  };
  EXPECT_EQ(complaint([](SnapshotScenario&) {}), "");
  EXPECT_EQ(complaint([](SnapshotScenario& s) { s.seed = 6; }), "s: the seed was 5 and is 6");
  EXPECT_EQ(complaint([](SnapshotScenario& s) { s.trials = 23; }), "s: the number of trials was 24 and is 23");
  EXPECT_EQ(complaint([](SnapshotScenario& s) { s.metrics[0].second = 9; }),
            "s: the version of position_error_cm was 1 and is 9");
  const FinishedRun other_clip =
      ExampleRun([](int trial, const std::string&) { return ExampleResult(trial); }, "", "another");
  EXPECT_EQ(WhyNotComparable(Reference(), TakeSnapshot(other_clip)).size(), 2u);
}

}  // namespace
}  // namespace etude
