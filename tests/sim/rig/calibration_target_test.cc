#include "sim/rig/calibration_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/cameras/dlt.h"
#include "sim/choreography/canonical_body.h"
#include "sim/render/renderer.h"
#include "sim/rig/rig.h"
#include "tests/sim/render/smooth_picture.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<Board> BoardsOf(const std::vector<PlacedBoard>& placed) {
  std::vector<Board> boards;
  for (const PlacedBoard& one : placed) boards.push_back(one.board);
  return boards;
}

TEST(CalibrationTarget, IsACubeWithItsFrontsOutsideAndSharesNoCode) {
  const glm::dvec3 middle(0.4, 0, -0.3), centre = middle + glm::dvec3(0, 0.9, 0);
  std::set<int> codes;
  for (const PlacedBoard& placed : CalibrationTarget(middle)) {
    EXPECT_NEAR(glm::dot(placed.right_W, placed.down_W), 0, 1e-12);
    const glm::dvec3 towards_viewer = glm::cross(placed.down_W, placed.right_W);
    const glm::dvec3 board = placed.At(0.5 * placed.board.square * glm::dvec2(placed.board.columns, placed.board.rows));
    EXPECT_NEAR(glm::dot(board - centre, towards_viewer), 0.6, 1e-12);
    EXPECT_NEAR(glm::distance(board, centre), 0.6, 1e-12);
    for (int i = 0; i < CountCodes(placed.board); ++i) {
      EXPECT_TRUE(codes.insert(placed.board.first_code + i).second);
    }
  }
  EXPECT_LT(*codes.rbegin(), kCodeCount);
}

TEST(CalibrationTarget, IsFoundInRenderedPicturesAndCalibratesTheirCameras) {
  ASSERT_OK(renderer, SharedRenderer());
  const std::vector<BodyPose> motion{StandingPose()};
  const std::vector<PlacedBoard> target = CalibrationTarget(MiddleOnFloor(motion));
  for (int trial = 0; trial < 3; ++trial) {
    const WorldKey key{.suite_seed = 3, .scenario = "target", .trial = trial};
    for (const Camera& camera : SetUpCameras({}, motion, key)) {
      const ColourImage picture = DrawSmooth(**renderer, {Figure{{}, {}, SurfacesOf(target)}}, camera);
      const std::vector<PointPair> pairs = PairsOf(target, FindBoards(picture, BoardsOf(target)));
      ASSERT_GE(pairs.size(), 30u) << trial << ": two sides of 16 corners";
      double squares = 0;
      for (const PointPair& pair : pairs) {
        const double error = glm::distance(*Project(MatrixOf(camera), pair.world), pair.pixel);
        EXPECT_LT(error, 1) << trial;
        squares += error * error;
      }
      EXPECT_LT(std::sqrt(squares / static_cast<double>(pairs.size())), 0.3) << "four rays a pixel";

      ASSERT_OK(matrix, Calibrate(pairs, Calibration::kDltNormalised)) << trial;
      const glm::dvec3 head(0, 1.6, 0.3);  // no board has its centre there
      EXPECT_LT(glm::distance(*Project(*matrix, head), *Project(MatrixOf(camera), head)), 1.5);
    }
  }
}

}  // namespace
}  // namespace etude
