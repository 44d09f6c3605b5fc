#pragma once

#include <string>

#include "bench/tasks/base/solver_fields.h"
#include "engine/cameras/dlt.h"
#include "engine/vision/change_detection.h"
#include "sim/rig/rig.h"

namespace etude {

enum class Clothes {
  kStudio,    ///< "studio": colours that stand apart from the room's, as one would dress for it
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
};

/// One condition of a capture scenario: the studio and what goes wrong in it.
struct StudioOptions {
  double duration_s = 2;
  RigOptions rig = {};  ///< where the cameras stand
  Clothes clothes = Clothes::kStudio;
  double light_drift = 0.06;   ///< largest relative change of the lamp's brightness
  double camera_noise = 1;     ///< multiplies the camera sensor's usual noise
  int calibration_pairs = 24;  ///< measured points per camera
  double calibration_noise_px = 0.5;
  double annotation_error_px = 2;
  int mark_every = 1;  ///< the annotator marks every n-th frame; directions are interpolated in between
};

/// A stage of the pipeline can be replaced by the truth, to see what it costs in the final error.
struct Oracle {
  bool calibration = false;
  bool segmentation = false;
  bool directions = false;
  bool points = false;
};

/// A pipeline with its settings.
struct CaptureMethod {
  std::string name;
  Segmenter segmenter = Segmenter::kHue;
  Calibration calibration = Calibration::kDlt;
  const IkSolver* solver = DefaultIkSolver();
  IkOptions ik = IkBudget(100);
  Oracle oracle;
};

const FieldTable<StudioOptions>& CaptureConditionFields();
const FieldTable<CaptureMethod>& CaptureMethodFields();

}  // namespace etude
