#pragma once

#include <string>

#include "bench/tasks/base/solver_fields.h"
#include "engine/cameras/dlt.h"
#include "engine/vision/change_detection.h"
#include "sim/camera/camera_effects.h"
#include "sim/rig/rig.h"

namespace etude {

enum class Clothes {
  kStudio,    ///< "studio": colours that stand apart from the room's, as one would dress for it
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
};

/// What the cameras are calibrated with.
enum class CalibrationTargetKind {
  kPoints,  ///< "points": marked on planes, and clicked in the picture (paper B)
  kBoards,  ///< "boards": a cube of calibration boards, found in the picture
};

/// One condition of a capture scenario: the studio and what goes wrong in it.
struct StudioOptions {
  double duration_s = 2;
  RigOptions rig = {};  ///< where the cameras stand
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
  int annotators = 1;  ///< people who mark the same pictures, each by themselves: 1 or 2
  int mark_every = 1;  ///< the annotator marks every n-th frame; directions are interpolated in between
};

/// A stage of the pipeline can be replaced by the truth, to see what it costs in the final error.
struct Oracle {
  bool calibration = false;
  bool segmentation = false;
  bool directions = false;
  bool points = false;
};

/// What tells where the limbs are.
enum class LimbSource {
  kStrokes,      ///< "strokes": a human's marks (paper B)
  kSilhouettes,  ///< "silhouettes": nothing but what was cut out (engine/silhouettes)
};

/// What a method that follows silhouettes begins with.
enum class SilhouetteStart {
  kCold,  ///< "cold": the pictures alone
  kNear,  ///< "near": the first frame's true pose, every angle wrong by up to 10°: as if agreed on beforehand
};

/// A pipeline with its settings.
struct CaptureMethod {
  std::string name;
  LimbSource limbs = LimbSource::kStrokes;
  SilhouetteStart start = SilhouetteStart::kCold;
  Segmenter segmenter = Segmenter::kHue;
  Calibration calibration = Calibration::kDlt;
  const IkSolver* solver = DefaultIkSolver();
  IkOptions ik = IkBudget(100);
  Oracle oracle;
};

const FieldTable<StudioOptions>& CaptureConditionFields();
const FieldTable<CaptureMethod>& CaptureMethodFields();

}  // namespace etude
