#include "bench/tasks/tracking/options.h"

#include <cmath>

namespace etude {
namespace {

void CheckFrames(Fields& condition, TrackingOptions& options) {
  const auto frames = std::lround(options.duration_s * options.rate_hz);
  if (frames >= kMinTrackedFrames) return;
  const Node* written = condition.Raw("duration_s") != nullptr ? condition.Raw("duration_s") : condition.Raw("rate_hz");
  condition.Complain(written->place,
                     fmt::format("{:g} s at {:g} Hz are {} frame{}; needed: at least {} frames", options.duration_s,
                                 options.rate_hz, frames, frames == 1 ? "" : "s", kMinTrackedFrames));
}

}  // namespace

const FieldTable<TrackingOptions>& TrackingConditionFields() {
  using Options = TrackingOptions;
  using Key = Field<Options>;
  static const FieldTable<Options> table{
      {Key::Number("duration_s", &Options::duration_s, {0.1, 60},
                   "Length of the part of the clip that the solver follows."),
       Key::Number("rate_hz", &Options::rate_hz, {1, kJudgedRateHz},
                   "Frames per second. With fewer frames, successive poses differ more."),
       Key::Number("target_noise_cm", Path(&Options::target_noise, &TargetNoise::position_cm), {0, 100},
                   "Standard deviation of the error of every target's position, along each axis. Errors are drawn anew "
                   "in every frame."),
       Key::Number("target_noise_deg", Path(&Options::target_noise, &TargetNoise::orientation_deg), {0, 180},
                   "Standard deviation of the error of every target's rotation vector, along each axis. Errors are "
                   "drawn anew in every frame."),
       Key::Number("joint_noise_deg", &Options::joint_noise_deg, {0, 180},
                   "Standard deviation of the difference between the start angles of the first frame and the true "
                   "angles.")
           .Unit("degrees")
           .WhenAbsent("(the standing pose)"),
       SweepsField(&Options::common, "Maximum number of solver steps per frame."), GoalsField(&Options::common)},
      CheckFrames};
  return table;
}

const FieldTable<TrackingMethod>& TrackingMethodFields() {
  static const FieldTable<TrackingMethod> table = [] {
    FieldTable<TrackingMethod> made{IkSolverFields(&TrackingMethod::solver, &TrackingMethod::options)};
    made.fields.push_back(Field<TrackingMethod>::Name(
        "start", &TrackingMethod::start, {{"warm", FrameStart::kWarm}, {"cold", FrameStart::kCold}},
        "The pose from which the solver starts in each frame. warm: the solution of the previous frame; cold: the "
        "start pose of the first frame."));
    made.fields.push_back(
        ToleranceField(&TrackingMethod::options,
                       "Largest allowed difference between a solved angle and its start angle, in each frame."));
    return made;
  }();
  return table;
}

}  // namespace etude
