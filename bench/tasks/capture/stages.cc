#include "bench/tasks/capture/stages.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bench/metrics/measurement.h"
#include "bench/tasks/capture/nearest_poses.h"
#include "bench/tasks/capture/shooting.h"
#include "engine/base/digest.h"
#include "engine/boards/find_boards.h"
#include "engine/capture/calibrate_cameras.h"
#include "engine/capture/synchronise.h"
#include "sim/rig/calibration_target.h"

namespace etude {
namespace {

constexpr double kMetresPerMm = 0.001;

/// Draws the error of a click as a multiple of its standard deviation. The vertical error is drawn first.
glm::dvec2 DrawMiss(RandomStream& hand) {
  const double y = hand.Normal(), x = hand.Normal();
  return {x, y};
}

std::vector<PointPair> ClickedBy(const StudioOptions& options, const Camera& camera, std::size_t index,
                                 const glm::dvec3& middle, const WorldKey& key) {
  RandomStream random(key, fmt::format("capture/camera-{}/calibration", index));
  RandomStream tape(key, fmt::format("capture/camera-{}/measured-points", index));
  const glm::dvec3 low = middle + glm::dvec3(-0.8, 0.1, -0.8), high = middle + glm::dvec3(0.8, 1.9, 0.8);
  std::vector<PointPair> pairs;
  for (int i = 0; i < options.calibration_pairs; ++i) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = random.Uniform(low[axis], high[axis]);
    // The points lie in turn on the back wall, the left wall and the floor of the box.
    constexpr int kWalls[] = {2, 0, 1};
    const int wall = kWalls[i % 3];
    point[wall] = low[wall];
    const glm::dvec2 click = DrawMiss(random);
    const glm::dvec3 measured = point + options.calibration_measure_mm * kMetresPerMm * tape.Normal3();
    const auto pixel = Project(camera, point);
    if (pixel) pairs.push_back({measured, *pixel + options.calibration_noise_px * click});
  }
  return pairs;
}

void Add(const RoleVectors& vectors, Digest& digest) {
  for (const std::optional<glm::dvec3>& v : vectors) {
    digest.Add(static_cast<std::int64_t>(v.has_value()));
    if (v) digest.Add(v->x).Add(v->y).Add(v->z);
  }
}

std::vector<ProjectionMatrix> MatricesOf(std::span<const Camera> cameras) {
  std::vector<ProjectionMatrix> matrices;
  for (const Camera& camera : cameras) matrices.push_back(MatrixOf(camera));
  return matrices;
}

/// Calibrates the cameras. Returns their matrices and, if the calibration estimates them, their lenses.
Result<CalibratedCameras> Calibrated(const CaptureWorld& world, const CalibrationPairs& pairs, bool is_truth,
                                     Calibration calibration) {
  if (is_truth) return CalibratedCameras{.matrices = MatricesOf(world.cameras)};
  if (calibration != Calibration::kRefined) {
    ASSIGN_OR_RETURN(auto matrices, CalibrateCameras(pairs, {.method = calibration}));
    return CalibratedCameras{.matrices = std::move(matrices)};
  }
  std::vector<PictureSize> sizes;
  for (const Camera& camera : world.cameras) sizes.push_back({camera.intrinsics.width, camera.intrinsics.height});
  ASSIGN_OR_RETURN(auto lenses, RefineCameras(pairs, sizes));
  std::vector<ProjectionMatrix> matrices = MatricesOf(lenses);
  return CalibratedCameras{.matrices = std::move(matrices), .lenses = std::move(lenses)};
}

/// Returns the pairs with their pixels corrected for the camera's lens distortion.
std::vector<PointPair> UndistortPairs(const Camera& camera, std::vector<PointPair> pairs) {
  for (PointPair& pair : pairs) pair.pixel = UndistortPixel(camera, pair.pixel).value_or(pair.pixel);
  return pairs;
}

Result<CalibratedCameras> MakeCameras(const CaptureWorld& world, const CalibrationPairs& pairs, bool is_truth,
                                      Calibration calibration) {
  ASSIGN_OR_RETURN(CalibratedCameras cameras, Calibrated(world, pairs, is_truth, calibration));
  Digest digest;
  std::vector<std::vector<PointPair>> seen(pairs.begin(), pairs.end());
  std::vector<CameraFit> fits;
  for (std::size_t i = 0; i < cameras.matrices.size(); ++i) {
    for (const auto& row : cameras.matrices[i].h) digest.Add(std::span<const double>(row));
    if (!cameras.lenses.empty()) {
      const Distortion& d = cameras.lenses[i].distortion;
      digest.Add(d.k1).Add(d.k2).Add(d.p1).Add(d.p2).Add(d.k3);
      seen[i] = UndistortPairs(cameras.lenses[i], std::move(seen[i]));
    }
    fits.push_back({cameras.matrices[i], seen[i]});
  }
  cameras.reprojection_rms_px = MeanReprojectionRmsPx(fits);
  cameras.digest = digest.Hex();
  return cameras;
}

/// Returns the true measurements that replace the measured ones in a method with this oracle, for the frames that the
/// annotator marks.
std::vector<KnownMeasurement> KnownMeasurementsOf(const CaptureWorld& world, const Oracle& oracle,
                                                  const std::vector<bool>& marked) {
  std::vector<KnownMeasurement> known(world.truth.size());
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (marked[k]) known[k] = KnownMeasurementOf(world.truth[k], oracle);
  }
  return known;
}

/// Returns the marks as [camera][frame]. If there are lenses, their distortion is removed.
std::vector<std::vector<Marks>> UndistortAll(std::span<const Camera> lenses, std::vector<std::vector<Marks>> marks) {
  for (std::size_t camera = 0; camera < lenses.size(); ++camera) {
    for (Marks& of_frame : marks[camera]) of_frame = UndistortMarks(lenses[camera], of_frame);
  }
  return marks;
}

MeasuredTake MeasureTake(std::span<const ProjectionMatrix> cameras, std::vector<std::vector<Marks>> marks,
                         std::span<const KnownMeasurement> known, const GapOptions& gaps) {
  // Measure limb directions and end effectors in each frame, interpolate gaps between frames, and triangulate all
  // joints.
  MeasuredTake take;
  take.marks = std::move(marks);
  const MeasureInputs inputs{.cameras = cameras, .marks = take.marks, .known = known};
  take.frames = MeasureFrames(inputs);
  take.seen = InterpolateGaps(take.frames, gaps);
  take.joints = MeasureJoints(inputs);
  Digest directions, points;
  for (const FrameMeasurement& frame : take.frames) {
    Add(frame.directions, directions);
    Add(frame.ends, points);
  }
  take.directions_digest = directions.Hex();
  take.points_digest = points.Hex();
  return take;
}

}  // namespace

CalibrationPairs ClickedPoints(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key) {
  CalibrationPairs pairs;
  for (const Camera& camera : world.cameras) {
    pairs.push_back(ClickedBy(options, camera, pairs.size(), world.middle, key));
  }
  return pairs;
}

CalibrationPairs FoundCorners(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                              Renderer& renderer) {
  const std::vector<PlacedBoard> target = CalibrationTarget(world.middle);
  const std::vector<Surface> surfaces = SurfacesOf(target);
  RandomStream tape(key, "capture/measured-boards");
  std::vector<PlacedBoard> measured = target;
  for (PlacedBoard& board : measured) board.p_WO += options.calibration_measure_mm * kMetresPerMm * tape.Normal3();
  std::vector<Board> boards;
  for (const PlacedBoard& placed : target) boards.push_back(placed.board);

  Shooting shooting(world, options.camera, key, renderer);
  CalibrationPairs pairs;
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    const ColourImage picture = shooting.ShootStage(camera, {Figure{.shape = {}, .surfaces = surfaces}});
    pairs.push_back(PairsOf(measured, FindBoards(picture, boards)));
  }
  return pairs;
}

CaptureStages::CaptureStages(const StudioOptions& options, CaptureWorld world, const WorldKey& key,
                             std::span<const PersonSource> sources, bool keeps_masks)
    : options_(options), key_(key), sources_(sources), keeps_masks_(keeps_masks), world_(std::move(world)) {
  for (std::size_t k = 0; k < world_.truth.size(); ++k) marked_.push_back(options.IsMarked(k));
}

void CaptureStages::Add(const BodyPose& pose) {
  marked_.push_back(options_.IsMarked(world_.truth.size()));
  world_.truth.push_back(pose);
}

Result<Renderer*> CaptureStages::GetRenderer() { return SharedRenderer(); }

Result<const Take*> CaptureStages::GetTake() {
  if (take_) return &*take_;
  ASSIGN_OR_RETURN(const auto renderer, GetRenderer());
  take_ = Film(world_, options_, key_, sources_, keeps_masks_, *renderer);
  return &*take_;
}

Result<const CalibrationPairs*> CaptureStages::GetCalibrationPairs() {
  if (pairs_) return &*pairs_;
  if (options_.calibration_target == CalibrationTargetKind::kPoints) {
    pairs_ = ClickedPoints(options_, world_, key_);
  } else {
    ASSIGN_OR_RETURN(const auto renderer, GetRenderer());
    pairs_ = FoundCorners(options_, world_, key_, *renderer);
  }
  return &*pairs_;
}

CaptureStages::CameraChoice CaptureStages::CameraChoiceOf(const CaptureMethod& method) {
  if (method.oracle.calibration) return {.is_truth = true, .calibration = Calibration::kDlt};
  return {.is_truth = false, .calibration = method.calibration};
}

Result<const CalibratedCameras*> CaptureStages::GetCameras(const CaptureMethod& method) {
  const CameraChoice choice = CameraChoiceOf(method);
  auto kept = cameras_.find(choice);
  if (kept == cameras_.end()) {
    ASSIGN_OR_RETURN(const CalibrationPairs* pairs, GetCalibrationPairs());
    kept = cameras_.emplace(choice, MakeCameras(world_, *pairs, choice.is_truth, choice.calibration)).first;
  }
  if (!kept->second) return tl::unexpected(kept->second.error());
  return &*kept->second;
}

const MeasuredTake& CaptureStages::GetMeasured(const CaptureMethod& method, const CalibratedCameras& cameras,
                                               const Observation& observation) {
  const MeasureChoice choice{
      CameraChoiceOf(method), PersonSourceOf(method), method.oracle.directions, method.oracle.points, method.sync,
      method.outliers};
  auto kept = measured_.find(choice);
  if (kept == measured_.end()) {
    const std::vector<KnownMeasurement> known = KnownMeasurementsOf(world_, method.oracle, marked_);
    std::vector<std::vector<Marks>> marks = UndistortAll(cameras.lenses, observation.marks);
    if (method.sync == Sync::kEstimated) marks = Synchronised(marks, EstimateOffsets(cameras.matrices, marks));
    if (method.outliers == OutlierRule::kReject) marks = AgreeingMarks(cameras.matrices, marks);
    const int every = std::lcm(options_.mark_every, options_.picture_every);
    const GapOptions gaps{.max_gap = std::max(GapOptions{}.max_gap, every)};
    kept = measured_.emplace(choice, MeasureTake(cameras.matrices, std::move(marks), known, gaps)).first;
  }
  return kept->second;
}

CaptureStages::BodyChoice CaptureStages::BodyChoiceOf(const CaptureMethod& method) {
  return {.kind = method.body, .true_lengths = method.oracle.lengths};
}

Result<const CaptureBody*> CaptureStages::GetBody(const CaptureMethod& method) {
  const BodyChoice choice = BodyChoiceOf(method);
  auto kept = bodies_.find(choice);
  if (kept == bodies_.end()) {
    const PersonalLimbs& person = choice.true_lengths ? world_.person : world_.measured;
    Result<CaptureBody> body = choice.kind == BodyKind::kPaper ? PaperBody(person.lengths) : FittedBody(person.body);
    kept = bodies_.emplace(choice, std::move(body)).first;
  }
  if (!kept->second) return tl::unexpected(kept->second.error());
  return &*kept->second;
}

Result<const CaptureBody*> CaptureStages::GetKnownBody(const CaptureMethod& method) {
  CaptureMethod asks = method;
  if (method.recovery != Recovery::kIk) asks.body = BodyKind::kPaper;
  return GetBody(asks);
}

Result<const NearestPoses*> CaptureStages::GetNearestPoses(const CaptureMethod& method) {
  ASSIGN_OR_RETURN(const CaptureBody* body, GetBody(method));
  const BodyChoice choice = BodyChoiceOf(method);
  auto kept = nearest_.find(choice);
  if (kept == nearest_.end()) kept = nearest_.emplace(choice, FindNearestPoses(*body, world_.truth)).first;
  return &kept->second;
}

KnownMeasurement KnownMeasurementOf(const BodyPose& pose, const Oracle& oracle) {
  KnownMeasurement known;
  const FrameMeasurement truth = TrueMeasurement(pose);
  if (oracle.directions) known.directions = truth.directions;
  if (oracle.points) known.ends = truth.ends;
  return known;
}

}  // namespace etude
