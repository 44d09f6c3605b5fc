#pragma once

#include <string>
#include <vector>

#include "bench/tasks/base/solver_fields.h"
#include "engine/cameras/dlt.h"
#include "engine/vision/change_detection.h"

namespace etude {

enum class Clothes {
  kStudio,    ///< "studio": colours that stand apart from the room's, as one would dress for it
  kEveryday,  ///< "everyday": a grey shirt and dark blue trousers, in a room with a bluish floor
};

/// One condition of a capture scenario: the studio and what goes wrong in it.
struct StudioOptions {
  double duration_s = 2;
  /// Where the two cameras stand: angles about the performer (0 = in front, positive = to the performer's
  /// left), and heights. Two cameras alike cannot tell the direction of a limb parallel to the line
  /// between them, and a performer facing them has hips, shoulders and stretched arms there: so they
  /// stand at different heights.
  std::vector<double> camera_angles_deg = {-40, 40};
  std::vector<double> camera_heights_m = {1.0, 2.2};
  double camera_distance_m = 3.8;
  Clothes clothes = Clothes::kStudio;
  /// 0 = the studio; 1 = a furnished room with people and things that move (sim/stage/README.md has the steps between).
  double scene = 0;
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
