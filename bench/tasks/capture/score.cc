#include "bench/tasks/capture/score.h"

#include <algorithm>

#include "bench/metrics/measurement.h"
#include "bench/metrics/pose_error.h"
#include "bench/model/recording.h"
#include "bench/statistics/curves/curves.h"
#include "engine/base/digest.h"
#include "engine/capture/adjust_take.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {
namespace {

void ReportMasks(const MaskScore& score, CellResult& cell) {
  cell.MeasureOr("iou", score.iou, "no picture shows a person, and none was found");
  cell.MeasureOr("mask_precision", score.precision, "no person was found in any picture");
  cell.MeasureOr("mask_recall", score.recall, "no picture shows a person");
  cell.MeasureOr("mask_f1", score.f1, "no picture shows a person, and none was found");
  cell.MeasureOr("shadow_error", score.shadow_error, "no picture shows a shadow");
  cell.MeasureOr("pwc", score.pwc, "there is no picture");
}

void ReportMeasurements(const CaptureWorld& world, const MeasuredTake& measured, CellResult& cell) {
  std::vector<MeasuredAndTrue> limbs, ends;
  for (std::size_t k = 0; k < world.truth.size(); ++k) {
    const FrameMeasurement& found = measured.frames[k];
    const FrameMeasurement truth = TrueMeasurement(world.truth[k]);
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      limbs.push_back({found.directions[i], truth.directions[i]});
      ends.push_back({found.ends[i], truth.ends[i]});
    }
  }
  const MeasuredError directions = LimbDirectionErrorDeg(limbs), points = TriangulationErrorMm(ends);
  cell.MeasureOr("limb_direction_error_deg", directions.mean, "no limb was marked in the pictures of two cameras");
  cell.MeasureOr("limb_direction_coverage", directions.coverage, "no limb has a direction");
  cell.MeasureOr("triangulation_error_mm", points.mean, "no end effector was marked in the pictures of two cameras");
  cell.MeasureOr("triangulation_coverage", points.coverage, "there are no end effectors");
}

void ReportAnnotators(const Observation& observation, CellResult& cell) {
  constexpr const char* kAlone = "only one annotator marked the pictures, or two annotators marked nothing in common";
  cell.MeasureOr("annotator_distance_px", observation.annotator_distance_px, kAlone);
  cell.MeasureOr("annotator_overlap", observation.annotator_overlap, kAlone);
}

void ReportStages(const CaptureWorld& world, const CaptureRun& run, CellResult& cell) {
  cell.digests = {{"calibration", run.cameras.digest},
                  {"pictures", run.take.pictures_digest},
                  {"masks", run.observation.masks_digest},
                  {"marks", run.observation.marks_digest},
                  {"directions", run.measured.directions_digest},
                  {"points", run.measured.points_digest}};
  cell.Measure("reprojection_rms_px", run.cameras.reprojection_rms_px);
  ReportMasks(run.observation.score, cell);
  ReportAnnotators(run.observation, cell);
  ReportMeasurements(world, run.measured, cell);
}

std::string ReasonForNoSkeleton(const CaptureRun& run) {
  if (run.method.recovery == Recovery::kSilhouettes) {
    return "no skeleton: in no frame do the pictures of two cameras show a person";
  }
  if (run.method.recovery != Recovery::kIk) {
    return "no skeleton: no joint was ever marked in two pictures, or no body explains the marks";
  }
  const std::vector<FrameMeasurement>& frames = run.measured.frames;
  const bool has_end = std::ranges::any_of(frames, [](const FrameMeasurement& frame) {
    return std::ranges::any_of(frame.ends, [](const auto& end) { return end.has_value(); });
  });
  if (!has_end)
    return "no skeleton: no end effector was ever marked in the pictures of two cameras, so the body's position is "
           "unknown";
  return "no skeleton: the limbs that were marked fit no body";
}

constexpr const char* kNoStages = "this metric measures a stage, and only built-in methods have stages";

constexpr std::array kStageMetrics = {"reprojection_rms_px",
                                      "iou",
                                      "mask_precision",
                                      "mask_recall",
                                      "mask_f1",
                                      "shadow_error",
                                      "pwc",
                                      "annotator_distance_px",
                                      "annotator_overlap",
                                      "limb_direction_error_deg",
                                      "limb_direction_coverage",
                                      "triangulation_error_mm",
                                      "triangulation_coverage"};

constexpr std::array kPoseMetrics = {"mpjpe_mm",        "mpjpe_before_ik_mm",   "mpjpe_seen_mm",
                                     "mpjpe_held_mm",   "pa_mpjpe_mm",          "pck_50mm",
                                     "auc_200mm",       "bone_length_error_cm", "joint_angle_error_deg",
                                     "jerk_error_mps3", "limb_length_error_mm", "position_error_cm"};
constexpr const char* kNoIk = "the method has no inverse kinematics";

/// Adds the metrics of the final poses' joint errors to the cell.
void ReportJointErrors(const PoseErrors& errors, CellResult& cell) {
  cell.Measure("mpjpe_mm", errors.mpjpe_mm);
  cell.Measure("pa_mpjpe_mm", errors.pa_mpjpe_mm);
  cell.Measure("pck_50mm", errors.pck_50mm);
  cell.Measure("auc_200mm", errors.auc_200mm);
  cell.Measure("bone_length_error_cm", errors.bone_length_error_cm);
  cell.Measure("joint_angle_error_deg", errors.joint_angle_error_deg);
  cell.series.push_back({"mpjpe_mm", "frame", errors.frame_mpjpe_mm});
}

void ReportJerk(const CaptureWorld& world, const std::vector<BodyPose>& poses, CellResult& cell) {
  cell.MeasureOr("jerk_error_mps3", JerkErrorMps3(poses, world.truth, world.in_view, kJudgedRateHz),
                 "no four successive frames are in view");
}

/// Returns the values of the frames in which the performer is in view. Only these frames are judged.
template <typename Value>
std::vector<Value> InView(const CaptureWorld& world, const std::vector<Value>& values) {
  std::vector<Value> kept;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (world.in_view[k]) kept.push_back(values[k]);
  }
  return kept;
}

/// Returns the joint errors of the frames in view.
PoseErrors JudgePoses(const CaptureWorld& world, const std::vector<BodyPose>& poses) {
  return ComparePoses(InView(world, poses), InView(world, world.truth));
}

/// Returns the mean distance of the end effectors from their measured positions, centimetres, over the frames with
/// measured positions. Empty if no frame has any.
std::optional<double> MeanEffectorErrorCm(const std::vector<RecoveredFrame>& frames) {
  constexpr double kCmPerMetre = 100;
  double of_frames = 0;
  int count = 0;
  for (const RecoveredFrame& frame : frames) {
    if (frame.errors.empty()) continue;
    double of_effectors = 0;
    for (const EffectorError& error : frame.errors) of_effectors += kCmPerMetre * error.position;
    of_frames += of_effectors / static_cast<double>(frame.errors.size());
    ++count;
  }
  if (count == 0) return std::nullopt;
  return of_frames / count;
}

/// Returns, for each frame, true if at least one picture shows a mark.
std::vector<bool> FramesSeen(const Observation& observation) {
  std::vector<bool> seen(observation.marks.front().size());
  for (const std::vector<Marks>& of_camera : observation.marks) {
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Marks& marks = of_camera[k];
      const bool has_mark = std::ranges::any_of(marks.strokes, [](const auto& stroke) { return stroke.has_value(); }) ||
                            std::ranges::any_of(marks.effectors, [](const auto& disc) { return disc.has_value(); });
      seen[k] = seen[k] || has_mark;
    }
  }
  return seen;
}

/// Measures the joint errors separately over frames with marks and over frames without marks.
void ReportSeen(const CaptureWorld& world, const Observation& observation, const PoseErrors& errors, CellResult& cell) {
  const std::vector<bool> all_seen = FramesSeen(observation);
  std::vector<bool> seen, held;  // for each frame in view: `seen` if the frame has marks, `held` if it has none
  for (std::size_t k = 0; k < all_seen.size(); ++k) {
    if (!world.in_view[k]) continue;
    seen.push_back(all_seen[k]);
    held.push_back(!all_seen[k]);
  }
  cell.MeasureOr("mpjpe_seen_mm", MeanOfFlagged(errors.frame_mpjpe_mm, seen), "no picture shows a mark");
  cell.MeasureOr("mpjpe_held_mm", MeanOfFlagged(errors.frame_mpjpe_mm, held), "every frame has a mark in some picture");
}

void ReportLengths(const CaptureWorld& world, const CaptureRun& run, CellResult& cell) {
  if (run.method.lengths == LengthSource::kKnown) {
    cell.Missing("limb_length_error_mm", "the method is given the limb lengths");
    return;
  }
  cell.Measure("limb_length_error_mm", LimbLengthErrorMm(ListOf(run.body.lengths), ListOf(world.person.lengths)));
}

void ReportIk(const CaptureWorld& world, const CaptureRun& run, const PoseErrors& before,
              const std::vector<RecoveredFrame>& frames, CellResult& cell) {
  if (run.method.recovery != Recovery::kIk) {
    for (const char* id : {"mpjpe_before_ik_mm", "position_error_cm"}) cell.Missing(id, kNoIk);
    return;
  }
  cell.Measure("mpjpe_before_ik_mm", before.mpjpe_mm);
  cell.series.push_back({"mpjpe_before_ik_mm", "frame", before.frame_mpjpe_mm});
  cell.MeasureOr("position_error_cm", MeanEffectorErrorCm(InView(world, frames)),
                 "no end effector was seen in any frame in view");
}

void ReportPoses(const CaptureWorld& world, const CaptureRun& run, const std::vector<RecoveredFrame>& frames,
                 CellResult& cell) {
  std::vector<BodyPose> fixed, poses;
  Digest lengths_digest, pose_digest;
  for (const RecoveredFrame& frame : frames) {
    fixed.push_back(frame.fixed);
    poses.push_back(frame.pose);
    AddTo(lengths_digest, frame.fixed);
    AddTo(pose_digest, frame.pose);
  }
  cell.digests.emplace_back("lengths", lengths_digest.Hex());
  cell.digests.emplace_back("pose", pose_digest.Hex());
  const PoseErrors errors = JudgePoses(world, poses);
  ReportJointErrors(errors, cell);
  ReportSeen(world, run.observation, errors, cell);
  ReportJerk(world, poses, cell);
  ReportLengths(world, run, cell);
  ReportIk(world, run, JudgePoses(world, fixed), frames, cell);
}

/// Measures the share of frames in view and, of these, the share with a skeleton. Returns true if any frame in view has
/// a skeleton.
template <typename Frame>
bool ReportRecovered(const CaptureWorld& world, const std::vector<std::optional<Frame>>& frames, CellResult& cell) {
  const auto judged = InView(world, frames);
  const auto count = std::count_if(judged.begin(), judged.end(), [](const auto& frame) { return frame.has_value(); });
  const auto in_view = static_cast<std::int64_t>(judged.size());
  cell.Measure("frames_in_view", *Share(in_view, static_cast<std::int64_t>(frames.size())));
  cell.Measure("frames_recovered", *Share(count, in_view));
  return count > 0;
}

void FailWithoutPoses(const std::string& reason, CellResult& cell) {
  cell.status = Status::kFailed;
  cell.reason = reason;
  for (const char* id : kPoseMetrics) cell.Missing(id, "no frame was recovered");
}

/// Fills frames without a pose with the last pose before them or, at the start, with the first pose (as
/// RepeatLastPose).
std::vector<BodyPose> HoldPoses(const CaptureAnswer& answer) {
  std::vector<BodyPose> held;
  const auto first = std::find_if(answer.begin(), answer.end(), [](const auto& pose) { return pose.has_value(); });
  for (const auto& pose : answer) held.push_back(pose ? *pose : held.empty() ? **first : held.back());
  return held;
}

}  // namespace

std::vector<std::string> CaptureMetrics() {
  std::vector<std::string> ids(kStageMetrics.begin(), kStageMetrics.end());
  ids.insert(ids.end(), {"frames_in_view", "frames_recovered"});
  ids.insert(ids.end(), kPoseMetrics.begin(), kPoseMetrics.end());
  return ids;
}

CellResult ScoreCaptureRun(const CaptureWorld& world, const CaptureRun& run, bool keeps_motion,
                           std::span<const double> moments) {
  CellResult cell;
  ReportStages(world, run, cell);
  if (!ReportRecovered(world, run.frames, cell)) {
    FailWithoutPoses(ReasonForNoSkeleton(run), cell);
    return cell;
  }
  const std::vector<RecoveredFrame> frames = RepeatLastPose(run.frames);
  ReportPoses(world, run, frames, cell);
  if (keeps_motion) {
    cell.recording = MakeRecording(world, run.take, run.observation, run.body, frames, run.method.name, moments);
  }
  cell.status = Status::kOk;
  cell.reason.clear();
  return cell;
}

CellResult ScoreCaptureAnswer(const CaptureWorld& world, const CaptureAnswer& answer, bool keeps_motion) {
  CellResult cell;
  for (const char* id : kStageMetrics) cell.Missing(id, kNoStages);
  if (!ReportRecovered(world, answer, cell)) {
    FailWithoutPoses("no frame has a pose", cell);
    return cell;
  }
  const std::vector<BodyPose> poses = HoldPoses(answer);
  Digest digest;
  for (const BodyPose& pose : poses) AddTo(digest, pose);
  cell.digests = {{"pose", digest.Hex()}};
  ReportJointErrors(JudgePoses(world, poses), cell);
  ReportJerk(world, poses, cell);
  for (const char* id :
       {"mpjpe_before_ik_mm", "mpjpe_seen_mm", "mpjpe_held_mm", "limb_length_error_mm", "position_error_cm"}) {
    cell.Missing(id, kNoStages);
  }
  if (keeps_motion) cell.recording = MakeRecording(world, poses);
  cell.status = Status::kOk;
  cell.reason.clear();
  return cell;
}

}  // namespace etude
