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
  kStudio,    ///< "studio": colours that stand apart from the room's, as one would dress for it
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
  kCoded,     ///< "coded": a suit of which every limb has a colour of its own
};

/// The figure that is drawn.
enum class PerformerFigure {
  kStaged,  ///< "staged": the stage's own people, dressed as `clothes` and `scene` say
  kOwn,     ///< "own": the meshes and textures that the clip's file brings
};

/// The target that the cameras are calibrated with.
enum class CalibrationTargetKind {
  kPoints,  ///< "points": marked on planes, and clicked in the picture (paper B)
  kMarks,   ///< "marks": discs on planes, pointed at and then found in the picture
  kBoards,  ///< "boards": a cube of calibration boards, found in the picture
};

/// One condition of a capture scenario: the studio and what goes wrong in it.
struct StudioOptions {
  double duration_s = 2;
  RigOptions rig = {};  ///< where the cameras stand
  PerformerFigure figure = PerformerFigure::kStaged;
  Clothes clothes = Clothes::kStudio;
  /// 0 = the studio; 1 = a furnished room with people and things that move (sim/stage/README.md has the steps between).
  double scene = 0;
  double light_drift = 0.06;  ///< largest relative change of the lamp's brightness
  CameraEffects camera = {};  ///< of every camera
  CalibrationTargetKind calibration_target = CalibrationTargetKind::kPoints;
  int calibration_pairs = 24;         ///< kPoints: measured points per camera
  double calibration_measure_mm = 0;  ///< error of the target's measured places, standard deviation along each axis
  double calibration_noise_px = 0.5;
  double annotation_error_px = 2;
  double limb_measure_mm = 0;        ///< error of every measured limb, standard deviation
  int annotators = 1;                ///< people who mark the same pictures, each by themselves: 1 or 2
  int mark_every = 1;                ///< the annotator marks every n-th frame; directions are interpolated in between
  std::vector<double> moments = {};  ///< frames, counted from 1, of which a recording keeps every stage
  /// The cameras take every n-th frame only; where they are the sensor of another task, whose takes are long.
  int picture_every = 1;

  bool IsPictured(std::size_t frame) const { return frame % static_cast<std::size_t>(picture_every) == 0; }
  /// The number of pictures that a camera takes of so many frames.
  std::size_t PicturesOf(std::size_t frames) const {
    const auto every = static_cast<std::size_t>(picture_every);
    return (frames + every - 1) / every;
  }
  /// True for frames that are pictured and marked.
  bool IsMarked(std::size_t frame) const {
    return IsPictured(frame) && frame % static_cast<std::size_t>(mark_every) == 0;
  }
};

/// The body that a skeleton is made with.
enum class BodyKind {
  kFitted,  ///< "fitted": the performer's own joints
  kPaper,   ///< "paper": paper B's 29 degrees of freedom, with the performer's limb lengths
};

/// The rule for a camera that disagrees with the others.
enum class OutlierRule { kKeep, kReject };

/// The source of the times of pictures.
enum class Sync {
  kAssumed,    ///< "assumed": frames of one number are taken at one time
  kEstimated,  ///< "estimated": from how marks move
};

/// A stage of the pipeline can be replaced by the truth, to see what it costs in the final error. Of `marks`: where a
/// picture shows a limb or an end, the strokes and discs run to where the true joints are in it. Of `start`, `ik`: the
/// pose of the method's body that is nearest to the truth (`FindNearestPoses`).
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
  kBundle,  ///< "bundle": all marks of all frames explained at once by one body in smooth motion
  /// "keypoints": what `etude capture` makes of marks: joints triangulated robustly, a body of their own median lengths
  /// fitted to all of them (engine/keypoints)
  kKeypoints,
  /// "silhouettes": no marks; a body fitted to what was cut out, and followed from frame to frame (engine/silhouettes)
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

/// The start of a method that follows silhouettes.
enum class SilhouetteStart {
  kCold,  ///< "cold": the pictures alone
  kNear,  ///< "near": the first frame's true pose, every angle wrong by up to 10°: as if agreed on beforehand
  /// "keypoints": marks, taken for an estimator's keypoints, tell in every picture where joints are, beside its outline
  kKeypoints,
};

/// The source of the marks in the pictures.
enum class MarkSource {
  kAnnotator,  ///< "annotator": a person, by hand (paper B)
  kColours,    ///< "colours": nobody; limbs are told by the colours of a coded suit (engine/vision/limb_colours)
};

/// The part of a method's work that a program does.
enum class CaptureSeat {
  kNone,
  kSegmenter,  ///< "segmenter": it cuts the person out of the pictures
};
const std::vector<std::string>& CaptureSeatNames();

class SeatedSegmenter;

/// A pipeline with its settings.
struct CaptureMethod {
  std::string name;
  CaptureSeat seat = CaptureSeat::kNone;
  SeatedSegmenter* program = nullptr;  ///< in that seat, while it is there
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces =
      PersonPieces::kLargest;  ///< of methods that read silhouettes all large ones, whatever stands here
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
  /// No frame's skeleton may come of later pictures, as that of a live system. Of `kIk` and `kSilhouettes`.
  bool causal = false;
  Oracle oracle;

  bool operator==(const CaptureMethod&) const = default;
};

const FieldTable<StudioOptions>& CaptureConditionFields();
const FieldTable<CaptureMethod>& CaptureMethodFields();
/// CaptureMethodFields with `seat`, for pictures that are the task's own and no other task's sensor.
const FieldTable<CaptureMethod>& SeatedCaptureMethodFields();

/// Refuses a method, written at `place`, that reads colours which nobody wears in this studio.
Result<void> CheckMarks(const StudioOptions& options, const CaptureMethod& method, const Place& place);

/// The way of cutting the person out of the pictures, by a segmenter or by the truth, and the source of marks.
struct PersonSource {
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces = PersonPieces::kLargest;
  bool is_truth = false;
  /// Cut out for methods that read silhouettes alone: masks are kept, and nobody marks the pictures.
  bool for_silhouettes = false;
  bool has_keypoints = false;          ///< … but somebody marks them all the same
  SeatedSegmenter* program = nullptr;  ///< cuts out in the segmenter's place
  bool has_true_marks = false;      ///< drawn by someone who knows where the joints are, where the picture shows them
  bool has_coloured_marks = false;  ///< nobody marks: the colours of the suit tell limbs apart
  auto operator<=>(const PersonSource&) const = default;
};

/// The method's way of cutting out the person.
PersonSource PersonSourceOf(const CaptureMethod& method);
/// Each source once: methods that cut out alike see the same marks.
void AddSource(const PersonSource& source, std::vector<PersonSource>& sources);

/// The key of a condition that names a file of somebody's own cameras (`ReadRig`).
constexpr const char* kRigFileKey = "rig_file";

/// Reads the calibration file that a condition with `rig: file` names into `options.rig.own`.
Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options);

}  // namespace etude
