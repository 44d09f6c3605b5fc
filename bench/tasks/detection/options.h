#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bench/keys/field_table.h"
#include "bench/tasks/base/sensor_key.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/sensing/options.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "sim/performer/session.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// The key of a condition that names a file of taught moves (`etude teach`).
constexpr const char* kMovesKey = "moves";

/// The object between sensor and performer (`MakeOccluders`).
enum class OccluderKind { kNone, kTable, kChair, kPerson };

/// The operating point at which methods are compared. Thresholds are set on other people under the same condition. Half
/// of these people's performances have faults of any severity, whatever the condition says about the judged people.
/// Each method spots moves at the threshold that gives `false_alarms_per_min`, and judges performances at the threshold
/// at which it calls the share `recall` of the right performances right. No method can thus appear better merely
/// because it says yes, or no, more often.
struct OperatingPoint {
  double false_alarms_per_min = 1;
  double recall = 0.9;  ///< share of the right performances that each method calls right at its threshold
  int sessions = 24;    ///< number of sessions, each with a different person
};

/// The thresholds of a method for its two decisions. Spotting decides at any time if a move was performed; judging
/// decides if the requested performance is right.
struct MethodDecision {
  DecisionOptions spotting;
  double judging = 0.5;  ///< the evidence at or above which a performance is called right
};

/// One condition of a detection scenario: the performers and the quality of the sensor.
///
///     events: 8        # performances in one session
///     people: mixed    # the performers: toddler, school-child, adult, expert, absent, or a mixture
///     fault_share: 0.5 # share of performances with a fault
///     severity: 0.7    # severity of every fault; random if absent
///     noise: 1         # factor of every error of the sensor
///     sensor: v2       # the sensor: v1, v2, a sensor file, or cameras
///     turn_deg: 0      # the angle by which the performer is turned away from the sensor
///     occluder: none   # the object between the two: none, table, chair, person
struct DetectionOptions {
  std::string moves;  ///< a file of taught moves (etude teach); only for recordings
  SessionOptions session;
  double noise = 1;
  /// The sensor's options without the noise factor. The task sets them from the sensor that the condition names.
  SkeletonSensorOptions sensor = SensorV2();
  double turn_deg = 0;
  std::optional<double> distance_m;  ///< distance of the performer; if absent, drawn in each trial from 2.5 to 3 m
  double sensor_height_m = 1;
  OccluderKind occluder = OccluderKind::kNone;
  bool has_cameras = false;  ///< true with `sensor: cameras`; of the members above, only `session` is then used
  CameraSensing cameras;
  std::optional<double> threshold;                ///< threshold of methods that do not set their own
  std::optional<OperatingPoint> operating_point;  ///< sets the thresholds of methods that do not set their own
};

/// One method: the stages from the sensor's stream to verdicts.
///
///     - {name: adaptive, filter: holt, recogniser: key-pose, weights: adaptive, threshold: 0.5}
struct DetectionMethod {
  std::string name;
  FilterOptions filter;
  bool sees_truth = false;  ///< true: the method receives the true motion (`oracle: [stream]`)
  /// If cameras are the sensor: the method by which pictures become skeletons; nullopt = the defaults of task capture.
  std::optional<CaptureMethod> capture = {};
  RecogniserOptions recogniser;
  std::optional<double> threshold;  ///< the method's own threshold; nullopt = the recogniser's default
  double refractory_s = DecisionOptions{}.refractory_s;

  CaptureMethod Capture() const { return capture.value_or(CaptureMethod{}); }
  /// Returns the threshold for both decisions: the method's own, or the recogniser's default.
  MethodDecision Decision() const {
    const double both = threshold.value_or(recogniser.kind->threshold);
    return {.spotting = {.threshold = both, .refractory_s = refractory_s}, .judging = both};
  }
};

/// Returns the options of the sensor that the condition names. If it names no sensor, or cameras, returns the options
/// of v2.
Result<SkeletonSensorOptions> SensorOf(const TaskInput& input);
/// Adds an error for each key that belongs to another sensor than the condition's.
void CheckSensorKeys(Fields& condition, DetectionOptions& options);
/// Prepares the cameras for every method if the condition uses cameras as its sensor. Otherwise fails if a method sets
/// `capture`. `methods` are in the order of the input's methods; `sight` returns a method's DetectionMethod.
template <typename Methods, typename Sight>
Result<void> PrepareCameras(const TaskInput& input, const Methods& methods, Sight sight, DetectionOptions& options) {
  RETURN_IF_ERROR(OpenOwnCameras(input, options.cameras.studio));
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const DetectionMethod& method = std::invoke(sight, methods[i]);
    if (method.capture && !options.has_cameras) {
      return Fail(input.methods[i].place, "'capture' is allowed only with {}: {}", kSensorKey, kCameraSensor);
    }
    if (!options.has_cameras) continue;
    RETURN_IF_ERROR(CheckMarks(options.cameras.studio, method.Capture(), input.methods[i].place));
    AddSource(PersonSourceOf(method.Capture()), options.cameras.sources);
  }
  return {};
}

const FieldTable<DetectionOptions>& DetectionConditionFields();
/// PeopleKeys returns the keys of a condition that describe the simulated people, SensingKeys those that describe the
/// sensing.
std::span<const std::string_view> PeopleKeys();
std::span<const std::string_view> SensingKeys();
/// Returns the keys of a method. A condition may also set `threshold` for all methods, so that it can be swept.
const FieldTable<DetectionMethod>& DetectionMethodFields();

}  // namespace etude
