#include "bench/tasks/tracking/options.h"

#include <cmath>

namespace etude {
namespace {

void CheckFrames(Fields& condition, TrackingOptions& options) {
  const auto frames = std::lround(options.duration_s * options.rate_hz);
  if (frames >= kMinTrackedFrames) return;
  const Node* written = condition.Raw("duration_s") != nullptr ? condition.Raw("duration_s") : condition.Raw("rate_hz");
  condition.Complain(written->place,
                     fmt::format("{:g} s at {:g} Hz are {} frame{}; at least {} are needed", options.duration_s,
                                 options.rate_hz, frames, frames == 1 ? "" : "s", kMinTrackedFrames));
}

}  // namespace

const FieldTable<TrackingOptions>& TrackingConditionFields() {
  using Options = TrackingOptions;
  using Key = Field<Options>;
  static const FieldTable<Options> table{
      {Key::Number("duration_s", &Options::duration_s, {0.1, 60}, "Length of the window of the clip that is followed."),
       Key::Number("rate_hz", &Options::rate_hz, {1, kJudgedRateHz},
                   "Frames a second: the fewer, the farther from one to the next."),
       Key::Number("target_noise_cm", Path(&Options::target_noise, &TargetNoise::position_cm), {0, 100},
                   "How far targets are from the body's ends: standard deviation per axis, anew in every frame."),
       Key::Number(
           "target_noise_deg", Path(&Options::target_noise, &TargetNoise::orientation_deg), {0, 180},
           "How far their axes are turned: standard deviation of the rotation vector per axis, anew in every frame."),
       Key::Number("joint_noise_deg", &Options::joint_noise_deg, {0, 180},
                   "How far from the truth every angle is that the first frame starts with: standard deviation.")
           .Unit("degrees")
           .WhenAbsent("(the standing pose)"),
       SweepsField(&Options::common, "The limit of a solver's steps per frame."), GoalsField(&Options::common)},
      CheckFrames};
  return table;
}

const FieldTable<TrackingMethod>& TrackingMethodFields() {
  static const FieldTable<TrackingMethod> table = [] {
    FieldTable<TrackingMethod> made{IkSolverFields(&TrackingMethod::solver, &TrackingMethod::options)};
    made.fields.push_back(Field<TrackingMethod>::Name(
        "start", &TrackingMethod::start, {{"warm", FrameStart::kWarm}, {"cold", FrameStart::kCold}},
        "A frame starts from the answer to the one before, or from where the first one started."));
    made.fields.push_back(ToleranceField(&TrackingMethod::options, "How far an angle may leave its frame's start."));
    return made;
  }();
  return table;
}

}  // namespace etude
