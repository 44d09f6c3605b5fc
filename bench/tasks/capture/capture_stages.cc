#include "bench/tasks/capture/capture_stages.h"

#include <algorithm>

#include "engine/base/digest.h"

namespace etude {
namespace {

constexpr int kLongestGap = 15;  // frames: half a second may pass before a mark is out of date

void Add(const std::optional<glm::dvec3>& v, Digest& digest) {
  digest.Add(static_cast<std::int64_t>(v.has_value()));
  if (v) digest.Add(v->x).Add(v->y).Add(v->z);
}

/// Fails when a camera cannot be calibrated, naming it.
Result<CalibratedCameras> CalibrateCameras(const CaptureWorld& world, bool is_truth, Calibration calibration) {
  CalibratedCameras cameras;
  Digest digest;
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    if (is_truth) {
      cameras.matrices.push_back(MatrixOf(world.cameras[i]));
    } else {
      const auto matrix = Calibrate(world.calibration_pairs[i], calibration);
      if (!matrix) return Fail({}, "camera {}: {}", i + 1, matrix.error().message);
      cameras.matrices.push_back(*matrix);
    }
    for (const auto& row : cameras.matrices.back().h) digest.Add(std::span<const double>(row));
  }
  std::vector<CameraFit> fits;
  for (std::size_t i = 0; i < cameras.matrices.size(); ++i) {
    fits.push_back({cameras.matrices[i], world.calibration_pairs[i]});
  }
  cameras.reprojection_rms_px = MeanReprojectionRmsPx(fits);
  cameras.digest = digest.Hex();
  return cameras;
}

/// Measures every frame, and what the measurements are worth.
MeasuredTake MeasureTake(const CaptureWorld& world, const Observation& observation,
                         const std::vector<ProjectionMatrix>& matrices, const Oracle& oracle,
                         const std::vector<bool>& marked, int longest_gap) {
  MeasuredTake take;
  Digest directions, points;
  std::vector<Sighted> limbs, ends;
  for (std::size_t k = 0; k < world.truth.size(); ++k) {
    const FrameMeasurement truth = TrueMeasurement(world.truth[k]);
    FrameMeasurement frame = MeasureFrame(observation.marks[0][k], matrices[0], observation.marks[1][k], matrices[1]);
    if (oracle.directions && marked[k]) frame.directions = truth.directions;
    if (oracle.points && marked[k]) frame.ends = truth.ends;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      Add(frame.directions[i], directions);
      Add(frame.ends[i], points);
      limbs.push_back({frame.directions[i], truth.directions[i]});
      ends.push_back({frame.ends[i], truth.ends[i]});
    }
    take.frames.push_back(frame);
  }
  take.seen = BridgeGaps(take.frames, longest_gap);
  take.directions = LimbDirectionErrorDeg(limbs);
  take.points = TriangulationErrorMm(ends);
  take.directions_digest = directions.Hex();
  take.points_digest = points.Hex();
  return take;
}

}  // namespace

CaptureStages::CaptureStages(const StudioOptions& options, const LibraryClip& clip, const WorldKey& key,
                             std::span<const PersonSource> sources, bool keeps_masks)
    : options_(options),
      key_(key),
      sources_(sources),
      keeps_masks_(keeps_masks),
      world_(MakeCaptureWorld(options, clip, key)),
      marked_(world_.truth.size()) {
  for (std::size_t k = 0; k < marked_.size(); ++k) marked_[k] = k % static_cast<std::size_t>(options.mark_every) == 0;
}

Result<Renderer*> CaptureStages::GetRenderer() {
  if (!renderer_) renderer_ = Renderer::Create();
  if (!*renderer_) return tl::unexpected(renderer_->error());
  return (*renderer_)->get();
}

Result<const Take*> CaptureStages::GetTake() {
  if (take_) return &*take_;
  ASSIGN_OR_RETURN(const auto renderer, GetRenderer());
  take_ = Film(world_, options_, key_, sources_, keeps_masks_, *renderer);
  return &*take_;
}

CaptureStages::CameraChoice CaptureStages::CameraChoiceOf(const CaptureMethod& method) {
  if (method.oracle.calibration) return {.is_truth = true, .calibration = Calibration::kDlt};
  return {.is_truth = false, .calibration = method.calibration};
}

Result<const CalibratedCameras*> CaptureStages::GetCameras(const CaptureMethod& method) {
  const CameraChoice choice = CameraChoiceOf(method);
  auto kept = cameras_.find(choice);
  if (kept == cameras_.end()) {
    kept = cameras_.emplace(choice, CalibrateCameras(world_, choice.is_truth, choice.calibration)).first;
  }
  if (!kept->second) return tl::unexpected(kept->second.error());
  return &*kept->second;
}

const MeasuredTake& CaptureStages::GetMeasured(const CaptureMethod& method, const CalibratedCameras& cameras,
                                               const Observation& observation) {
  const MeasureChoice choice{CameraChoiceOf(method), PersonSourceOf(method), method.oracle.directions,
                             method.oracle.points};
  auto kept = measured_.find(choice);
  if (kept == measured_.end()) {
    kept = measured_
               .emplace(choice, MeasureTake(world_, observation, cameras.matrices, method.oracle, marked_,
                                            std::max(kLongestGap, options_.mark_every)))
               .first;
  }
  return kept->second;
}

PersonSource PersonSourceOf(const CaptureMethod& method) {
  if (method.oracle.segmentation) return {.segmenter = Segmenter::kHue, .is_truth = true};
  return {.segmenter = method.segmenter, .is_truth = false};
}

}  // namespace etude
