#include "bench/tasks/capture/options.h"

namespace etude {
namespace {

template <bool Oracle::*kStage>
bool& OracleOf(CaptureMethod& method) {
  return method.oracle.*kStage;
}

}  // namespace

const FieldTable<StudioOptions>& CaptureConditionFields() {
  using Options = StudioOptions;
  using Key = Field<Options>;
  static const FieldTable<Options> table{
      {Key::Number("duration_s", &Options::duration_s, {0.1, 60}, "Length of the filmed window."),
       Key::Numbers("camera_angles_deg", &Options::camera_angles_deg, "camera", "two of -180…180", {-180, 180},
                    "Where the cameras stand about the performer: 0 = in front, positive = to the performer's left."),
       Key::Numbers("camera_heights_m", &Options::camera_heights_m, "camera", "two of 0.2…5", {0.2, 5},
                    "How high the cameras stand."),
       Key::Number("camera_distance_m", &Options::camera_distance_m, {2, 10}, "From the middle of the stage."),
       Key::Name("clothes", &Options::clothes, {{"studio", Clothes::kStudio}, {"everyday", Clothes::kEveryday}},
                 "Colours that stand apart from the room's, or a grey shirt and trousers of the floor's hue."),
       Key::Number("scene", &Options::scene, {0, 1},
                   "How much a room people live in: 0 = the studio, 1 = furniture, clutter, a second person, hues alike."),
       Key::Number("light_drift", &Options::light_drift, {0, 0.5}, "Largest relative change of the lamp's brightness."),
       Key::Number("camera_noise", &Options::camera_noise, {0, 20}, "Multiplies the camera's usual noise."),
       Key::Number("calibration_pairs", &Options::calibration_pairs, {6, 1000}, "Measured points per camera."),
       Key::Number("calibration_noise_px", &Options::calibration_noise_px, {0, 20},
                   "Standard deviation of a calibration point's pixel, in u and in v."),
       Key::Number("annotation_error_px", &Options::annotation_error_px, {0, 50},
                   "Standard deviation of the annotator's marks, in u and in v."),
       Key::Number("mark_every", &Options::mark_every, {1, 300},
                   "The annotator marks every n-th frame; what lies between is interpolated.")}};
  return table;
}

const FieldTable<CaptureMethod>& CaptureMethodFields() {
  using Method = CaptureMethod;
  using Key = Field<Method>;
  static const FieldTable<Method> table = [] {
    FieldTable<Method> made{{Key::Name("segmenter", &Method::segmenter, SegmenterNames(), SegmenterNamed,
                                       "How the person is cut out of the pictures."),
                             Key::Name("calibration", &Method::calibration, CalibrationNames(), CalibrationNamed,
                                       "How a camera is computed from its calibration points."),
                             ToleranceField(&Method::ik, "How far an angle may leave the one seen in the images."),
                             SweepsField(&Method::ik, "The solver's steps per frame, at most."),
                             Key::Flags("oracle",
                                        {{"calibration", OracleOf<&Oracle::calibration>},
                                         {"segmentation", OracleOf<&Oracle::segmentation>},
                                         {"directions", OracleOf<&Oracle::directions>},
                                         {"points", OracleOf<&Oracle::points>}},
                                        "Stages replaced by the truth.")}};
    const std::vector<Key> solver = IkSolverFields(&Method::solver, &Method::ik);
    made.fields.insert(made.fields.end(), solver.begin(), solver.end());
    return made;
  }();
  return table;
}

}  // namespace etude
