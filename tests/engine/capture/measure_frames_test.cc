#include "engine/capture/measure_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "engine/base/directions.h"
#include "engine/cameras/limb_direction.h"
#include "engine/kinematics/limb_lengths.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

FrameMeasurement MeasureFrame(const std::vector<ProjectionMatrix>& cameras, const TakeMarks& marks,
                              const MeasureOptions& options = {}) {
  return MeasureFrames({.cameras = cameras, .marks = marks}, options).at(0);
}

std::vector<ProjectionMatrix> MeasuringCameras() { return {ThreeCameras()[0], ThreeCameras()[1]}; }

/// Checks that every direction found is the pose's; returns their number.
int CountTrueDirections(const FrameMeasurement& found, const BodyPose& pose) {
  int count = 0;
  for (const StrokeMark& mark : StrokeMarks()) {
    const auto& direction = found.directions[Index(mark.to)];
    if (!direction) continue;
    EXPECT_LT(Degrees(AngleBetween(*direction, LimbOf(pose, mark))), 1e-6) << RoleName(mark.to);
    ++count;
  }
  return count;
}

std::size_t StrokeTo(Role role) {
  std::size_t i = 0;
  while (StrokeMarks()[i].to != role) ++i;
  return i;
}

TEST(Strokes, AreThoseOfTheLimbsThatTheSkeletonNeeds) {
  ASSERT_EQ(ObservedLimbs().size(), kStrokeCount);
  for (Role limb : ObservedLimbs()) {
    int found = 0;
    for (const StrokeMark& mark : StrokeMarks()) found += mark.to == limb;
    EXPECT_EQ(found, 1) << RoleName(limb);
  }
}

TEST(MeasureFrames, FindsTheTruthInExactMarksOfTwoCamerasOrThree) {
  for (const auto& cameras : {MeasuringCameras(), ThreeCameras()}) {
    for (double phase : {0.0, 1.0, 2.0, 3.0}) {
      const BodyPose pose = ModelPose(phase);
      const FrameMeasurement found = MeasureFrame(cameras, ExactMarks({pose}, cameras));
      int ends = 0;
      for (Role role : AllRoles()) {
        if (!found.ends[Index(role)]) continue;
        EXPECT_LT(glm::distance(*found.ends[Index(role)], pose[role]), 1e-6) << RoleName(role);
        ++ends;
      }
      EXPECT_EQ(ends, 5);
      EXPECT_GE(CountTrueDirections(found, pose), cameras.size() == 2 ? 11 : 13)
          << "of thirteen; with two cameras some may be ill-conditioned";
    }
  }
}

TEST(MeasureFrames, FindsSomethingElseWhenTheCamerasAreMixedUp) {
  const auto cameras = ThreeCameras();
  const BodyPose pose = ModelPose();
  const FrameMeasurement found = MeasureFrame({cameras[1], cameras[0], cameras[2]}, ExactMarks({pose}, cameras));
  for (const EffectorMark& mark : EffectorMarks()) {
    const auto& end = found.ends[Index(mark.role)];
    EXPECT_TRUE(!end || glm::distance(*end, pose[mark.role]) > 0.01) << RoleName(mark.role);
  }
}

TEST(MeasureFrames, NeedsTwoPicturesThatShowAMark) {
  const BodyPose pose = ModelPose();
  TakeMarks two = ExactMarks({pose}, MeasuringCameras()), three = ExactMarks({pose}, ThreeCameras());
  for (TakeMarks* marks : {&two, &three}) {
    (*marks)[0][0].effectors[0].reset();
    (*marks)[0][0].strokes[0].reset();
  }
  const Role end = EffectorMarks()[0].role, limb = StrokeMarks()[0].to;
  const FrameMeasurement one_left = MeasureFrame(MeasuringCameras(), two),
                         two_left = MeasureFrame(ThreeCameras(), three);
  EXPECT_FALSE(one_left.ends[Index(end)]);
  EXPECT_FALSE(one_left.directions[Index(limb)]);
  EXPECT_TRUE(one_left.ends[Index(EffectorMarks()[1].role)]);
  ASSERT_TRUE(two_left.ends[Index(end)]);
  EXPECT_LT(glm::distance(*two_left.ends[Index(end)], pose[end]), 1e-6);
  EXPECT_EQ(CountTrueDirections(two_left, pose), 13);
}

TEST(MeasureFrames, SeesWithAThirdCameraALimbThatLiesInAPlaneThroughTheOthers) {
  const std::vector<ProjectionMatrix> level = {CameraAt(-40, 1), CameraAt(40, 1)};
  const std::vector<ProjectionMatrix> with_high = {level[0], level[1], CameraAt(0, 2.5)};
  BodyPose pose = ModelPose();
  pose[Role::kLeftElbow] = {0.1, 1, 0.1};
  pose[Role::kLeftWrist] = {0.4, 1, 0.1};  // as high as the first two cameras
  const std::size_t forearm = Index(Role::kLeftWrist);
  EXPECT_FALSE(MeasureFrame(level, ExactMarks({pose}, level)).directions[forearm]);
  ASSERT_OK(found, MeasureFrame(with_high, ExactMarks({pose}, with_high)).directions[forearm]);
  EXPECT_LT(Degrees(AngleBetween(*found, {1, 0, 0})), 1e-6);
}

// A forearm points almost at one camera, whose stroke is reversed by mistake. The other cameras see it at full length
// and decide its sense.
TEST(MeasureFrames, TakesTheSenseOfALimbFromTheCamerasThatSeeItBest) {
  const auto cameras = ThreeCameras();
  for (std::size_t careless = 0; careless < 3; ++careless) {
    const double degrees[] = {-40, 40, 100}, heights[] = {1, 2.2, 1.5};
    const double a = Radians(degrees[careless]);
    const glm::dvec3 eye(3.8 * std::sin(a), heights[careless], 3.8 * std::cos(a));
    BodyPose pose = ModelPose();
    const glm::dvec3 elbow(0.1, 1.1, 0.1);
    const glm::dvec3 towards = glm::normalize(glm::normalize(eye - elbow) + glm::dvec3(0, 0.3, 0));
    pose[Role::kLeftElbow] = elbow;
    pose[Role::kLeftWrist] = elbow + 0.25 * towards;
    TakeMarks marks = ExactMarks({pose}, cameras);
    PixelSegment& stroke = *marks[careless][0].strokes[StrokeTo(Role::kLeftWrist)];
    std::swap(stroke.a, stroke.b);
    ASSERT_OK(found, MeasureFrame(cameras, marks).directions[Index(Role::kLeftWrist)]) << careless;
    EXPECT_LT(Degrees(AngleBetween(*found, towards)), 1e-6) << careless;
    // The same with this camera and only one other, in either order.
    const std::size_t other = (careless + 1) % 3;
    for (const auto& [first, second] : {std::pair(careless, other), std::pair(other, careless)}) {
      ASSERT_OK(of_two, MeasureFrame({cameras[first], cameras[second]}, {marks[first], marks[second]})
                            .directions[Index(Role::kLeftWrist)])
          << first << second;
      EXPECT_LT(Degrees(AngleBetween(*of_two, towards)), 1e-6) << first << second;
    }
  }
}

TEST(MeasureFrames, ComesNearerToTheTruthWithAThirdCameraWhenMarksAreCareless) {
  double two_errors = 0, three_errors = 0, two_angles = 0, three_angles = 0;
  for (int i = 0; i < 40; ++i) {
    const BodyPose pose = ModelPose(0.3 * i);
    TakeMarks marks = ExactMarks({pose}, ThreeCameras());
    double turn = i;
    const auto slip = [&] {
      turn += 1;
      return 3.0 * glm::dvec2(std::sin(37 * turn), std::cos(91 * turn));
    };
    for (std::vector<Marks>& of_camera : marks) {
      for (auto& end : of_camera[0].effectors) *end += slip();
      for (auto& stroke : of_camera[0].strokes) stroke = PixelSegment{stroke->a + slip(), stroke->b + slip()};
    }
    const FrameMeasurement three = MeasureFrame(ThreeCameras(), marks);
    const FrameMeasurement two = MeasureFrame(MeasuringCameras(), {marks[0], marks[1]});
    for (const EffectorMark& mark : EffectorMarks()) {
      two_errors += glm::distance(*two.ends[Index(mark.role)], pose[mark.role]);
      three_errors += glm::distance(*three.ends[Index(mark.role)], pose[mark.role]);
    }
    for (const StrokeMark& mark : StrokeMarks()) {
      const auto &of_two = two.directions[Index(mark.to)], &of_three = three.directions[Index(mark.to)];
      if (!of_two || !of_three) continue;
      two_angles += AngleBetween(*of_two, LimbOf(pose, mark));
      three_angles += AngleBetween(*of_three, LimbOf(pose, mark));
    }
  }
  EXPECT_LT(three_errors, 0.9 * two_errors);
  EXPECT_LT(three_angles, 0.9 * two_angles);
}

TEST(MeasureFrames, UsesNoStrokeThatIsTooShortAndNoPlanesThatAreTooNear) {
  const auto cameras = MeasuringCameras();
  const BodyPose pose = ModelPose();
  const TakeMarks marks = ExactMarks({pose}, cameras);
  const std::size_t i = StrokeTo(Role::kLeftKnee);
  double shortest = 1e9;
  for (const auto& of_camera : marks) {
    shortest = std::min(shortest, glm::distance(of_camera[0].strokes[i]->a, of_camera[0].strokes[i]->b));
  }
  const std::size_t knee = Index(Role::kLeftKnee);
  EXPECT_TRUE(MeasureFrame(cameras, marks, {.min_stroke_px = shortest}).directions[knee]);
  EXPECT_FALSE(MeasureFrame(cameras, marks, {.min_stroke_px = shortest + 1e-9}).directions[knee]);
  const LimbSighting two[] = {{cameras[0], *marks[0][0].strokes[i]}, {cameras[1], *marks[1][0].strokes[i]}};
  const double angle = ComputeLimbDirection(two).plane_angle;
  EXPECT_TRUE(MeasureFrame(cameras, marks, {.min_plane_angle = angle}).directions[knee]);
  EXPECT_FALSE(MeasureFrame(cameras, marks, {.min_plane_angle = angle + 1e-9}).directions[knee]);
}

TEST(MeasureFrames, KeepsWhatOnePictureTellsOfALimbOrAnEnd) {
  const BodyPose pose = ModelPose();
  TakeMarks marks = ExactMarks({pose}, MeasuringCameras());
  const Role end = EffectorMarks()[0].role, limb = StrokeMarks()[0].to;
  marks[0][0].effectors[0].reset();
  marks[0][0].strokes[0].reset();
  const FrameMeasurement found = MeasureFrame(MeasuringCameras(), marks);
  const auto& planes = found.planes[Index(limb)];
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_NEAR(glm::dot(planes[0].normal_W, LimbOf(pose, StrokeMarks()[0])), 0, 1e-9) << "the limb lies in its plane";
  const auto& line = found.sight_lines[Index(end)];
  ASSERT_TRUE(line);
  EXPECT_LT(glm::distance(NearestOn(*line, pose[end]), pose[end]), 1e-6);
  EXPECT_LT(glm::distance(NearestOn(*line, pose[end] + 0.1 * line->direction_W), pose[end] + 0.1 * line->direction_W),
            1e-6);
  EXPECT_EQ(NearestOn(*line, line->camera_W - line->direction_W), line->camera_W) << "nothing is seen behind a camera";
  // A limb measured by two cameras has no plane or sight line.
  EXPECT_TRUE(found.planes[Index(StrokeMarks()[1].to)].empty());
  EXPECT_FALSE(found.sight_lines[Index(EffectorMarks()[1].role)]);
}

TEST(MeasureFrames, TakesWhatIsKnownInsteadOfMarks) {
  const auto cameras = MeasuringCameras();
  const BodyPose pose = ModelPose();
  const TakeMarks marks = ExactMarks({pose, pose}, cameras);
  std::vector<KnownMeasurement> known(2);
  known[1].ends.emplace()[Index(Role::kHead)] = glm::dvec3(1, 2, 3);
  const auto frames = MeasureFrames({.cameras = cameras, .marks = marks, .known = known});
  EXPECT_LT(glm::distance(*frames[0].ends[Index(Role::kHead)], pose[Role::kHead]), 1e-6);
  EXPECT_EQ(frames[1].ends[Index(Role::kHead)], glm::dvec3(1, 2, 3));
  EXPECT_FALSE(frames[1].ends[Index(Role::kLeftFoot)]) << "all ends are replaced";
  EXPECT_EQ(frames[1].directions, frames[0].directions) << "directions are not";
  known[0].directions.emplace();
  EXPECT_EQ(MeasureFrames({.cameras = cameras, .marks = marks, .known = known})[0].directions, RoleVectors{});
}

TEST(MeasureFrames, OfOneWrongCameraIsExactOnlyWhenOutliersAreRejected) {
  const BodyPose pose = ModelPose();
  const std::vector<ProjectionMatrix> cameras = {CameraAt(-40, 1), CameraAt(40, 2.2), CameraAt(100, 1.5),
                                                 CameraAt(-110, 1.8)};
  for (std::size_t count : {3u, 4u}) {
    for (std::size_t wrong = 0; wrong < count; ++wrong) {
      const std::vector<ProjectionMatrix> studio(cameras.begin(), cameras.begin() + static_cast<std::ptrdiff_t>(count));
      TakeMarks marks = ExactMarks(std::vector{pose}, studio);
      for (auto& disc : marks[wrong][0].effectors) *disc += glm::dvec2(50, -35);
      for (auto& stroke : marks[wrong][0].strokes) {
        stroke->a += glm::dvec2(50, -35);
        stroke->b += glm::dvec2(-20, 40);
      }
      const TakeMarks agreeing = AgreeingMarks(studio, marks);
      const auto worst = [&](bool rejects) {
        const MeasureInputs inputs{.cameras = studio, .marks = rejects ? agreeing : marks};
        const FrameMeasurement frame = MeasureFrames(inputs, {.min_plane_angle = Radians(0.1)})[0];
        double worst_m = 0, worst_rad = 0;
        for (const EffectorMark& mark : EffectorMarks()) {
          worst_m =
              std::max(worst_m, glm::distance(frame.ends[Index(mark.role)].value_or(glm::dvec3(0)), pose[mark.role]));
        }
        for (const StrokeMark& mark : StrokeMarks()) {
          const glm::dvec3 found = frame.directions[Index(mark.to)].value_or(glm::dvec3(1, 0, 0));
          worst_rad = std::max(worst_rad, AngleBetween(found, LimbOf(pose, mark)));
        }
        return std::pair(worst_m, worst_rad);
      };
      EXPECT_LT(worst(true).first, 1e-9) << count << " cameras, " << wrong;
      EXPECT_LT(worst(true).second, 1e-6) << count << " cameras, " << wrong;
      EXPECT_GT(worst(false).first, 0.02) << "the control";
      EXPECT_GT(worst(false).second, Radians(2)) << "the control";
    }
  }
}

}  // namespace
}  // namespace etude
