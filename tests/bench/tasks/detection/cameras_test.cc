#include <gmock/gmock.h>

#include <cmath>

#include "tests/bench/tasks/detection/detection_fixture.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

class DetectionCameras : public DetectionFixture {};

constexpr const char* kTruth = "methods: [{name: truth, oracle: [stream]}]\n";

/// Returns the largest difference of the running evidence of two cells.
double FarthestApart(const CellResult& a, const CellResult& b) {
  double farthest = 0;
  const auto &x = a.series.back().values, &y = b.series.back().values;
  EXPECT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i) farthest = std::max(farthest, std::abs(x[i] - y[i]));
  return farthest;
}

TEST_F(DetectionCameras, HEAVY_WhoseEveryStageIsTrueJudgeAsThePerfectSensorDoes) {
  ASSERT_OK(task, MakeTask(R"(
sensor: cameras
events: 1
people: expert
fault_share: 0
methods:
  - {name: truth, oracle: [stream]}
  - name: perfect
    capture: {oracle: [calibration, segmentation, marks, directions, points, lengths, start, ik]}
  - name: perfect-causal
    capture: {causal: true, oracle: [calibration, segmentation, marks, directions, points, lengths, start, ik]}
  - {name: marked}
)",
                           FourMoves()));
  const auto cells = RunWorld(**task, World(0), 4);
  for (const CellResult& cell : cells) ASSERT_EQ(cell.status, Status::kOk) << cell.reason;
  constexpr double kTolerance = 1e-3;  // evidence is 0 to 1; 1e-3 corresponds to skeletons within 0.1 mm
  for (const std::size_t perfect : {1u, 2u}) {
    EXPECT_LT(FarthestApart(cells[perfect], cells[0]), kTolerance);
    EXPECT_EQ(ValueOf(cells[perfect], "recall"), ValueOf(cells[0], "recall"));
    EXPECT_EQ(ValueOf(cells[perfect], "false_alarms_per_min"), ValueOf(cells[0], "false_alarms_per_min"));
  }
  EXPECT_GT(FarthestApart(cells[3], cells[0]), 10 * kTolerance) << "the control";
}

TEST_F(DetectionCameras, TellNoStreamToMethodsOutside) {
  ASSERT_OK(task, MakeTask(std::string("sensor: cameras\nevents: 1\n") + kTruth, FourMoves()));
  EXPECT_FALSE((*task)->MakeWorld(World(0), false)->MakeProblem());
}

}  // namespace
}  // namespace etude
