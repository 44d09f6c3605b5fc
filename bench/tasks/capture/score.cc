#include "bench/tasks/capture/run.h"

#include <algorithm>

#include "bench/metrics/pose_error.h"
#include "bench/metrics/share.h"
#include "bench/tasks/capture/measure.h"
#include "bench/tasks/capture/recording_extras.h"
#include "bench/tasks/capture/recover.h"
#include "engine/base/digest.h"
#include "engine/formats/bvh.h"
#include "engine/kinematics/tree_to_body.h"
#include "engine/motion/from_body.h"

namespace etude {
namespace {

struct Mean {
  double sum = 0;
  int count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
};

void ReportMasks(const MaskScore& score, CellResult& cell) {
  cell.MeasureOr("iou", score.iou, "no picture shows or finds a person");
  cell.MeasureOr("mask_precision", score.precision, "nobody was found in any picture");
  cell.MeasureOr("mask_recall", score.recall, "no picture shows a person");
  cell.MeasureOr("mask_f1", score.f1, "no picture shows or finds a person");
  cell.MeasureOr("shadow_error", score.shadow_error, "no picture shows a shadow");
}

void Add(const BodyPose& pose, Digest& digest) {
  for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
}

const Observation& ObservationBy(const Take& take, const PersonSource& source) {
  return *std::find_if(take.observations.begin(), take.observations.end(),
                       [&](const Observation& observation) { return observation.source == source; });
}

void ReportStages(const CalibratedCameras& cameras, const Take& take, const Observation& observation,
                  const MeasuredTake& measured, CellResult& cell) {
  cell.digests = {{"calibration", cameras.digest},
                  {"pictures", take.pictures_digest},
                  {"masks", observation.masks_digest},
                  {"marks", observation.marks_digest},
                  {"directions", measured.directions_digest},
                  {"points", measured.points_digest}};
  cell.Measure("reprojection_rms_px", cameras.reprojection_rms_px);
  ReportMasks(observation.score, cell);
  cell.MeasureOr("limb_direction_error_deg", measured.directions.mean, "no limb was marked in both pictures");
  cell.MeasureOr("limb_direction_coverage", measured.directions.coverage, "no limb has a direction");
  cell.MeasureOr("triangulation_error_mm", measured.points.mean, "no end effector was marked in both pictures");
  cell.MeasureOr("triangulation_coverage", measured.points.coverage, "there are no end effectors");
}

// "the left hand was never marked in both pictures", for the first thing that is never measured.
std::string ReasonForNoSkeleton(std::span<const FrameMeasurement> frames) {
  auto never = [&](auto member, Role role) {
    return std::none_of(frames.begin(), frames.end(),
                        [&](const FrameMeasurement& frame) { return (frame.*member)[Index(role)].has_value(); });
  };
  for (const EffectorMark& mark : EffectorMarks()) {
    if (never(&FrameMeasurement::ends, mark.role)) {
      return fmt::format("no skeleton: {} was never marked in both pictures", RoleName(mark.role));
    }
  }
  for (const StrokeMark& mark : StrokeMarks()) {
    if (never(&FrameMeasurement::directions, mark.to)) {
      return fmt::format("no skeleton: the direction of the limb to {} was never seen in both pictures",
                         RoleName(mark.to));
    }
  }
  return "no skeleton: no frame has all its marks within half a second, or its limbs fit no body";
}

constexpr const char* kNoStages = "only a built-in method's stages tell";

constexpr std::array kStageMetrics = {"reprojection_rms_px",
                                      "iou",
                                      "mask_precision",
                                      "mask_recall",
                                      "mask_f1",
                                      "shadow_error",
                                      "limb_direction_error_deg",
                                      "limb_direction_coverage",
                                      "triangulation_error_mm",
                                      "triangulation_coverage"};

constexpr std::array kPoseMetrics = {"mpjpe_mm",  "mpjpe_before_ik_mm",   "pa_mpjpe_mm",      "pck_50mm",
                                     "auc_200mm", "bone_length_error_cm", "position_error_cm"};

/// The errors of final poses; those before inverse kinematics only where there were such.
void ReportJointErrors(const PoseErrors& after, const PoseErrors* before, CellResult& cell) {
  cell.Measure("mpjpe_mm", after.mpjpe_mm);
  if (before != nullptr) {
    cell.Measure("mpjpe_before_ik_mm", before->mpjpe_mm);
  } else {
    cell.Missing("mpjpe_before_ik_mm", kNoStages);
  }
  cell.Measure("pa_mpjpe_mm", after.pa_mpjpe_mm);
  cell.Measure("pck_50mm", after.pck_50mm);
  cell.Measure("auc_200mm", after.auc_200mm);
  cell.Measure("bone_length_error_cm", after.bone_length_error_cm);
  cell.series.push_back({"mpjpe_mm", "frame", after.frame_mpjpe_mm});
  if (before != nullptr) cell.series.push_back({"mpjpe_before_ik_mm", "frame", before->frame_mpjpe_mm});
}

void ReportPoses(const CaptureWorld& world, const std::vector<RecoveredFrame>& frames, CellResult& cell) {
  std::vector<BodyPose> fixed, poses;
  Digest lengths_digest, pose_digest;
  Mean effector_error_cm;
  for (const RecoveredFrame& frame : frames) {
    fixed.push_back(frame.fixed);
    poses.push_back(frame.pose);
    Add(frame.fixed, lengths_digest);
    Add(frame.pose, pose_digest);
    if (frame.effector_error_cm) effector_error_cm.Add(*frame.effector_error_cm);
  }
  cell.digests.emplace_back("lengths", lengths_digest.Hex());
  cell.digests.emplace_back("pose", pose_digest.Hex());
  const PoseErrors before = ComparePoses(fixed, world.truth);
  ReportJointErrors(ComparePoses(poses, world.truth), &before, cell);
  cell.Measure("position_error_cm", effector_error_cm.sum / effector_error_cm.count);
}

RecordingExtras DescribeStage(const CaptureWorld& world) {
  RecordingExtras extras;
  extras.texture_seed = world.room.texture_seed;
  extras.casts_shadows = world.room.casts_shadows;
  extras.colours = world.colours;
  extras.brightness = world.brightness;
  return extras;
}

Recording MakeRecording(const CaptureWorld& world, const Observation& observation, const KinematicTree& body,
                        const std::vector<RecoveredFrame>& frames, const std::string& name) {
  Track truth{"truth", {kJudgedRateHz, world.truth}}, recovered{"recovered", {kJudgedRateHz, {}}};
  std::vector<TreeState> states;
  for (const RecoveredFrame& frame : frames) {
    recovered.motion.poses.push_back(frame.pose);
    states.push_back(frame.state);
  }
  RecordingExtras extras = DescribeStage(world);
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    extras.views.push_back({world.cameras[i], observation.masks[i]});
  }
  extras.bvh = WriteBvh(ToClip(body, states, kJudgedRateHz, name));
  return {{std::move(truth), std::move(recovered)}, WriteRecordingExtras(extras)};
}

/// What an answer alone can show: nothing was cut out.
Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses) {
  const BodyMotion found{kJudgedRateHz, poses};
  RecordingExtras extras = DescribeStage(world);
  for (const Camera& camera : world.cameras) {
    const Mask nothing(camera.intrinsics.width / 2, camera.intrinsics.height / 2);
    extras.views.push_back({camera, std::vector<Mask>(poses.size(), nothing)});
  }
  extras.bvh = WriteBvh(ToClip(found, "recovered"));
  return {{{"truth", {kJudgedRateHz, world.truth}}, {"recovered", found}}, WriteRecordingExtras(extras)};
}

/// As HoldFrames: where there is no pose, the last one before it, or the first.
std::vector<BodyPose> HoldPoses(const CaptureAnswer& answer) {
  std::vector<BodyPose> held;
  const auto first = std::find_if(answer.begin(), answer.end(), [](const auto& pose) { return pose.has_value(); });
  for (const auto& pose : answer) held.push_back(pose ? *pose : held.empty() ? **first : held.back());
  return held;
}

}  // namespace

CellResult RunCaptureCell(CaptureStages& stages, const CaptureMethod& method, bool keeps_motion) {
  const CaptureWorld& world = stages.world();
  const auto cameras = stages.GetCameras(method);
  if (!cameras) return CellResult::Ended(Status::kFailed, cameras.error().message);
  const auto take = stages.GetTake();
  if (!take) return CellResult::Ended(Status::kFailed, take.error().message);
  const Observation& observation = ObservationBy(**take, PersonSourceOf(method));
  const MeasuredTake& measured = stages.GetMeasured(method, **cameras, observation);
  CellResult cell;
  ReportStages(**cameras, **take, observation, measured, cell);

  const KinematicTree body = MakeBodyTree(world.lengths);
  const auto recovered = RecoverFrames(body, world.lengths, measured.seen, stages.marked(), *method.solver, method.ik);
  const auto count = std::count_if(recovered.begin(), recovered.end(), [](const auto& f) { return f.has_value(); });
  cell.Measure("frames_recovered", *Share(count, static_cast<std::int64_t>(recovered.size())));
  if (count == 0) {
    cell.status = Status::kFailed;
    cell.reason = ReasonForNoSkeleton(measured.frames);
    for (const char* id : kPoseMetrics) cell.Missing(id, "no frame was recovered");
    return cell;
  }
  const std::vector<RecoveredFrame> frames = HoldFrames(recovered);
  ReportPoses(world, frames, cell);
  if (keeps_motion) cell.recording = MakeRecording(world, observation, body, frames, method.name);
  cell.status = Status::kOk;
  cell.reason.clear();
  return cell;
}

CellResult ScoreCaptureAnswer(const CaptureWorld& world, const CaptureAnswer& answer, bool keeps_motion) {
  CellResult cell;
  for (const char* id : kStageMetrics) cell.Missing(id, kNoStages);
  const auto count = std::count_if(answer.begin(), answer.end(), [](const auto& pose) { return pose.has_value(); });
  cell.Measure("frames_recovered", *Share(count, static_cast<std::int64_t>(answer.size())));
  if (count == 0) {
    cell.status = Status::kFailed;
    cell.reason = "no frame has a pose";
    for (const char* id : kPoseMetrics) cell.Missing(id, "no frame was recovered");
    return cell;
  }
  const std::vector<BodyPose> poses = HoldPoses(answer);
  Digest digest;
  for (const BodyPose& pose : poses) Add(pose, digest);
  cell.digests = {{"pose", digest.Hex()}};
  ReportJointErrors(ComparePoses(poses, world.truth), nullptr, cell);
  cell.Missing("position_error_cm", kNoStages);
  if (keeps_motion) cell.recording = MakeRecording(world, poses);
  cell.status = Status::kOk;
  cell.reason.clear();
  return cell;
}

}  // namespace etude
