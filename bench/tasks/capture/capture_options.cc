#include "bench/tasks/capture/capture_options.h"

#include <algorithm>
#include <optional>

#include "bench/tasks/base/solver_fields.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr std::size_t kCameraCount = 2;

// One number per camera.
std::vector<double> ReadPerCamera(Fields& condition, std::string_view key, const std::vector<double>& fallback,
                                  Range range) {
  const Node* node = condition.Raw(key);
  if (node == nullptr) return fallback;
  std::vector<double> values = condition.Numbers(key, range);
  if (values.size() == kCameraCount) return values;
  condition.Complain(node->place, fmt::format("'{}' has {} numbers; it needs one for each of the {} cameras", key,
                                              values.size(), kCameraCount));
  return fallback;
}

const std::vector<std::string> kOracles = {"calibration", "segmentation", "directions", "points"};

Oracle ReadOracle(Fields& fields) {
  Oracle oracle;
  const Node* node = fields.Raw("oracle");
  if (node == nullptr) return oracle;
  const std::vector<std::string> stages = fields.Texts("oracle");
  for (const std::string& stage : stages) {
    if (std::find(kOracles.begin(), kOracles.end(), stage) == kOracles.end()) {
      fields.Complain(node->place, UnknownName("oracle", stage, kOracles));
    }
  }
  auto names = [&](const char* stage) { return std::find(stages.begin(), stages.end(), stage) != stages.end(); };
  return {names("calibration"), names("segmentation"), names("directions"), names("points")};
}

Result<CaptureMethod> ReadMethod(const Node& node) {
  Fields fields(node, "a method of task capture");
  CaptureMethod method;
  method.name = fields.RequiredText("name");
  method.segmenter = SegmenterNamed(fields.Choice("segmenter", SegmenterNames(), "hue"));
  method.calibration = CalibrationNamed(fields.Choice("calibration", CalibrationNames(), "dlt"));
  method.solver = ReadIkSolver(fields, method.ik);
  method.ik.max_iterations = fields.Integer("max_sweeps", 100, {1, 100'000});
  if (const std::optional<double> degrees = fields.OptionalNumber("tolerance_deg", {0, 360})) {
    method.ik.angle_change_tolerance = Radians(*degrees);
  }
  method.oracle = ReadOracle(fields);
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

StudioOptions ReadStudioOptions(Fields& condition) {
  StudioOptions o;
  o.duration_s = condition.Number("duration_s", o.duration_s, {0.1, 60});
  o.camera_angles_deg = ReadPerCamera(condition, "camera_angles_deg", o.camera_angles_deg, {-180, 180});
  o.camera_heights_m = ReadPerCamera(condition, "camera_heights_m", o.camera_heights_m, {0.2, 5});
  o.camera_distance_m = condition.Number("camera_distance_m", o.camera_distance_m, {2, 10});
  if (condition.Choice("clothes", {"studio", "everyday"}, "studio") == "everyday") o.clothes = Clothes::kEveryday;
  o.light_drift = condition.Number("light_drift", o.light_drift, {0, 0.5});
  o.camera_noise = condition.Number("camera_noise", o.camera_noise, {0, 20});
  o.calibration_pairs = condition.Integer("calibration_pairs", o.calibration_pairs, {6, 1000});
  o.calibration_noise_px = condition.Number("calibration_noise_px", o.calibration_noise_px, {0, 20});
  o.annotation_error_px = condition.Number("annotation_error_px", o.annotation_error_px, {0, 50});
  o.mark_every = condition.Integer("mark_every", o.mark_every, {1, 300});
  return o;
}

Result<std::vector<CaptureMethod>> ReadCaptureMethods(std::span<const Node> methods) {
  std::vector<CaptureMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> CaptureConditionKeys() {
  return {{"duration_s", "0.1…60", "2", "Length of the filmed window."},
          {"camera_angles_deg", "two of −180…180", "[-40, 40]",
           "Where the cameras stand about the performer: 0 = in front, positive = to the performer's left."},
          {"camera_heights_m", "two of 0.2…5", "[1.0, 2.2]", "How high the cameras stand."},
          {"camera_distance_m", "2…10", "3.8", "From the middle of the stage."},
          {"clothes", "studio, everyday", "studio",
           "Colours that stand apart from the room's, or a grey shirt and trousers of the floor's hue."},
          {"light_drift", "0…0.5", "0.06", "Largest relative change of the lamp's brightness."},
          {"camera_noise", "0…20", "1", "Multiplies the camera's usual noise."},
          {"calibration_pairs", "6…1000", "24", "Measured points per camera."},
          {"calibration_noise_px", "0…20", "0.5", "Standard deviation of a calibration point's pixel, in u and in v."},
          {"annotation_error_px", "0…50", "2", "Standard deviation of the human's marks, in u and in v."},
          {"mark_every", "1…300", "1", "The human marks every n-th frame; what lies between is interpolated."}};
}

std::vector<KeyInfo> CaptureMethodKeys() {
  std::vector<KeyInfo> keys = {
      {"segmenter", Join(SegmenterNames()), "hue", "How the person is cut out of the pictures."},
      {"calibration", Join(CalibrationNames()), "dlt", "How a camera is computed from its calibration points."},
      {"tolerance_deg", "0…360", "(no bound)", "How far an angle may leave the one seen in the images."},
      {"max_sweeps", "1…100000", "100", "The solver's steps per frame, at most."},
      {"oracle", "a list of " + Join(kOracles), "[]", "Stages replaced by the truth."}};
  const std::vector<KeyInfo> solver_keys = IkSolverKeys();
  keys.insert(keys.end(), solver_keys.begin(), solver_keys.end());
  return keys;
}

}  // namespace etude
