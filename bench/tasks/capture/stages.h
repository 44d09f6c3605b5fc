#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/capture/film.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/cameras/dlt.h"
#include "engine/capture/interpolate_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/measure_joints.h"
#include "engine/kinematics/capture_body.h"
#include "sim/render/renderer.h"

namespace etude {

/// The calibration pairs of each camera: measured positions of the calibration target in the world, and their pixels in
/// the camera's picture.
using CalibrationPairs = std::vector<std::vector<PointPair>>;

/// Returns points on three walls of a box around the stage (paper B, section 2.2: "on different planes"). A human
/// clicks them with an error of `calibration_noise_px` and measures them with an error of `calibration_measure_mm`
/// (standard deviations).
CalibrationPairs ClickedPoints(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

/// Returns the corners of a cube of boards (sim/rig/calibration_target.h). Each camera takes one picture of the cube,
/// with all effects of the camera's optics and sensor, and the corners are found in the picture. A board is measured as
/// a whole: all its corners have the same error.
CalibrationPairs FoundCorners(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                              Renderer& renderer);

/// The cameras of a world, calibrated by one method.
struct CalibratedCameras {
  std::vector<ProjectionMatrix> matrices;
  std::vector<Camera> lenses = {};  ///< cameras with their distortion; empty if the calibration estimates none
  double reprojection_rms_px = 0;
  std::string digest = {};
};

/// The marks of a whole take, and the 3D measurements computed from these marks.
struct MeasuredTake {
  /// The marks as `marks[camera][frame]`, without lens distortion. If the method requires it, they are synchronised,
  /// and marks that disagree with the others are removed. Every method of recovery uses these marks.
  std::vector<std::vector<Marks>> marks;
  std::vector<FrameMeasurement> frames;
  std::vector<std::optional<LimbObservation>> seen;  ///< `frames` after `InterpolateGaps` has filled the gaps
  std::vector<JointMeasurements> joints;             ///< every joint, triangulated from all strokes that end there
  std::string directions_digest, points_digest;
};

/// For each frame, the state of a body that is nearest to the true pose (`FindNearestPoses`).
using NearestPoses = std::vector<TreeState>;

/// The stages that methods may share in one world. Each stage is computed when a method first needs it, and then kept.
class CaptureStages {
 public:
  /// `sources` must contain every way of cutting out the person that the methods use, because each picture is rendered
  /// once for all of them and is not kept. The objects behind the references must outlive this object.
  CaptureStages(const StudioOptions& options, CaptureWorld world, const WorldKey& key,
                std::span<const PersonSource> sources, bool keeps_masks);

  const StudioOptions& options() const { return options_; }
  const CaptureWorld& world() const { return world_; }
  const WorldKey& key() const { return key_; }
  /// Returns, for each frame, true if the annotator marks it.
  const std::vector<bool>& marked() const { return marked_; }
  /// Adds the performer's next pose, for live capture.
  void Add(const BodyPose& pose);
  /// Returns the renderer. Fails, with the reason, if the renderer cannot be made.
  Result<Renderer*> GetRenderer();
  Result<const Take*> GetTake();
  Result<const CalibrationPairs*> GetCalibrationPairs();
  Result<const CalibratedCameras*> GetCameras(const CaptureMethod& method);
  /// Returns the measurements of `method`. `cameras` and `observation` must be those of the same method.
  const MeasuredTake& GetMeasured(const CaptureMethod& method, const CalibratedCameras& cameras,
                                  const Observation& observation);
  /// Returns the body of `method`. Fails, with the reason, if the body cannot be made from the performer's joints.
  Result<const CaptureBody*> GetBody(const CaptureMethod& method);
  /// Returns the body of `method` with known limb lengths.
  Result<const CaptureBody*> GetKnownBody(const CaptureMethod& method);
  /// Returns the poses of the body of `method` that are nearest to the truth.
  Result<const NearestPoses*> GetNearestPoses(const CaptureMethod& method);

 private:
  /// The options that determine the matrices of a method's cameras.
  struct CameraChoice {
    bool is_truth = false;
    Calibration calibration = Calibration::kDlt;
    auto operator<=>(const CameraChoice&) const = default;
  };
  /// The options that determine a method's body.
  struct BodyChoice {
    BodyKind kind = BodyKind::kFitted;
    bool true_lengths = false;
    auto operator<=>(const BodyChoice&) const = default;
  };
  static BodyChoice BodyChoiceOf(const CaptureMethod& method);
  /// The options that determine a method's measurements.
  struct MeasureChoice {
    CameraChoice cameras;
    PersonSource person;
    bool true_directions = false, true_points = false;
    Sync sync = Sync::kAssumed;
    OutlierRule outliers = OutlierRule::kKeep;
    auto operator<=>(const MeasureChoice&) const = default;
  };
  static CameraChoice CameraChoiceOf(const CaptureMethod& method);

  const StudioOptions& options_;
  const WorldKey key_;
  const std::span<const PersonSource> sources_;
  const bool keeps_masks_;
  CaptureWorld world_;
  std::vector<bool> marked_;
  std::optional<Take> take_;
  std::optional<CalibrationPairs> pairs_;
  std::map<CameraChoice, Result<CalibratedCameras>> cameras_;
  std::map<MeasureChoice, MeasuredTake> measured_;
  std::map<BodyChoice, Result<CaptureBody>> bodies_;
  std::map<BodyChoice, NearestPoses> nearest_;
};

/// Returns the measurements of a frame that a method's oracles give: true limb directions, true ends, both or none.
KnownMeasurement KnownMeasurementOf(const BodyPose& truth, const Oracle& oracle);

}  // namespace etude
