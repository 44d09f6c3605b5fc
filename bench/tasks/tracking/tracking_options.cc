#include "bench/tasks/tracking/tracking_options.h"

#include <cmath>

#include "bench/tasks/base/solver_fields.h"

namespace etude {
namespace {

constexpr int kMostSweeps = 100'000;

Result<TrackingMethod> ReadMethod(const Node& node, const IkOptions& common) {
  Fields fields(node, "a method of task tracking");
  TrackingMethod method;
  method.options = common;
  method.name = fields.RequiredText("name");
  method.solver = ReadIkSolver(fields, method.options);
  if (fields.Choice("start", {"warm", "cold"}, "warm") == "cold") method.start = FrameStart::kCold;
  if (const std::optional<double> degrees = fields.OptionalNumber("tolerance_deg", {0, 360})) {
    method.options.angle_change_tolerance = Radians(*degrees);
  }
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

TrackingOptions ReadTrackingOptions(Fields& condition) {
  TrackingOptions o;
  o.duration_s = condition.Number("duration_s", o.duration_s, {0.1, 60});
  o.rate_hz = condition.Number("rate_hz", o.rate_hz, {1, kJudgedRateHz});
  o.target_noise.position_cm = condition.Number("target_noise_cm", 0, {0, 100});
  o.target_noise.orientation_deg = condition.Number("target_noise_deg", 0, {0, 180});
  o.joint_noise_deg = condition.OptionalNumber("joint_noise_deg", {0, 180});
  const auto frames = std::lround(o.duration_s * o.rate_hz);
  if (frames < kFewestTrackedFrames) {
    const Node* written =
        condition.Raw("duration_s") != nullptr ? condition.Raw("duration_s") : condition.Raw("rate_hz");
    condition.Complain(written->place,
                       fmt::format("{:g} s at {:g} Hz are {} frame{}; at least {} are needed", o.duration_s, o.rate_hz,
                                   frames, frames == 1 ? "" : "s", kFewestTrackedFrames));
  }
  return o;
}

IkOptions ReadFrameBudget(Fields& condition) {
  IkOptions options;
  options.max_iterations = condition.Integer("max_sweeps", 20, {1, kMostSweeps});
  ReadIkGoals(condition, options);
  return options;
}

Result<std::vector<TrackingMethod>> ReadTrackingMethods(std::span<const Node> methods, const IkOptions& common) {
  std::vector<TrackingMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node, common));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> TrackingConditionKeys() {
  return {{"duration_s", "0.1…60", "5", "Length of the window of the clip that is followed."},
          {"rate_hz", "1…30", "30", "Frames a second: the fewer, the farther from one to the next."},
          {"target_noise_cm", "0…100", "0",
           "How far targets are from the body's ends: standard deviation per axis, anew in every frame."},
          {"target_noise_deg", "0…180", "0",
           "How far their axes are turned: standard deviation of the rotation vector per axis, anew in every frame."},
          {"joint_noise_deg", "0…180 (degrees)", "(the standing pose)",
           "How far from the truth every angle is that the first frame starts with: standard deviation."},
          {"max_sweeps", "1…100000", "20", "The limit of a solver's steps per frame."},
          IkGoalsKey()};
}

std::vector<KeyInfo> TrackingMethodKeys() {
  std::vector<KeyInfo> keys = IkSolverKeys();
  keys.insert(keys.end(), {{"start", "warm, cold", "warm",
                            "A frame starts from the answer to the one before, or from where the first one started."},
                           {"tolerance_deg", "0…360", "(no bound)", "How far an angle may leave its frame's start."}});
  return keys;
}

}  // namespace etude
