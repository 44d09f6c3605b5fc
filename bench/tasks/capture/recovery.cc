#include "bench/tasks/capture/recovery.h"

#include <algorithm>

#include "bench/tasks/capture/silhouettes.h"
#include "engine/capture/adjust_take.h"
#include "engine/capture/fit_pose.h"
#include "engine/capture/measure_lengths.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/start_angles.h"
#include "engine/motion/rest_body.h"

namespace etude {
namespace {

MeasureInputs PicturesOf(const CaptureRun& run) {
  return {.cameras = run.cameras.matrices, .marks = run.observation.marks};
}

/// The joints of every frame, of some or none in frames before anything was seen.
std::vector<SomeJoints> JointsOf(const CaptureRun& run) {
  if (run.method.smoothing == Smoothing::kRts) return SmoothJoints(run.measured.joints, kJudgedRateHz);
  return BridgeJoints(run.measured.joints);
}

/// A frame whose pose comes first, and the tree's state after it: as near to it as start angles come.
RecoveredFrame FrameOf(const CaptureBody& body, const BodyPose& pose, const TreeState& last) {
  const auto state =
      body.is_paper ? FindStartState(body.tree, pose, body.tree.limits) : PoseFitter(body).Fit(TargetsAt(pose));
  return {pose, state.value_or(last), pose, {}};
}

Result<void> RecoverByIk(CaptureStages& stages, CaptureRun& run) {
  RecoverInputs inputs{.body = run.body, .seen = run.measured.seen, .marked = stages.marked()};
  if (run.method.oracle.start || run.method.oracle.ik) {
    ASSIGN_OR_RETURN(const NearestPoses* nearest, stages.GetNearestPoses(run.method));
    if (run.method.oracle.start) inputs.known_starts = *nearest;
    if (run.method.oracle.ik) inputs.known_poses = *nearest;
  }
  run.frames = RecoverFrames(inputs, {.solver = run.method.solver, .ik = run.method.ik});
  return {};
}

void RecoverEnds(CaptureRun& run) {
  TreeState last = StandingState(run.body.tree);
  const BodyPose standing = ToBodyPose(run.body, last);
  for (const SomeJoints& joints : JointsOf(run)) {
    const auto pose = CompleteJoints(joints, standing);
    run.frames.push_back(pose ? std::optional(FrameOf(run.body, *pose, last)) : std::nullopt);
    if (pose) last = run.frames.back()->state;
  }
}

void RecoverBundle(CaptureRun& run) {
  const std::vector<SomeJoints> start = BridgeJoints(run.measured.joints);
  AdjustTakeOptions options;
  options.bundle.smoothness = SmoothnessOf(MakeTakeBody(run.body.lengths), kJudgedRateHz);
  options.bundle.adjusts_lengths = run.method.lengths == LengthSource::kMeasured;
  const AdjustedTake take =
      AdjustTake({.pictures = PicturesOf(run), .lengths = run.body.lengths, .start = start}, options);
  run.frames.resize(start.size());
  if (!take.is_solved) return;
  run.body = take.body;
  for (std::size_t k = 0; k < take.states.size(); ++k) {
    const BodyPose pose = ToBodyPose(run.body, take.states[k]);
    run.frames[k] = RecoveredFrame{pose, take.states[k], pose, {}};
  }
}

Result<void> RecoverFromSilhouettes(CaptureStages& stages, CaptureRun& run) {
  ASSIGN_OR_RETURN(run.frames, FollowSilhouettes({.truth = stages.world().truth,
                                                  .key = stages.key(),
                                                  .body = run.body,
                                                  .cameras = run.cameras.matrices,
                                                  .masks = run.observation.masks,
                                                  .start = run.method.start}));
  return {};
}

/// Each joint of recovered frames smoothed by itself; frames without a skeleton are filled.
void SmoothFrames(CaptureRun& run) {
  std::vector<std::optional<BodyPose>> poses;
  for (const auto& frame : run.frames) poses.push_back(frame ? std::optional(frame->pose) : std::nullopt);
  const auto first = std::ranges::find_if(run.frames, [](const auto& frame) { return frame.has_value(); });
  if (first == run.frames.end()) return;
  RecoveredFrame last = **first;
  const std::vector<BodyPose> smooth = SmoothPoses(poses, run.measured.joints, kJudgedRateHz);
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    if (run.frames[k]) last = *run.frames[k];
    RecoveredFrame frame = FrameOf(run.body, smooth[k], last.state);
    frame.fixed = last.fixed;
    if (run.frames[k]) frame.errors = last.errors;
    run.frames[k] = std::move(frame);
  }
}

}  // namespace

Result<CaptureBody> BodyFor(CaptureStages& stages, const CaptureRun& run) {
  const bool is_paper = run.method.recovery != Recovery::kIk || run.method.body == BodyKind::kPaper;
  if (run.method.lengths == LengthSource::kKnown) {
    CaptureMethod asks = run.method;
    if (is_paper) asks.body = BodyKind::kPaper;
    ASSIGN_OR_RETURN(const CaptureBody* body, stages.GetBody(asks));
    return *body;
  }
  const auto lengths = MeasureLengths(PicturesOf(run), run.measured.joints);
  if (!lengths) return Fail({}, "no limb lengths: no frame shows enough of a body in two pictures to measure them");
  const CaptureBody paper = PaperBody(*lengths);
  if (is_paper) return paper;
  const BodyPose standing = ToBodyPose(paper, StandingState(paper.tree));
  return FittedBody(RestBodyOf({&standing, 1}));
}

Result<void> Recover(CaptureStages& stages, CaptureRun& run) {
  switch (run.method.recovery) {
    case Recovery::kIk:
      RETURN_IF_ERROR(RecoverByIk(stages, run));
      break;
    case Recovery::kEnds:
      RecoverEnds(run);
      return {};  // smoothed already, each place with its own uncertainty
    case Recovery::kBundle:
      RecoverBundle(run);
      break;
    case Recovery::kSilhouettes:
      return RecoverFromSilhouettes(stages, run);
  }
  if (run.method.smoothing == Smoothing::kRts) SmoothFrames(run);
  return {};
}

}  // namespace etude
