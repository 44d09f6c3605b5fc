#pragma once

#include <compare>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/capture/film.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/cameras/dlt.h"
#include "engine/capture/bridge_gaps.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/measure_joints.h"
#include "engine/kinematics/capture_body.h"
#include "sim/render/renderer.h"

namespace etude {

/// The calibration target of each camera: places of the world, as they were measured, and where its picture shows them.
using CalibrationPairs = std::vector<std::vector<PointPair>>;

/// Points stuck on three walls of a box about the stage (paper B, section 2.2: "on different planes"), clicked by a
/// human with an error of `calibration_noise_px`, and measured with one of `calibration_measure_mm`.
CalibrationPairs ClickedPoints(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key);

/// The discs of a cube (sim/rig/calibration_target.h), found in a picture that each camera takes of it with all that
/// its optics and sensor do: where a human has pointed, with an error of `calibration_noise_px`. Each is measured by
/// itself. Discs seen from more than 70° aside are left alone, as are those that are not found.
CalibrationPairs FoundMarks(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                            Renderer& renderer);

/// The corners of a cube of boards (sim/rig/calibration_target.h), found in a picture that each camera takes of it with
/// all that its optics and sensor do. A board is measured as a whole: all its corners are off alike.
CalibrationPairs FoundCorners(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                              Renderer& renderer);

/// All cameras of a world, calibrated one way.
struct CalibratedCameras {
  std::vector<ProjectionMatrix> matrices;
  std::vector<Camera> lenses = {};  ///< with their distortion; empty when a calibration finds none
  double reprojection_rms_px = 0;
  std::string digest = {};
};

/// The measurements in space that the marks of a whole take give.
struct MeasuredTake {
  /// `marks[camera][frame]`: what was drawn, without what lenses do, and as the method wants it in time and without
  /// those that disagree. Whatever recovers a motion sees these.
  std::vector<std::vector<Marks>> marks;
  std::vector<FrameMeasurement> frames;
  std::vector<std::optional<LimbObservation>> seen;  ///< the same with gaps bridged
  std::vector<JointMeasurements> joints;             ///< every joint triangulated from all strokes that end there
  std::string directions_digest, points_digest;
};

/// The truth in a body's angles (`FindNearestPoses`), frame by frame.
using NearestPoses = std::vector<TreeState>;

/// The stages that methods may share in one world: each is computed when the first method asks for it, and kept for
/// the next ones.
class CaptureStages {
 public:
  /// `sources`: every way of cutting out the person that will be asked for, because each picture is rendered once,
  /// for all of them, and not kept. References must outlive this.
  CaptureStages(const StudioOptions& options, CaptureWorld world, const WorldKey& key,
                std::span<const PersonSource> sources, bool keeps_masks);

  const StudioOptions& options() const { return options_; }
  const CaptureWorld& world() const { return world_; }
  const WorldKey& key() const { return key_; }
  /// True for the frames that the annotator marks.
  const std::vector<bool>& marked() const { return marked_; }
  /// Live: the next pose of who is filmed.
  void Add(const BodyPose& pose);
  /// The renderer of this world; fails, saying why, when there can be none.
  Result<Renderer*> GetRenderer();
  Result<const Take*> GetTake();
  Result<const CalibrationPairs*> GetCalibrationPairs();
  Result<const CalibratedCameras*> GetCameras(const CaptureMethod& method);
  /// `cameras` and `observation` are those of `method`.
  const MeasuredTake& GetMeasured(const CaptureMethod& method, const CalibratedCameras& cameras,
                                  const Observation& observation);
  /// Fails, saying why, when a body cannot be made of the performer's joints.
  Result<const CaptureBody*> GetBody(const CaptureMethod& method);
  /// The body of `method` where its limbs are known.
  Result<const CaptureBody*> GetKnownBody(const CaptureMethod& method);
  /// The poses nearest to the truth in the body of `method`.
  Result<const NearestPoses*> GetNearestPoses(const CaptureMethod& method);

 private:
  /// The options that decide about the matrices of a method's cameras.
  struct CameraChoice {
    bool is_truth = false;
    Calibration calibration = Calibration::kDlt;
    auto operator<=>(const CameraChoice&) const = default;
  };
  /// The options that decide about a method's body.
  struct BodyChoice {
    BodyKind kind = BodyKind::kFitted;
    bool true_lengths = false;
    auto operator<=>(const BodyChoice&) const = default;
  };
  static BodyChoice BodyChoiceOf(const CaptureMethod& method);
  /// The options that decide about a method's measurements.
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

/// The truth of a frame that a method with these oracles is told.
KnownMeasurement ToldOf(const BodyPose& truth, const Oracle& oracle);

}  // namespace etude
