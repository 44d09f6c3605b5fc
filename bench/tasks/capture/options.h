#pragma once

#include <compare>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/base/solver_fields.h"
#include "bench/tasks/base/task.h"
#include "engine/base/result.h"
#include "engine/cameras/dlt.h"
#include "engine/vision/change_detection.h"
#include "sim/camera/camera_effects.h"
#include "sim/rig/rig.h"

namespace etude {

enum class Clothes {
  kStudio,    ///< "studio": clothes in colours that differ from the room's
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
  kCoded,     ///< "coded": a suit in which every limb has a colour of its own
};

enum class PerformerFigure {
  kStaged,  ///< "staged": Etude's own figure of the performer; `clothes` and `scene` choose its clothes
  kOwn,     ///< "own": the meshes and textures of the clip's file
};

/// The target with which the cameras are calibrated.
enum class CalibrationTargetKind {
  kPoints,  ///< "points": points marked on planes, and clicked in the picture (paper B)
  kBoards,  ///< "boards": a cube of calibration boards, found in the picture
};

/// One condition of a capture scenario: the studio, and the errors of cameras, measurements and annotation.
struct StudioOptions {
  double duration_s = 2;
  RigOptions rig = {};  ///< the places of the cameras
  PerformerFigure figure = PerformerFigure::kStaged;
  Clothes clothes = Clothes::kStudio;
  /// The furnishing of the room: 0 = the empty studio; 1 = a furnished room with moving people and things.
  /// sim/stage/README.md describes the values in between.
  double scene = 0;
  double light_drift = 0.06;  ///< largest relative change of the lamp's brightness
  CameraEffects camera = {};
  CalibrationTargetKind calibration_target = CalibrationTargetKind::kPoints;
  int calibration_pairs = 24;         ///< number of measured points per camera; only for kPoints
  double calibration_measure_mm = 0;  ///< standard deviation of the target's measured positions along each axis
  double calibration_noise_px = 0.5;
  double annotation_error_px = 2;
  double limb_measure_mm = 0;        ///< standard deviation of every measured limb length
  int annotators = 1;                ///< number of people who mark the same pictures independently: 1 or 2
  int mark_every = 1;                ///< the annotator marks every n-th frame; directions are interpolated in between
  std::vector<double> moments = {};  ///< frames, counted from 1, for which a recording keeps every stage
  /// The cameras take a picture of every n-th frame only. The number is above 1 if the cameras are the sensor of
  /// another task, whose takes are long.
  int picture_every = 1;

  bool IsPictured(std::size_t frame) const { return frame % static_cast<std::size_t>(picture_every) == 0; }
  /// Returns the number of pictures that a camera takes during `frames` frames.
  std::size_t PicturesOf(std::size_t frames) const {
    const auto every = static_cast<std::size_t>(picture_every);
    return (frames + every - 1) / every;
  }
  /// Returns true if a frame is pictured and marked.
  bool IsMarked(std::size_t frame) const {
    return IsPictured(frame) && frame % static_cast<std::size_t>(mark_every) == 0;
  }
};

/// The body with which a skeleton is made.
enum class BodyKind {
  kFitted,  ///< "fitted": a body with the performer's own joints
  kPaper,   ///< "paper": a body with paper B's 29 degrees of freedom and the performer's limb lengths
};

/// The treatment of a camera that disagrees with the others.
enum class OutlierRule { kKeep, kReject };

/// The way in which the times of pictures are determined.
enum class Sync {
  kAssumed,    ///< "assumed": pictures of equal number were taken at the same time
  kEstimated,  ///< "estimated": times are estimated from the motion of the marks
};

/// Selects stages of the pipeline. The truth replaces their results, which shows how much of the final error they
/// cause. With `marks`, strokes and discs are at the true joints wherever a picture shows the limb or end. With `start`
/// or `ik`, the truth is the pose of the method's body that is nearest to the true pose (`FindNearestPoses`).
struct Oracle {
  bool calibration = false;
  bool segmentation = false;
  bool marks = false;
  bool directions = false;
  bool points = false;
  bool lengths = false;
  bool start = false;
  bool ik = false;

  bool operator==(const Oracle&) const = default;
};

/// The way in which poses of a body are recovered from pictures.
enum class Recovery {
  kIk,      ///< "ik": inverse kinematics to limb directions and ends, with fixed limb lengths (paper B)
  kEnds,    ///< "ends": each joint is triangulated from the strokes that end there; no body is fitted
  kBundle,  ///< "bundle": one body in smooth motion is fitted to all marks of all frames (bundle adjustment)
  /// "keypoints": the method of `etude capture`. Joints are triangulated robustly, and a body with the median limb
  /// lengths is fitted to all joints (engine/keypoints).
  kKeypoints,
  /// "silhouettes": no marks. A body is fitted to the masks and tracked from frame to frame (engine/silhouettes).
  kSilhouettes,
};

/// The smoothing of the joints over a whole take.
enum class Smoothing {
  kNone,  ///< "none": no smoothing
  kRts,   ///< "rts": each joint's track is smoothed separately (Rauch–Tung–Striebel smoother)
};

enum class LengthSource {
  kKnown,     ///< "known": the lengths are measured on the performer beforehand (paper B)
  kMeasured,  ///< "measured": the lengths are computed from the marks of a few frames
};

/// The way in which a method that tracks silhouettes finds its first pose.
enum class SilhouetteStart {
  kCold,  ///< "cold": the method uses the pictures alone
  kNear,  ///< "near": the method starts from the first true pose, with errors up to 10° per angle and 5 cm per axis
  /// "keypoints": as kCold; in addition, in every picture the marks give the positions of joints, like the keypoints of
  /// a pose estimator.
  kKeypoints,
};

enum class MarkSource {
  kAnnotator,  ///< "annotator": a person marks by hand (paper B)
  /// "colours": no marks by hand. The colours of a coded suit identify the limbs (engine/vision/limb_colours).
  kColours,
};

/// The part of a method's work that an outside program does, i.e. its seat.
enum class CaptureSeat {
  kNone,
  kSegmenter,  ///< "segmenter": the program cuts the person out of the pictures
};
const std::vector<std::string>& CaptureSeatNames();

class SeatedSegmenter;

/// A method: a pipeline with its settings.
struct CaptureMethod {
  std::string name;
  CaptureSeat seat = CaptureSeat::kNone;
  SeatedSegmenter* program = nullptr;  ///< the program in the method's seat during a run
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces = PersonPieces::kLargest;  ///< methods that read silhouettes always use all large pieces
  MarkSource marks = MarkSource::kAnnotator;
  Calibration calibration = Calibration::kDlt;
  Sync sync = Sync::kAssumed;
  OutlierRule outliers = OutlierRule::kKeep;
  BodyKind body = BodyKind::kFitted;
  const IkSolver* solver = DefaultIkSolver();
  IkOptions ik = IkBudget(100);
  Recovery recovery = Recovery::kIk;
  SilhouetteStart start = SilhouetteStart::kCold;
  Smoothing smoothing = Smoothing::kNone;
  LengthSource lengths = LengthSource::kKnown;
  /// True if no frame's skeleton uses later pictures, as in a live system. Allowed for `kIk` and `kSilhouettes`.
  bool causal = false;
  Oracle oracle;

  bool operator==(const CaptureMethod&) const = default;
};

const FieldTable<StudioOptions>& CaptureConditionFields();
const FieldTable<CaptureMethod>& CaptureMethodFields();
/// Returns CaptureMethodFields with the key `seat`, for task capture itself. Cameras that are another task's sensor
/// have no seat.
const FieldTable<CaptureMethod>& SeatedCaptureMethodFields();

/// Fails if a method reads the colours of a suit, but the performer does not wear the suit in this studio. `place` is
/// the method's place in the file.
Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place);

/// The way in which the person is cut out of the pictures, by a segmenter or by the truth, and the origin of the marks.
struct PersonSource {
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces = PersonPieces::kLargest;
  bool is_truth = false;
  /// True for methods that use silhouettes. Masks are then kept, and pictures are marked only if `has_keypoints`.
  bool for_silhouettes = false;
  bool has_keypoints = false;          ///< true: pictures are marked although `for_silhouettes` is set
  SeatedSegmenter* program = nullptr;  ///< a program that replaces the segmenter, or null
  bool has_true_marks = false;         ///< true: marks are at the exact true joints that the picture shows
  bool has_coloured_marks = false;     ///< true: marks are read from the suit's colours
  auto operator<=>(const PersonSource&) const = default;
};

/// Returns the way in which the method cuts out the person.
PersonSource PersonSourceOf(const CaptureMethod& method);
/// Adds a source unless the list has an equal one. Methods with equal sources share their marks.
void AddSource(const PersonSource& source, std::vector<PersonSource>& sources);

/// The key of a condition that names a file with the user's own cameras (`ReadRig`).
constexpr const char* kRigFileKey = "rig_file";

/// Reads the calibration file that a condition with `rig: file` names, and stores its cameras in `options.rig.own`.
/// Fails if the file or a camera is invalid.
Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options);

}  // namespace etude
