#include "engine/capture/adjust_take.h"

#include <gtest/gtest.h>

#include "tests/engine/capture/marked_body.h"
#include "tests/support/gaps.h"
#include "tests/support/results.h"

namespace etude {
namespace {

const LimbLengths kTall{.foot = 0.2,
                        .shank = 0.46,
                        .thigh = 0.45,
                        .hip_width = 0.2,
                        .trunk = 0.55,
                        .neck = 0.26,
                        .shoulder_width = 0.4,
                        .upper_arm = 0.31,
                        .forearm = 0.27,
                        .hand = 0.19};

std::vector<BodyPose> Poses(int count, double step, const CaptureBody& body) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < count; ++k) poses.push_back(ToBodyPose(body, ModelState(body.tree, step * k)));
  return poses;
}

double LargestError(const AdjustedTake& take, const std::vector<BodyPose>& truth) {
  double largest = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    largest = std::max(largest, WorstJointDistance(ToBodyPose(take.body, take.states[k]), truth[k]));
  }
  return largest;
}

AdjustTakeOptions Exact() {
  AdjustTakeOptions options;
  options.bundle.max_iterations = 100;
  options.bundle.min_decrease = 1e-14;
  return options;
}

struct FilmedTake {
  std::vector<ProjectionMatrix> cameras = {CameraAt(-40, 1), CameraAt(40, 2.2)};
  std::vector<BodyPose> poses;
  TakeMarks marks;

  explicit FilmedTake(std::vector<BodyPose> filmed) : poses(std::move(filmed)), marks(ExactMarks(poses, cameras)) {}
  MeasureInputs pictures() const { return {.cameras = cameras, .marks = marks}; }
  std::vector<OptionalJoints> Start() const { return InterpolateJoints(MeasureJoints(pictures())); }
};

TEST(AdjustTake, GivesPosesOfPaperBsBodyBackFromExactMarks) {
  const CaptureBody body = PaperBody(kTall);
  const FilmedTake film(Poses(4, 0.3, body));
  const auto start = film.Start();
  const AdjustedTake take = AdjustTake({.pictures = film.pictures(), .lengths = body.lengths, .start = start}, Exact());
  ASSERT_TRUE(take.is_solved);
  EXPECT_LT(LargestError(take, film.poses), 1e-7);

  LimbLengths wrong = kTall;
  wrong.thigh -= 0.05;
  const AdjustedTake with_wrong = AdjustTake({.pictures = film.pictures(), .lengths = wrong, .start = start}, Exact());
  EXPECT_GT(LargestError(with_wrong, film.poses), 0.01) << "the control";
}

TEST(AdjustTake, FindsTheLengthsAsWell) {
  const FilmedTake film(Poses(6, 0.3, PaperBody(kTall)));
  AdjustTakeOptions options = Exact();
  options.bundle.adjusts_lengths = true;
  const auto start = film.Start();
  const AdjustedTake take = AdjustTake({.pictures = film.pictures(), .lengths = {}, .start = start}, options);
  ASSERT_TRUE(take.is_solved);
  const auto found = ListOf(take.body.lengths), truth = ListOf(kTall);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], 1e-7) << i;
}

TEST(AdjustTake, IsNotThrownByAGrossErrorUnlessItTrustsAllMarksAlike) {
  const CaptureBody body = PaperBody({});
  FilmedTake film(Poses(5, 0.02, body));
  *film.marks[0][2].effectors[3] += glm::dvec2(120, 60);
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (StrokeMarks()[i].from == Role::kRightElbow) film.marks[0][2].strokes[i]->a += glm::dvec2(0, -90);
  }
  const auto start = film.Start();
  const auto error = [&](RobustLoss loss) {
    AdjustTakeOptions options;
    options.bundle.loss = loss;
    options.bundle.smoothness = SmoothnessOf(MakeTakeBody(body.lengths), 30);
    return LargestError(AdjustTake({.pictures = film.pictures(), .lengths = body.lengths, .start = start}, options),
                        film.poses);
  };
  EXPECT_LT(error(RobustLoss::kCauchy), 0.03);
  EXPECT_GT(error(RobustLoss::kNone), 2 * error(RobustLoss::kCauchy));
}

TEST(AdjustTake, IsNotSolvedWhereNothingIsSeen) {
  const CaptureBody body = PaperBody({});
  const FilmedTake film(Poses(2, 0.1, body));
  const TakeMarks nothing(2, std::vector<Marks>(2));
  const std::vector<OptionalJoints> start(2);
  const MeasureInputs pictures{.cameras = film.cameras, .marks = nothing};
  EXPECT_FALSE(AdjustTake({.pictures = pictures, .lengths = body.lengths, .start = start}).is_solved);
}

TEST(MeasureLengths, FindsThoseOfExactMarksAndNothingWhereNothingIsSeen) {
  const FilmedTake film(Poses(30, 0.1, PaperBody(kTall)));
  const auto measured = MeasureJoints(film.pictures());
  ASSERT_OK(lengths, MeasureLengths(film.pictures(), measured));
  const auto found = ListOf(*lengths), truth = ListOf(kTall);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], 1e-4) << i;

  const TakeMarks nothing(2, std::vector<Marks>(30));
  const MeasureInputs pictures{.cameras = film.cameras, .marks = nothing};
  EXPECT_FALSE(MeasureLengths(pictures, MeasureJoints(pictures)));
}

// Lengths over all frames average the errors of single marks.
TEST(MeasureLengths, IsCloserThanTheDistancesOfTriangulatedJoints) {
  FilmedTake film(Poses(30, 0.1, PaperBody(kTall)));
  int n = 0;
  for (auto& of_camera : film.marks) {
    for (Marks& marks : of_camera) {
      for (auto& stroke : marks.strokes) {
        ++n;
        stroke->a += 3.0 * glm::dvec2(std::sin(97.0 * n * n), std::cos(89.0 * n * n));
        stroke->b += 3.0 * glm::dvec2(std::sin(83.0 * n * n), std::cos(79.0 * n * n));
      }
    }
  }
  ASSERT_OK(lengths, MeasureLengths(film.pictures(), MeasureJoints(film.pictures())));
  const auto found = ListOf(*lengths), truth = ListOf(kTall);
  for (std::size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(found[i], truth[i], 0.015) << i;
}

}  // namespace
}  // namespace etude
