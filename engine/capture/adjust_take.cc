#include "engine/capture/adjust_take.h"

#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/start_angles.h"

namespace etude {
namespace {

/// One state per frame; frames without one take their neighbour's. Empty when no frame has one.
std::vector<TreeState> StartOf(const CaptureBody& body, std::span<const SomeJoints> joints) {
  const BodyPose standing = ToBodyPose(body, StandingState(body.tree));
  std::vector<TreeState> states;
  std::size_t leading = 0;
  for (const SomeJoints& frame : joints) {
    const auto pose = CompleteJoints(frame, standing);
    const auto state = pose ? FindStartState(body.tree, *pose, body.tree.limits) : std::nullopt;
    if (state) {
      states.insert(states.end(), leading + 1, *state);
      leading = 0;
    } else if (states.empty()) {
      ++leading;
    } else {
      states.push_back(states.back());
    }
  }
  return states;
}

std::vector<BundleMark> MarksOf(const MeasureInputs& pictures, const TakeBody& body, const MarkErrors& errors) {
  std::vector<BundleMark> marks;
  for (std::size_t camera = 0; camera < pictures.cameras.size(); ++camera) {
    for (std::size_t frame = 0; frame < pictures.marks[camera].size(); ++frame) {
      for (const MarkedJoint& joint : MarkedJointsOf(pictures.marks[camera][frame], errors)) {
        const int point = body.points[Index(joint.role)];
        if (point < 0) continue;
        marks.push_back({static_cast<int>(frame), point, pictures.cameras[camera], joint.pixel, joint.information});
      }
    }
  }
  return marks;
}

}  // namespace

BundleSmoothness SmoothnessOf(const TakeBody& body, double rate_hz) {
  BundleSmoothness smoothness;
  smoothness.rate_hz = rate_hz;
  using enum Role;
  for (const Role role :
       {kLeftHip, kRightHip, kLeftShoulder, kRightShoulder, kLeftWrist, kRightWrist, kLeftAnkle, kRightAnkle}) {
    smoothness.points.push_back(body.points[Index(role)]);
  }
  return smoothness;
}

AdjustedTake AdjustTake(const AdjustTakeInputs& inputs, const AdjustTakeOptions& options) {
  const TakeBody body = MakeTakeBody(inputs.lengths);
  AdjustedTake take;
  take.body = body.body;
  const std::vector<TreeState> start = StartOf(body.body, inputs.start);
  if (start.empty()) return take;
  const std::vector<BundleMark> marks = MarksOf(inputs.pictures, body, options.marks);
  const BundleSolution solution =
      AdjustBundle({.body = body.measurable, .start = start, .marks = marks}, options.bundle);
  take.is_solved = solution.is_solved;
  take.states = solution.states;
  if (options.bundle.adjusts_lengths) take.body = PaperBody(LimbLengthsOf(solution.lengths));
  return take;
}

}  // namespace etude
