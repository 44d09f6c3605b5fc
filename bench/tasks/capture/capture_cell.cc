#include "bench/tasks/capture/capture_cell.h"

#include <algorithm>

#include "bench/metrics/pose_error.h"
#include "bench/tasks/capture/measure.h"
#include "bench/tasks/capture/recording_extras.h"
#include "bench/tasks/capture/recover.h"
#include "engine/base/digest.h"
#include "engine/kinematics/tree_to_body.h"
#include "engine/motion/bvh.h"

namespace etude {
namespace {

constexpr int kLongestGap = 15;  // frames: half a second may pass before a mark is out of date

struct Mean {
  double sum = 0;
  int count = 0;

  void Add(double value) {
    sum += value;
    ++count;
  }
};

void MeasureMean(const char* id, const Mean& mean, const char* why_missing, CellResult& cell) {
  if (mean.count == 0) return cell.Missing(id, why_missing);
  cell.Measure(id, mean.sum / mean.count);
}

void MeasureOptional(const char* id, const std::optional<double>& value, const char* why_missing, CellResult& cell) {
  if (value) return cell.Measure(id, *value);
  cell.Missing(id, why_missing);
}

void ReportMasks(const MaskScore& score, CellResult& cell) {
  MeasureOptional("iou", score.iou, "no picture shows or finds a person", cell);
  MeasureOptional("mask_precision", score.precision, "nobody was found in any picture", cell);
  MeasureOptional("mask_recall", score.recall, "no picture shows a person", cell);
  MeasureOptional("mask_f1", score.f1, "no picture shows or finds a person", cell);
  MeasureOptional("shadow_error", score.shadow_error, "no picture shows a shadow", cell);
}

// Calibrates every camera; the cell fails with the reason when one cannot be.
std::optional<std::vector<ProjectionMatrix>> CalibrateCameras(const CaptureWorld& world, const CaptureMethod& method,
                                                              CellResult& cell) {
  std::vector<ProjectionMatrix> matrices;
  Digest digest;
  double rms_px = 0;
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    if (method.oracle.calibration) {
      matrices.push_back(MatrixOf(world.cameras[i]));
    } else {
      const auto matrix = Calibrate(world.calibration_pairs[i], method.calibration);
      if (!matrix) {
        cell = CellResult::Ended(Status::kFailed, fmt::format("camera {}: {}", i + 1, matrix.error().message));
        return std::nullopt;
      }
      matrices.push_back(*matrix);
    }
    for (const auto& row : matrices.back().h) digest.Add(std::span<const double>(row));
    rms_px += ReprojectionRms(matrices.back(), world.calibration_pairs[i]) / static_cast<double>(world.cameras.size());
  }
  cell.digests.emplace_back("calibration", digest.Hex());
  cell.Measure("reprojection_rms_px", rms_px);
  return matrices;
}

void Add(const std::optional<glm::dvec3>& v, Digest& digest) {
  digest.Add(static_cast<std::int64_t>(v.has_value()));
  if (v) digest.Add(v->x).Add(v->y).Add(v->z);
}

void Add(const BodyPose& pose, Digest& digest) {
  for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
}

// Measures every frame, and what the measurements are worth.
std::vector<FrameMeasurement> MeasureFrames(const CaptureWorld& world, const Observation& observation,
                                            const std::vector<ProjectionMatrix>& matrices, const Oracle& oracle,
                                            const std::vector<bool>& marked, CellResult& cell) {
  std::vector<FrameMeasurement> frames;
  Digest directions, points;
  Mean direction_error_deg, point_error_mm;
  for (std::size_t k = 0; k < world.truth.size(); ++k) {
    const FrameMeasurement truth = TrueMeasurement(world.truth[k]);
    FrameMeasurement frame = MeasureFrame(observation.marks[0][k], matrices[0], observation.marks[1][k], matrices[1]);
    if (oracle.directions && marked[k]) frame.directions = truth.directions;
    if (oracle.points && marked[k]) frame.ends = truth.ends;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      Add(frame.directions[i], directions);
      Add(frame.ends[i], points);
      if (frame.directions[i] && truth.directions[i]) {
        direction_error_deg.Add(Degrees(AngleBetween(*frame.directions[i], *truth.directions[i])));
      }
      if (frame.ends[i]) point_error_mm.Add(1000 * glm::distance(*frame.ends[i], *truth.ends[i]));
    }
    frames.push_back(frame);
  }
  cell.digests.emplace_back("directions", directions.Hex());
  cell.digests.emplace_back("points", points.Hex());
  MeasureMean("limb_direction_error_deg", direction_error_deg, "no limb was marked in both pictures", cell);
  MeasureMean("triangulation_error_mm", point_error_mm, "no end effector was marked in both pictures", cell);
  return frames;
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

constexpr std::array kPoseMetrics = {"mpjpe_mm",  "mpjpe_before_ik_mm",   "pa_mpjpe_mm",      "pck_50mm",
                                     "auc_200mm", "bone_length_error_cm", "position_error_cm"};

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
  const PoseErrors before = ComparePoses(fixed, world.truth), after = ComparePoses(poses, world.truth);
  cell.digests.emplace_back("lengths", lengths_digest.Hex());
  cell.digests.emplace_back("pose", pose_digest.Hex());
  cell.Measure("mpjpe_mm", after.mpjpe_mm);
  cell.Measure("mpjpe_before_ik_mm", before.mpjpe_mm);
  cell.Measure("pa_mpjpe_mm", after.pa_mpjpe_mm);
  cell.Measure("pck_50mm", after.pck_50mm);
  cell.Measure("auc_200mm", after.auc_200mm);
  cell.Measure("bone_length_error_cm", after.bone_length_error_cm);
  cell.Measure("position_error_cm", effector_error_cm.sum / effector_error_cm.count);
  cell.series.push_back({"mpjpe_mm", "frame", after.frame_mpjpe_mm});
  cell.series.push_back({"mpjpe_before_ik_mm", "frame", before.frame_mpjpe_mm});
}

Recording MakeRecording(const CaptureWorld& world, const Observation& observation, const KinematicTree& body,
                        const std::vector<RecoveredFrame>& frames, const std::string& name) {
  Track truth{"truth", {kJudgedRateHz, world.truth}}, recovered{"recovered", {kJudgedRateHz, {}}};
  std::vector<TreeState> states;
  for (const RecoveredFrame& frame : frames) {
    recovered.motion.poses.push_back(frame.pose);
    states.push_back(frame.state);
  }
  RecordingExtras extras;
  extras.texture_seed = world.room.texture_seed;
  extras.casts_shadows = world.room.casts_shadows;
  extras.colours = world.colours;
  extras.brightness = world.brightness;
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    extras.views.push_back({world.cameras[i], observation.masks[i]});
  }
  extras.bvh = WriteBvh(ToClip(body, states, kJudgedRateHz, name));
  return {{std::move(truth), std::move(recovered)}, WriteRecordingExtras(extras)};
}

}  // namespace

PersonSource PersonSourceOf(const CaptureMethod& method) {
  if (method.oracle.segmentation) return {.segmenter = Segmenter::kHue, .is_truth = true};
  return {.segmenter = method.segmenter, .is_truth = false};
}

CellResult RunCaptureCell(const CaptureWorld& world, const Take& take, const Observation& observation,
                          const StudioOptions& options, const CaptureMethod& method, bool wants_recording) {
  CellResult cell;
  const auto matrices = CalibrateCameras(world, method, cell);
  if (!matrices) return cell;
  cell.digests.emplace_back("pictures", take.pictures_digest);
  cell.digests.emplace_back("masks", observation.masks_digest);
  cell.digests.emplace_back("marks", observation.marks_digest);
  ReportMasks(observation.score, cell);

  std::vector<bool> marked(world.truth.size());
  for (std::size_t k = 0; k < marked.size(); ++k) marked[k] = k % static_cast<std::size_t>(options.mark_every) == 0;
  const auto measured = MeasureFrames(world, observation, *matrices, method.oracle, marked, cell);
  const auto seen = BridgeGaps(measured, std::max(kLongestGap, options.mark_every));

  const KinematicTree body = MakeBodyTree(world.lengths);
  const auto recovered = RecoverFrames(body, world.lengths, seen, marked, *method.solver, method.ik);
  const auto count = std::count_if(recovered.begin(), recovered.end(), [](const auto& f) { return f.has_value(); });
  cell.Measure("frames_recovered", static_cast<double>(count) / static_cast<double>(recovered.size()));
  if (count == 0) {
    cell.status = Status::kFailed;
    cell.reason = ReasonForNoSkeleton(measured);
    for (const char* id : kPoseMetrics) cell.Missing(id, "no frame was recovered");
    return cell;
  }
  const std::vector<RecoveredFrame> frames = HoldFrames(recovered);
  ReportPoses(world, frames, cell);
  if (wants_recording) cell.recording = MakeRecording(world, observation, body, frames, method.name);
  cell.status = Status::kOk;
  cell.reason.clear();
  return cell;
}

}  // namespace etude
