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
  kStudio,    ///< "studio": colours that differ from the room's, as one would dress for it
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
  kCoded,     ///< "coded": a suit in which every limb has a colour of its own
};

/// The figure that is drawn.
enum class PerformerFigure {
  kStaged,  ///< "staged": the stage's own people, dressed as `clothes` and `scene` say
  kOwn,     ///< "own": the meshes and textures of the clip's file
};

/// The target that the cameras are calibrated with.
enum class CalibrationTargetKind {
  kPoints,  ///< "points": marked on planes, and clicked in the picture (paper B)
  kBoards,  ///< "boards": a cube of calibration boards, found in the picture
};

/// One condition of a capture scenario: the studio and its errors.
struct StudioOptions {
  double duration_s = 2;
  RigOptions rig = {};  ///< where the cameras stand
  PerformerFigure figure = PerformerFigure::kStaged;
  Clothes clothes = Clothes::kStudio;
  /// 0 = the studio; 1 = a furnished room with moving people and things (sim/stage/README.md describes the values
  /// between).
  double scene = 0;
  double light_drift = 0.06;  ///< largest relative change of the lamp's brightness
  CameraEffects camera = {};  ///< of every camera
  CalibrationTargetKind calibration_target = CalibrationTargetKind::kPoints;
  int calibration_pairs = 24;         ///< kPoints: measured points per camera
  double calibration_measure_mm = 0;  ///< standard deviation of the target's measured positions along each axis
  double calibration_noise_px = 0.5;
  double annotation_error_px = 2;
  double limb_measure_mm = 0;        ///< standard deviation of every measured limb length
  int annotators = 1;                ///< number of people who mark the same pictures independently: 1 or 2
  int mark_every = 1;                ///< the annotator marks every n-th frame; directions are interpolated in between
  std::vector<double> moments = {};  ///< frames, counted from 1, for which a recording keeps every stage
  /// The cameras take every n-th frame only; used if the cameras are the sensor of another task, whose takes are long.
  int picture_every = 1;

  bool IsPictured(std::size_t frame) const { return frame % static_cast<std::size_t>(picture_every) == 0; }
  /// Returns the number of pictures that a camera takes of `frames` frames.
  std::size_t PicturesOf(std::size_t frames) const {
    const auto every = static_cast<std::size_t>(picture_every);
    return (frames + every - 1) / every;
  }
  /// Returns true for frames that are pictured and marked.
  bool IsMarked(std::size_t frame) const {
    return IsPictured(frame) && frame % static_cast<std::size_t>(mark_every) == 0;
  }
};

/// The body that a skeleton is made with.
enum class BodyKind {
  kFitted,  ///< "fitted": the performer's own joints
  kPaper,   ///< "paper": paper B's 29 degrees of freedom, with the performer's limb lengths
};

/// What to do with a camera that disagrees with the others.
enum class OutlierRule { kKeep, kReject };

/// How the times of pictures are determined.
enum class Sync {
  kAssumed,    ///< "assumed": frames of the same number were taken at the same time
  kEstimated,  ///< "estimated": from the motion of the marks
};

/// The stages of the pipeline that are replaced by the truth, to measure their cost in the final error. `marks`:
/// strokes and discs are at the true joints wherever a picture shows the limb or end. `start`, `ik`: the pose of the
/// method's body that is nearest to the truth (`FindNearestPoses`).
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

/// The way from pictures to the poses of a body.
enum class Recovery {
  kIk,      ///< "ik": limb directions and ends, lengths fixed, inverse kinematics (paper B)
  kEnds,    ///< "ends": every joint triangulated from the strokes that end there; no body, no inverse kinematics
  kBundle,  ///< "bundle": bundle adjustment of one body in smooth motion to all marks of all frames
  /// "keypoints": the method of `etude capture`: joints triangulated robustly, and a body with their median lengths
  /// fitted to all of them (engine/keypoints)
  kKeypoints,
  /// "silhouettes": no marks; a body is fitted to the masks and tracked from frame to frame (engine/silhouettes)
  kSilhouettes,
};

/// The smoothing of the joints of a whole take.
enum class Smoothing {
  kNone,  ///< "none"
  kRts,   ///< "rts": each joint's track by itself (Rauch, Tung and Striebel)
};

/// The source of the limb lengths.
enum class LengthSource {
  kKnown,     ///< "known": measured on the performer beforehand (paper B)
  kMeasured,  ///< "measured": from the marks of a few frames
};

/// How a method that tracks silhouettes starts.
enum class SilhouetteStart {
  kCold,  ///< "cold": from the pictures alone
  kNear,  ///< "near": from the first frame's true pose with errors of up to 10° in every angle
  /// "keypoints": as kCold, but in every picture the marks give the positions of joints, as the keypoints of a pose
  /// estimator would
  kKeypoints,
};

/// The source of the marks in the pictures.
enum class MarkSource {
  kAnnotator,  ///< "annotator": a person, by hand (paper B)
  /// "colours": no marks by hand; the colours of a coded suit identify the limbs (engine/vision/limb_colours)
  kColours,
};

/// The part of a method's work that an outside program does.
enum class CaptureSeat {
  kNone,
  kSegmenter,  ///< "segmenter": it cuts the person out of the pictures
};
const std::vector<std::string>& CaptureSeatNames();

class SeatedSegmenter;

/// A method: a pipeline with its settings.
struct CaptureMethod {
  std::string name;
  CaptureSeat seat = CaptureSeat::kNone;
  SeatedSegmenter* program = nullptr;  ///< the program in that seat during a run
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
  /// If set, no frame's skeleton uses later pictures, as in a live system. For `kIk` and `kSilhouettes`.
  bool causal = false;
  Oracle oracle;

  bool operator==(const CaptureMethod&) const = default;
};

const FieldTable<StudioOptions>& CaptureConditionFields();
const FieldTable<CaptureMethod>& CaptureMethodFields();
/// CaptureMethodFields with `seat`, for the task's own pictures (not for cameras as another task's sensor).
const FieldTable<CaptureMethod>& SeatedCaptureMethodFields();

/// Complains of a method at `place` that reads the colours of a suit, if nobody wears the suit in this studio.
Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place);

/// How the person is cut out of the pictures, by a segmenter or by the truth, and where marks come from.
struct PersonSource {
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces = PersonPieces::kLargest;
  bool is_truth = false;
  /// True for methods that use silhouettes: masks are kept. The pictures are not marked …
  bool for_silhouettes = false;
  bool has_keypoints = false;          ///< … unless this is set
  SeatedSegmenter* program = nullptr;  ///< replaces the segmenter
  bool has_true_marks = false;         ///< exact marks at the true joints, where the picture shows them
  bool has_coloured_marks = false;     ///< marks from the suit's colours
  auto operator<=>(const PersonSource&) const = default;
};

/// Returns how the method cuts out the person.
PersonSource PersonSourceOf(const CaptureMethod& method);
/// Adds a source if it is new: methods with equal sources share the same marks.
void AddSource(const PersonSource& source, std::vector<PersonSource>& sources);

/// The key of a condition that names a file of the user's own cameras (`ReadRig`).
constexpr const char* kRigFileKey = "rig_file";

/// Reads the calibration file that a condition with `rig: file` names into `options.rig.own`.
Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options);

}  // namespace etude
