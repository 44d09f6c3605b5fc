#include "reports/paper/paper_b_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Paper B's rows are foot, right hand, left hand, head; in the tree the left hand comes before the right one.
constexpr int kEffectorOfRow[] = {0, 2, 1, 3};
constexpr int kTrials = 12;

std::vector<PaperBCondition> Tables() {
  const RunData run = EffectorRun();
  return PaperBTables(run, run.scenarios[2]);
}

TEST(PaperBTables, AreMadeForEveryConditionWhoseCellsKeepEffectorsErrors) {
  const RunData run = EffectorRun();
  const auto conditions = PaperBTables(run, run.scenarios[2]);
  ASSERT_EQ(conditions.size(), 3u);
  for (const PaperBCondition& condition : conditions) {
    ASSERT_EQ(condition.sets.size(), 2u);
    for (const PaperBSet& set : condition.sets) {
      EXPECT_EQ(set.errors.size(), 1u + 4u);  // before, and after each of four methods
      EXPECT_EQ(set.outcomes.size(), 4u);
    }
    EXPECT_EQ(condition.sets[0].angles.size(), 4u);      // from the start
    EXPECT_EQ(condition.sets[1].angles.size(), 2 * 4u);  // from the start and from the truth
  }
  for (const std::size_t other : {0, 1, 3}) EXPECT_TRUE(PaperBTables(run, run.scenarios[other]).empty());
  const RunData without = ExampleRun();
  EXPECT_TRUE(PaperBTables(without, without.scenarios[2]).empty());
}

TEST(PaperBTables, OfOneTrialHoldItsFiguresInThePapersRowsAndColumns) {
  const PaperBSet set = Tables()[1].sets[0];
  EXPECT_EQ(set.title, "trial 0");
  EXPECT_THAT(set.replay, StartsWith("etude replay RUN --cell 'ik-weights/joint_noise_deg=10/000/"));
  EXPECT_EQ(set.errors[0].caption, "(a) before");
  EXPECT_EQ(set.errors[2].caption, "(c) after fixed-tuned");
  int checked = 0;
  for (int row = 0; row < 4; ++row) {
    const int e = kEffectorOfRow[row];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(set.errors[0].rows[row].values[axis], StartPositionError(0, e, axis));
      for (int method = 0; method < 4; ++method) {
        const std::vector<std::optional<double>>& values = set.errors[1 + method].rows[row].values;
        ASSERT_EQ(values.size(), 6u);
        EXPECT_EQ(values[axis], PositionError(method, 0, e, axis));
        EXPECT_EQ(values[3 + axis], OrientationError(method, 0, e, axis));
        ++checked;
      }
    }
  }
  EXPECT_EQ(checked, 4 * 3 * 4);
  EXPECT_EQ(set.errors[1].rows[1].label, "R_hand");
}

TEST(PaperBTables, OfAllTrialsHoldMediansOfSizesSoThatSidesDoNotCancel) {
  const PaperBSet set = Tables()[0].sets[1];
  EXPECT_EQ(set.title, "all 12 trials");
  EXPECT_EQ(set.replay, "");
  // Sizes grow with the trial, so the median lies between trials 5 and 6, whose signs differ.
  const double expected = (std::abs(PositionError(3, 5, 2, 1)) + std::abs(PositionError(3, 6, 2, 1))) / 2;
  EXPECT_NEAR(*set.errors[4].rows[1].values[1], expected, 1e-12);
  EXPECT_GT(*set.errors[0].rows[0].values[0], 30);
}

TEST(PaperBTables, OfHiddenAnglesHaveTheJointsOfThePaperAndNoAxisThatAJointLacks) {
  const PaperTable table = Tables()[0].sets[0].angles[2];
  EXPECT_THAT(table.caption, StartsWith("(h) adaptive: "));
  ASSERT_EQ(table.rows.size(), 14u);
  const auto tree = MakeBodyTree({});
  int dofs = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const TreeJoint& joint = tree.joints[kPaperBJoints[i].joint];
    for (int axis = 0; axis < 3; ++axis) {
      const auto& value = table.rows[i].values[axis];
      EXPECT_EQ(value.has_value(), axis < joint.dof_count);
      if (!value) continue;
      EXPECT_DOUBLE_EQ(*value, AngleChange(2, 0, joint.first_dof + axis));
      ++dofs;
    }
  }
  EXPECT_EQ(dofs, 29);
  EXPECT_EQ(table.rows[0].label, "R_shoulder");
  EXPECT_EQ(table.rows[13].label, "L_ankle");
}

TEST(PaperBTables, ShowNoAxisThatThePaperPrintsAsZero) {
  const std::vector<PaperTable> printed = PaperBPrintedAngles();
  const PaperTable ours = Tables()[0].sets[0].angles[0];
  for (const PaperTable& table : printed) {
    ASSERT_EQ(table.rows.size(), ours.rows.size());
    for (std::size_t i = 0; i < ours.rows.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(ours.rows[i].values[axis].has_value(), *table.rows[i].values[axis] != 0) << table.rows[i].label;
      }
    }
  }
}

TEST(PaperBPrintedAngles, StopAtTheBoundsOfTable52eAndPassThemIn52d) {
  const std::vector<PaperTable> printed = PaperBPrintedAngles();
  ASSERT_EQ(printed.size(), 2u);
  const auto at = [&](int table, const char* joint, int axis) {
    return *std::ranges::find(printed[table].rows, joint, &PaperRow::label)->values[axis];
  };
  EXPECT_EQ(at(0, "R_hipbone", 2), 31.813163);
  EXPECT_EQ(at(1, "R_hipbone", 2), 15);
  EXPECT_EQ(at(1, "R_ankle", 0), 12);
  EXPECT_EQ(at(1, "L_hipbone", 0), 10);
  EXPECT_EQ(at(1, "L_ankle", 0), 3.807206);
}

TEST(PaperBTables, OfHiddenAnglesOverAllTrialsAreRootMeanSquares) {
  const PaperBSet set = Tables()[0].sets[1];
  double sum = 0;
  const int dof = MakeBodyTree({}).joints[kTreeNeck].first_dof + 2;
  for (int trial = 0; trial < kTrials; ++trial) sum += std::pow(AngleChange(1, trial, dof), 2);
  const double expected = std::sqrt(sum / kTrials);
  EXPECT_NEAR(*set.angles[1].rows[6].values[2], expected, 1e-9);
  EXPECT_NEAR(*set.angles[4 + 1].rows[6].values[2], expected / 2, 1e-9);
}

TEST(PaperBTables, SayWhyAMethodHasNoTable) {
  RunData run = EffectorRun();
  for (Row& row : run.rows) {
    if (row.scenario != "ik-weights" || row.method != "fixed-tuned") continue;
    row.result = CellResult::Ended(Status::kTimeout, "took longer than 2 s");
    std::erase_if(run.series, [&](const CellSeries& cell) { return cell.cell == row.Id(); });
  }
  const PaperBCondition condition = PaperBTables(run, run.scenarios[2])[0];
  ASSERT_EQ(condition.sets[0].errors.size(), 4u);
  EXPECT_EQ(condition.sets[0].errors[2].caption, "(c) after adaptive");
  EXPECT_EQ(condition.sets[0].outcomes[1], "fixed-tuned: timeout (took longer than 2 s)");
  EXPECT_THAT(condition.sets[1].outcomes[1], HasSubstr("0 of 12 ok; only 0 of them have results"));
}

TEST(PaperBTables, TakeASeriesThatIsTooShortForMissingValues) {
  RunData run = EffectorRun();
  for (CellSeries& cell : run.series) {
    for (Series& series : cell.series) {
      if (series.name == "position_error_x_cm") series.values.resize(1);
    }
  }
  const PaperTable table = PaperBTables(run, run.scenarios[2])[0].sets[0].errors[1];
  EXPECT_TRUE(table.rows[0].values[0].has_value());
  EXPECT_FALSE(table.rows[3].values[0].has_value());
}

}  // namespace
}  // namespace etude
