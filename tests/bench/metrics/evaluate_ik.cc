#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/ik_error.h"
#include "engine/base/angles.h"
#include "tests/bench/metrics/evaluators.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

IkErrorSummary IkErrors(const Json& in) {
  std::vector<EffectorError> errors;
  for (const Json& effector : in.at("effectors")) {
    EffectorTarget target{.position = ReadPoint(effector.at("target_m")), .axes = ReadAxes(effector.at("target_axes"))};
    errors.push_back(ErrorOf({ReadPoint(effector.at("position_m")), ReadAxes(effector.at("axes"))}, target));
  }
  return SummariseIkErrors(errors);
}

/// Returns which parts of the targets count; both if the input does not say.
IkTargetParts AskedOf(const Json& in) {
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

}  // namespace

std::span<const Evaluator> IkEvaluators() {
  static constexpr Evaluator kAll[] = {
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
  };
  return kAll;
}

}  // namespace etude
