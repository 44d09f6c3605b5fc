// Golden values of whole results, of marks that err or are missing and of searches that are cut off early: whatever
// changes a number is noticed. What is right is said by the tests beside.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/capture/adjust_take.h"
#include "engine/capture/bridge_gaps.h"
#include "engine/capture/calibrate_cameras.h"
#include "engine/capture/recover_frames.h"
#include "engine/capture/synchronise.h"
#include "engine/motion/rest_body.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/engine/kinematics/rest_bodies.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddMarks(Fingerprint& print, const TakeMarks& marks) {
  for (const auto& of_camera : marks) {
    for (const Marks& picture : of_camera) {
      for (const auto& stroke : picture.strokes) {
        print.Add(stroke.has_value());
        if (stroke) print.Add(stroke->a).Add(stroke->b);
      }
      print.Add(picture.effectors);
    }
  }
}

void AddTreeState(Fingerprint& print, const TreeState& state) {
  print.Add(state.root_position).Add(state.root_frame[0]).Add(state.root_frame[2]).Add(state.angles);
}

/// Marks of a dance by three cameras, off by some pixels, some by many; some are missing, for several frames too, and
/// some strokes are short.
TakeMarks CarelessMarks(testing::Dice& dice, int frames, double noise_px, double pace = 0.1) {
  std::vector<BodyPose> poses;
  for (int k = 0; k < frames; ++k) poses.push_back(ModelPose(pace * k));
  TakeMarks marks = ExactMarks(poses, ThreeCameras());
  for (auto& of_camera : marks) {
    for (int k = 0; k < frames; ++k) {
      const auto slip = [&] {
        const double px = dice.Below(30) ? noise_px : 60;
        return px * glm::dvec2(dice.Vector());
      };
      for (std::size_t i = 0; i < kStrokeCount; ++i) {
        auto& stroke = of_camera[k].strokes[i];
        stroke->a += slip(), stroke->b += slip();
        if (dice.Below(15) == 0) stroke->b = stroke->a + 4.0 * glm::dvec2(dice.Vector());
        if (dice.Below(6) == 0 || k / 4 % 7 == static_cast<int>(i % 8)) stroke.reset();
      }
      for (std::size_t i = 0; i < kEffectorCount; ++i) {
        *of_camera[k].effectors[i] += slip();
        if (dice.Below(6) == 0 || k / 3 % 6 == static_cast<int>(i)) of_camera[k].effectors[i].reset();
      }
    }
  }
  return marks;
}

void AddMeasured(Fingerprint& print, const FrameMeasurement& frame) {
  print.Add(frame.ends).Add(frame.directions);
  for (const auto& planes : frame.planes) {
    for (const StrokePlane& plane : planes) print.Add(plane.normal_W).Add(plane.ray_a_W).Add(plane.length_px);
  }
  for (const auto& line : frame.sight_lines) {
    print.Add(line.has_value());
    if (line) print.Add(line->camera_W).Add(line->direction_W);
  }
}

void AddSeen(Fingerprint& print, const std::optional<LimbObservation>& seen) {
  print.Add(seen.has_value());
  if (!seen) return;
  print.Add(seen->ends.joints).Add(seen->directions).Add(seen->lacks_end).Add(seen->lacks_direction);
}

void AddFrame(Fingerprint& print, const std::optional<RecoveredFrame>& frame) {
  print.Add(frame.has_value());
  if (!frame) return;
  AddTreeState(print, frame->state);
  print.Add(frame->fixed.joints).Add(frame->pose.joints);
  for (const EffectorError& error : frame->errors) print.Add(error.position);
}

TEST(CaptureGolden, FramesMeasuredBridgedAndRecovered) {
  testing::Dice dice(1);
  Fingerprint agreeing, measured, bridged, recovered;
  for (int k = 0; k < 6; ++k) {
    TakeMarks marks = CarelessMarks(dice, 13 + k, 1 + k);
    std::vector<ProjectionMatrix> cameras = ThreeCameras();
    for (const double tolerance : {12.0, 3.0}) AddMarks(agreeing, AgreeingMarks(cameras, marks, tolerance));
    if (k % 2) marks.pop_back(), cameras.pop_back();
    if (k % 3) marks = AgreeingMarks(cameras, marks);
    MeasureOptions measure;
    if (k > 2) measure = {.smallest_plane_angle = Radians(25), .shortest_stroke_px = 40};
    const auto frames = MeasureFrames({.cameras = cameras, .marks = marks}, measure);
    for (const FrameMeasurement& frame : frames) AddMeasured(measured, frame);
    const BridgeOptions bridge =
        k % 2 ? BridgeOptions{.longest_gap = 1, .mark_error_px = 6, .turn_per_frame = 0.2} : BridgeOptions();
    const auto seen = BridgeGaps(frames, bridge);
    for (const auto& observation : seen) AddSeen(bridged, observation);
    AddSeen(bridged, BridgeLast(std::span(frames).first(7), bridge));
    const CaptureBody body = k < 4 ? PaperBody({}) : FittedBody(JointedRestBody()).value();
    RecoverOptions options{.solver = FindIkSolver(k % 3 ? "damped-least-squares" : "ccd"), .ik = {}};
    if (k % 2) options.ik.max_iterations = 3;
    std::vector<bool> marked(seen.size());
    for (std::size_t i = 0; i < marked.size(); ++i) marked[i] = k != 2 || i % 3 == 0;
    const auto found = RecoverFrames({.body = body, .seen = seen, .marked = marked}, options);
    for (const auto& frame : found) AddFrame(recovered, frame);
    LiveRecovery live(body, options, {.longest_gap = 2});
    for (const FrameMeasurement& frame : std::span(frames).first(8)) AddFrame(recovered, live.Next(frame));
    if (!found[0]) continue;
    const std::vector<TreeState> known(seen.size(), found[0]->state);
    for (const auto& frame : RecoverFrames({.body = body, .seen = seen, .known_starts = known}, options))
      AddFrame(recovered, frame);
    for (const auto& frame : RecoverFrames({.body = body, .seen = seen, .known_poses = known}, options))
      AddFrame(recovered, frame);
    for (const auto& pose : ToClip(body, HoldFrames(found), 30, "held").frames) {
      for (const LocalTransform& joint : pose) recovered.Add(joint.translation).Add(joint.rotation);
    }
  }
  EXPECT_TRUE(agreeing.Is(32408, 5092.75397803));
  EXPECT_TRUE(measured.Is(15448, 2.63619284602));
  EXPECT_TRUE(bridged.Is(16335, 246.217602337));
  EXPECT_TRUE(recovered.Is(82701, -367.909402535));
}

TEST(CaptureGolden, JointsMeasuredSmoothedAndCompleted) {
  testing::Dice dice(2);
  Fingerprint measured, smooth, completed;
  for (int k = 0; k < 3; ++k) {
    TakeMarks marks = CarelessMarks(dice, 11 + k, 2);
    const std::vector<ProjectionMatrix> cameras = ThreeCameras();
    if (k == 1) {
      for (auto& of_camera : marks) {
        for (Marks& picture : of_camera)
          picture.strokes[1].reset(), picture.strokes[2].reset(), picture.effectors[0].reset();
      }
    }
    MarkErrors errors;
    if (k == 2) errors = {.mark_error_px = 4, .slide_share = 0.3};
    for (const MarkedJoint& joint : MarkedJointsOf(marks[0][3], errors))
      measured.Add(joint.role).Add(joint.pixel).Add(joint.information[0]).Add(joint.information[1]);
    const auto joints = MeasureJoints({.cameras = cameras, .marks = marks}, errors);
    for (const JointMeasurements& frame : joints) {
      for (const PointMeasurement& joint : frame.joints) {
        measured.Add(joint.position);
        for (int i = 0; i < 3; ++i) measured.Add(1e-4 * joint.information[i]);
      }
      measured.Add(frame.is_triangulated);
    }
    std::vector<std::optional<BodyPose>> poses;
    const auto bridged = BridgeJoints(joints);
    for (SomeJoints frame : bridged) {
      smooth.Add(frame);
      for (auto& joint : frame) {
        if (dice.Below(3) == 0) joint.reset();
      }
      poses.push_back(CompleteJoints(frame, ModelPose(1)));
      completed.Add(poses.back()->joints);
      if (dice.Below(4) == 0) poses.back().reset();
    }
    for (const SomeJoints& frame : SmoothJoints(joints, 25)) smooth.Add(frame);
    for (const BodyPose& pose : SmoothPoses(poses, joints, 50)) smooth.Add(pose.joints);
  }
  for (const Role only : AllRoles()) {
    SomeJoints one;
    one[Index(only)] = {1, 2, 3};
    if (only == Role::kLeftHip) one[Index(Role::kRightHip)] = {1, 2.1, 3.2};
    if (only == Role::kLeftShoulder) one[Index(Role::kRightShoulder)] = {1.3, 2, 3.1};
    completed.Add(CompleteJoints(one, ModelPose(2))->joints);
  }
  EXPECT_FALSE(CompleteJoints({}, ModelPose(2)));
  EXPECT_TRUE(measured.Is(9781, 974.929114381));
  EXPECT_TRUE(smooth.Is(7452, -4.42918401001));
  EXPECT_TRUE(completed.Is(3416, 205.149361555));
}

TEST(CaptureGolden, TakesAdjustedForAFewSteps) {
  testing::Dice dice(3);
  Fingerprint bodies, takes;
  const TakeBody body = MakeTakeBody({.foot = 0.2, .shank = 0.45});
  for (const BodyPoint& point : body.measurable.points) bodies.Add(point.joint).Add(point.p_LQ);
  for (const auto* shares : {&body.measurable.joint_shares, &body.measurable.point_shares}) {
    for (const LengthShare& share : *shares) bodies.Add(share.index).Add(share.length).Add(share.per_metre);
  }
  bodies.Add(body.points).Add(body.measurable.lengths).Add(SmoothnessOf(body, 25).points);
  for (int k = 0; k < 4; ++k) {
    const TakeMarks marks = CarelessMarks(dice, 7 + k, 2);
    const std::vector<ProjectionMatrix> cameras = ThreeCameras();
    const MeasureInputs pictures{.cameras = cameras, .marks = marks};
    const auto joints = MeasureJoints(pictures);
    auto start = BridgeJoints(joints);
    if (k == 3) start[0] = start[1] = start[4] = {};
    AdjustTakeOptions options;
    options.bundle.max_iterations = k == 0 ? 25 : k;
    options.bundle.adjusts_lengths = k % 2 == 1;
    if (k == 2) options.bundle.smoothness = SmoothnessOf(MakeTakeBody({}), 30), options.marks = {1, 0.2};
    const AdjustedTake take = AdjustTake({.pictures = pictures, .lengths = {}, .start = start}, options);
    takes.Add(take.is_solved).Add(ListOf(take.body.lengths));
    for (const TreeState& state : take.states) AddTreeState(takes, state);
    if (const auto lengths = MeasureLengths(pictures, joints, {.frames = 1 + 3 * k, .marks = {}}))
      takes.Add(ListOf(*lengths));
  }
  EXPECT_TRUE(bodies.Is(213, 24.546131881));
  EXPECT_TRUE(takes.Is(1418, -7.8335254884));
}

TEST(CaptureGolden, PosesFittedToWhatNoBodyHas) {
  testing::Dice dice(4);
  Fingerprint print;
  for (const RestBody& rest : {PlainRestBody(), JointedRestBody(), SensorRestBody()}) {
    const CaptureBody body = FittedBody(rest).value();
    const PoseFitter fitter(body);
    std::optional<PoseFit> last;
    std::vector<BodyPose> poses;
    for (int k = 0; k < 12; ++k) {
      PoseTargets wanted = TargetsAt(ModelPose(0.2 * k));
      for (std::size_t i = 0; i < kRoleCount; ++i) {
        wanted.places.joints[i] += (k % 4 ? 0.05 : 0.4) * dice.Vector();
        if (dice.Below(6) == 0) wanted.weights[i] = 0;
        if (dice.Below(5) == 0) wanted.weights[i] = 0.1;
      }
      if (k == 4)
        wanted.places[Role::kLeftWrist] =
            glm::mix(wanted.places[Role::kLeftElbow], wanted.places[Role::kLeftShoulder], -0.7);
      poses.push_back(wanted.places);
      auto fit = fitter.Fit(wanted, last);
      print.Add(fit.has_value());
      if (!fit) continue;
      AddTreeState(print, fit->state);
      print.Add(fit->squares);
      AddTreeState(print, fitter.Improve(wanted, StandingState(body.tree)));
      if (k % 3) last = std::move(fit);
    }
    for (const std::size_t most : {5, 20}) {
      const auto misfit = MeasureRigidMisfit(rest, poses, most);
      print.Add(misfit->mean_m).Add(misfit->worst_m).Add(misfit->role).Add(misfit->pose);
    }
  }
  EXPECT_TRUE(print.Is(3455, 92.6458738471));
}

TEST(CaptureGolden, ClocksOfCameras) {
  testing::Dice dice(5);
  Fingerprint print, offsets;
  for (int k = 0; k < 4; ++k) {
    const TakeMarks exact = CarelessMarks(dice, 24, 0.5 + k, 0.3);
    const std::vector<double> late = {0, 2.3, -1.6};
    const TakeMarks shifted = Synchronised(exact, late);
    AddMarks(print, shifted);
    offsets.Add(EstimateOffsets(ThreeCameras(), shifted, {.most_frames = 3 + k, .most_px = 5.0 * (k + 1)}));
    offsets.Add(EstimateOffsets(ThreeCameras(), shifted));
    AddMarks(print, {{MarksAt(exact[0], -1e-9), MarksAt(exact[0], 0), MarksAt(exact[0], 22.5), MarksAt(exact[0], 23)}});
  }
  for (int k = 0; k < 60; ++k) {
    std::vector<double> misfits;
    for (int i = 0; i < 13; ++i) {
      const double bowl = 0.02 * (i - 6 + k % 7 - 3) * (i - 6 + k % 7 - 3);
      misfits.push_back((k % 5 ? bowl : 1) + (k % 3 ? 0.1 : 1e-4) * (1 + dice.Signed()));
    }
    const auto misfit = [&](int offset) -> std::optional<double> {
      return std::abs(offset) > 6 || (k % 11 == 0 && offset == k % 4) ? std::nullopt
                                                                      : std::optional(misfits[offset + 6]);
    };
    const ClockOffset found = FindOffset(misfit, k % 2 ? 4 : 7);
    offsets.Add(found.frames).Add(found.is_told);
  }
  EXPECT_TRUE(offsets.Is(152, -6.66894763991));
  EXPECT_TRUE(print.Is(16816, -5224.91910964));
}

TEST(CaptureGolden, CamerasCalibratedAndMarksWithoutTheirLenses) {
  testing::Dice dice(6);
  Fingerprint print;
  std::vector<std::vector<PointPair>> pairs(2);
  Camera camera = LookAt({}, {1, 1.5, 3.5}, {0, 0.9, 0});
  camera.distortion = {.k1 = -0.2, .k2 = 0.05, .p1 = 0.002};
  for (auto& of_camera : pairs) {
    for (int i = 0; i < 12; ++i) {
      const glm::dvec3 world = glm::dvec3(0, 0.9, 0) + dice.Vector();
      of_camera.push_back({world, *Project(camera, world) + glm::dvec2(dice.Vector())});
    }
  }
  const std::vector<PictureSize> sizes(2, PictureSize{640, 480});
  for (const Calibration method : {Calibration::kDlt, Calibration::kDltNormalised}) {
    const auto matrices = CalibrateCameras(pairs, {.method = method});
    for (const ProjectionMatrix& matrix : *matrices) {
      for (const auto& row : matrix.h) print.Add(row);
    }
  }
  const auto refined_cameras = RefineCameras(pairs, sizes);
  for (const Camera& refined : *refined_cameras) print.Add(refined.p_WC).Add(refined.intrinsics.fx);
  pairs[1].resize(3);
  EXPECT_EQ(CalibrateCameras(pairs).error().message,
            "camera 2: cannot calibrate a camera: 3 point pairs; at least 6 are needed");
  EXPECT_EQ(RefineCameras(pairs, sizes).error().message, CalibrateCameras(pairs).error().message);
  Marks marks;
  for (auto& stroke : marks.strokes) {
    const auto anywhere = [&] { return glm::dvec2(320, 240) + 900.0 * glm::dvec2(dice.Vector()); };
    if (dice.Below(4)) stroke = PixelSegment{anywhere(), anywhere()};
    marks.effectors[dice.Below(kEffectorCount)] = anywhere();
  }
  AddMarks(print, {{UndistortMarks(camera, marks), UndistortMarks(Camera{}, marks)}});
  EXPECT_TRUE(print.Is(186, -3956.35537217));
}

}  // namespace
}  // namespace etude
