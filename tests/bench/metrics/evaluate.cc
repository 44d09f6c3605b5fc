#include "tests/bench/metrics/evaluate.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/detection.h"
#include "bench/metrics/ik_cost.h"
#include "bench/metrics/ik_error.h"
#include "bench/metrics/measurement.h"
#include "bench/metrics/pose_error.h"
#include "bench/metrics/segmentation.h"
#include "bench/metrics/share.h"
#include "bench/metrics/tracking.h"
#include "engine/base/angles.h"
#include "tests/bench/metrics/evaluate_parts.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

using Value = EvaluatedMetric;

// Inverse kinematics.

IkErrorSummary IkErrors(const Json& in) {
  std::vector<EffectorError> errors;
  for (const Json& effector : in.at("effectors")) {
    EffectorTarget target;
    target.position = ReadPoint(effector.at("target_m"));
    target.axes = ReadAxes(effector.at("target_axes"));
    errors.push_back(ErrorOf({ReadPoint(effector.at("position_m")), ReadAxes(effector.at("axes"))}, target));
  }
  return SummariseIkErrors(errors);
}

/// What the world asks for; both, where nothing is said.
IkAsked AskedOf(const Json& in) {
  const auto asked = in.value("asked", std::string("both"));
  return {.positions = asked != "orientation", .axes = asked != "position"};
}

int LimitViolationsOf(const Json& in) {
  std::vector<double> angles;
  std::vector<AngleRange> limits;
  for (const Json& degrees : in.at("found_deg")) angles.push_back(Radians(degrees.get<double>()));
  for (const Json& range : in.at("limits_deg")) {
    limits.push_back({Radians(range.at(0).get<double>()), Radians(range.at(1).get<double>())});
  }
  return CountLimitViolations(angles, limits);
}

double AngleDifferenceDeg(const Json& in, const char* other_key) {
  const auto radians = [&](const char* key) {
    auto angles = in.at(key).get<std::vector<double>>();
    for (double& angle : angles) angle = Radians(angle);
    return angles;
  };
  return HiddenAngleDifferenceDeg(radians("found_deg"), radians(other_key));
}

double PenalisedCostOf(const Json& in, const char* spent, const char* limit) {
  return PenalisedCost(in.at(spent).get<double>(), in.at(limit).get<double>(), in.at("solved").get<bool>());
}

// Tracking.

std::vector<TrackedFrame> TrackedFrames(const Json& in) {
  std::vector<TrackedFrame> frames;
  for (const Json& frame : in.at("frames")) frames.push_back({IkErrors(frame)});
  return frames;
}

FrameIterations IterationsOf(const Json& in) {
  return SummariseIterations(in.at("frame_iterations").get<std::vector<int>>());
}

Value JerkRatio(const Json& in) {
  const auto angles = [&](const char* key) {
    auto frames = in.at(key).get<std::vector<std::vector<double>>>();
    for (std::vector<double>& frame : frames) std::ranges::transform(frame, frame.begin(), Radians);
    return frames;
  };
  return AngleJerkRatio(angles("found_frames_deg"), angles("true_frames_deg"));
}

// Camera capture.

PoseErrors PoseErrorsOf(const Json& in, const char* found) {
  return ComparePoses(ReadMotion(in.at(found)).poses, ReadMotion(in.at("truth")).poses);
}

std::vector<Sighted> SightedThings(const Json& list) {
  std::vector<Sighted> things;
  for (const Json& thing : list) {
    things.push_back({ReadOptionalPoint(thing.at("found")), ReadOptionalPoint(thing.at("truth"))});
  }
  return things;
}

double ReprojectionOf(const Json& in) {
  std::vector<std::vector<PointPair>> pairs;
  std::vector<CameraFit> fits;
  for (const Json& camera : in.at("cameras")) {
    std::vector<PointPair>& list = pairs.emplace_back();
    for (std::size_t i = 0; i < camera.at("points_m").size(); ++i) {
      const Json& pixel = camera.at("pixels").at(i);
      list.push_back({ReadPoint(camera.at("points_m").at(i)), {pixel.at(0).get<double>(), pixel.at(1).get<double>()}});
    }
    fits.push_back({{camera.at("matrix").get<std::array<std::array<double, 4>, 3>>()}, list});
  }
  return MeanReprojectionRmsPx(fits);
}

Value ShareOfFrames(const Json& in) {
  const auto recovered = in.at("recovered").get<std::vector<int>>();
  return Share(std::count(recovered.begin(), recovered.end(), 1), static_cast<std::int64_t>(recovered.size()));
}

MaskScore MasksOf(const Json& in) {
  std::vector<MaskScore> scores;
  for (const Json& image : in.at("images")) {
    scores.push_back(ScoreMask(ReadMask(image.at("found")), ReadMask(image.at("truth")), ReadMask(image.at("shadow"))));
  }
  return MeanScore(scores);
}

// Move detection.

std::vector<JudgedEvent> EventsOf(const Json& in) {
  std::vector<JudgedEvent> events;
  for (const Json& event : in.at("events")) {
    events.push_back({event.at("right").get<bool>(), event.at("called").get<bool>(), event.at("score").get<double>()});
  }
  return events;
}

Confusion ConfusionOf(const Json& in) { return CountConfusion(EventsOf(in)); }

Value Latency(const Json& in) {
  std::vector<Wait> waits;
  for (const Json& event : in.at("performances")) {
    const Json& called = event.at("called_frame");
    waits.push_back(WaitForPraise(event.at("first_right_s").get<double>(),
                                  called.is_null() ? std::nullopt : std::optional(called.get<int>()),
                                  event.at("window_end_frame").get<int>(), in.at("rate_hz").get<double>()));
  }
  return KaplanMeierMedian(waits);
}

double FalseAlarms(const Json& in) {
  std::vector<MoveWindow> windows;
  for (const Json& window : in.at("windows")) {
    windows.push_back({window.at("asked").get<std::string>(), window.at("danced").get<std::string>(),
                       window.at("begin_frame").get<int>(), window.at("end_frame").get<int>()});
  }
  std::size_t alarms = 0;
  for (const Json& call : in.at("calls")) {
    alarms += IsFalseAlarm(call.at("move").get<std::string>(), call.at("frame").get<int>(), windows);
  }
  return FalseAlarmsPerMinute(alarms, in.at("frames").get<double>() / in.at("rate_hz").get<double>());
}

constexpr Evaluator kOtherEvaluators[] = {
    {"position_error_cm", [](const Json& in) -> Value { return IkErrors(in).position_cm; }},
    {"position_error_max_cm", [](const Json& in) -> Value { return IkErrors(in).position_max_cm; }},
    {"orientation_error_deg", [](const Json& in) -> Value { return IkErrors(in).orientation_deg; }},
    {"orientation_error_max_deg", [](const Json& in) -> Value { return IkErrors(in).orientation_max_deg; }},
    {"hidden_angle_error_deg", [](const Json& in) -> Value { return AngleDifferenceDeg(in, "true_deg"); }},
    {"hidden_angle_change_deg", [](const Json& in) -> Value { return AngleDifferenceDeg(in, "start_deg"); }},
    {"solved_practical",
     [](const Json& in) -> Value { return IsSolvedPractically(IkErrors(in), AskedOf(in)) ? 1 : 0; }},
    {"solved_tight", [](const Json& in) -> Value { return IsSolvedTightly(IkErrors(in), AskedOf(in)) ? 1 : 0; }},
    {"limit_violations", [](const Json& in) -> Value { return LimitViolationsOf(in); }},
    {"iterations", [](const Json& in) -> Value { return in.at("iterations").get<double>(); }},
    {"fk_evaluations", [](const Json& in) -> Value { return in.at("fk_evaluations").get<double>(); }},
    {"iterations_par2", [](const Json& in) -> Value { return PenalisedCostOf(in, "iterations", "max_iterations"); }},
    {"fk_evaluations_par2",
     [](const Json& in) -> Value { return PenalisedCostOf(in, "fk_evaluations", "max_fk_evaluations"); }},

    {"frames_solved", [](const Json& in) -> Value { return ShareSolvedPractically(TrackedFrames(in)); }},
    {"frames_solved_tight", [](const Json& in) -> Value { return ShareSolvedTightly(TrackedFrames(in)); }},
    {"iterations_per_frame", [](const Json& in) -> Value { return IterationsOf(in).mean; }},
    {"iterations_per_frame_p95", [](const Json& in) -> Value { return IterationsOf(in).p95; }},
    {"angle_jerk_ratio", JerkRatio},

    {"mpjpe_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").mpjpe_mm; }},
    {"mpjpe_before_ik_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "before_ik").mpjpe_mm; }},
    {"pa_mpjpe_mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").pa_mpjpe_mm; }},
    {"pck_50mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").pck_50mm; }},
    {"auc_200mm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").auc_200mm; }},
    {"bone_length_error_cm", [](const Json& in) -> Value { return PoseErrorsOf(in, "found").bone_length_error_cm; }},
    {"limb_direction_error_deg",
     [](const Json& in) -> Value { return LimbDirectionErrorDeg(SightedThings(in.at("limbs"))).mean; }},
    {"limb_direction_coverage",
     [](const Json& in) -> Value { return LimbDirectionErrorDeg(SightedThings(in.at("limbs"))).coverage; }},
    {"triangulation_error_mm",
     [](const Json& in) -> Value { return TriangulationErrorMm(SightedThings(in.at("ends_m"))).mean; }},
    {"triangulation_coverage",
     [](const Json& in) -> Value { return TriangulationErrorMm(SightedThings(in.at("ends_m"))).coverage; }},
    {"reprojection_rms_px", [](const Json& in) -> Value { return ReprojectionOf(in); }},
    {"frames_recovered", ShareOfFrames},
    {"iou", [](const Json& in) -> Value { return MasksOf(in).iou; }},
    {"mask_precision", [](const Json& in) -> Value { return MasksOf(in).precision; }},
    {"mask_recall", [](const Json& in) -> Value { return MasksOf(in).recall; }},
    {"mask_f1", [](const Json& in) -> Value { return MasksOf(in).f1; }},
    {"shadow_error", [](const Json& in) -> Value { return MasksOf(in).shadow_error; }},

    {"precision", [](const Json& in) -> Value { return Precision(ConfusionOf(in)); }},
    {"recall", [](const Json& in) -> Value { return Recall(ConfusionOf(in)); }},
    {"f1", [](const Json& in) -> Value { return F1(ConfusionOf(in)); }},
    {"roc_auc", [](const Json& in) -> Value { return RocAuc(EventsOf(in)); }},
    {"latency_s", Latency},
    {"false_alarms_per_min", [](const Json& in) -> Value { return FalseAlarms(in); }},
};

const Evaluator* FindEvaluator(std::span<const Evaluator> evaluators, std::string_view metric) {
  const auto found = std::ranges::find(evaluators, metric, &Evaluator::metric);
  return found == evaluators.end() ? nullptr : &*found;
}

}  // namespace

Result<std::optional<double>> EvaluateMetric(std::string_view metric, std::string_view input_json) {
  const Evaluator* evaluator = FindEvaluator(kOtherEvaluators, metric);
  if (evaluator == nullptr) evaluator = FindEvaluator(TransitionEvaluators(), metric);
  if (evaluator == nullptr) return Fail({}, "no function evaluates the metric '{}'", metric);
  try {
    return evaluator->value(Json::parse(input_json));
  } catch (const Json::exception& error) {
    return Fail({}, "not an input of {}: {}", metric, error.what());
  }
}

}  // namespace etude
