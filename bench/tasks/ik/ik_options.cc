#include "bench/tasks/ik/ik_options.h"

#include "bench/tasks/base/solver_fields.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr int kMostSweeps = 100'000;

// "poses: {uniform: 0.5}", or "poses: 0.5" for short, which a sweep can write.
double ReadPoseRange(Fields& condition) {
  constexpr double kDefault = 0.5;
  constexpr Range kShare{0, 1};
  const Node* poses = condition.Raw("poses");
  if (poses == nullptr) return kDefault;
  if (poses->kind == Node::Kind::kScalar) return condition.Number("poses", kDefault, kShare);
  Fields fields(*poses, "'poses'");
  const double share = fields.Number("uniform", kDefault, kShare);
  if (auto done = fields.Finish(); !done) condition.Complain(done.error().place, done.error().message);
  return share;
}

Result<IkMethod> ReadMethod(const Node& node, const IkOptions& common, const IkTrialOptions& trial) {
  Fields fields(node, "a method of task ik");
  IkMethod method;
  method.options = common;
  method.name = fields.RequiredText("name");
  method.solver = ReadIkSolver(fields, method.options);
  method.options.limits = fields.Boolean("limits", true);
  const std::optional<double> degrees = fields.OptionalNumber("tolerance_deg", {0, 360});
  const std::optional<double> times_noise = fields.OptionalNumber("tolerance_times_noise", {0, 100});
  if (degrees && times_noise) {
    fields.Complain(node.place, "a method has either 'tolerance_deg' or 'tolerance_times_noise'");
  }
  if (degrees) method.options.angle_change_tolerance = Radians(*degrees);
  if (times_noise) method.options.angle_change_tolerance = Radians(*times_noise * trial.joint_noise_deg);
  if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
  return method;
}

}  // namespace

IkTrialOptions ReadIkTrialOptions(Fields& condition) {
  IkTrialOptions options;
  options.pose_range = ReadPoseRange(condition);
  options.joint_noise_deg = condition.Number("joint_noise_deg", options.joint_noise_deg, {0, 180});
  if (condition.Choice("noise", {"gaussian", "uniform"}, "gaussian") == "uniform") options.noise = NoiseKind::kUniform;
  return options;
}

IkOptions ReadIkCommonOptions(Fields& condition) {
  IkOptions options;
  options.max_iterations = condition.Integer("max_sweeps", 200, {1, kMostSweeps});
  options.trace = true;
  if (condition.Choice("stop_at", {"practical", "tight"}, "practical") == "tight") {
    options.position_goal = 1e-5;
    options.axis_goal = Radians(1e-3);
  }
  return options;
}

Result<std::vector<IkMethod>> ReadIkMethods(std::span<const Node> methods, const IkOptions& common,
                                            const IkTrialOptions& trial) {
  std::vector<IkMethod> read;
  for (const Node& node : methods) {
    auto method = ReadMethod(node, common, trial);
    if (!method) return tl::unexpected(method.error());
    read.push_back(*std::move(method));
  }
  return read;
}

std::vector<KeyInfo> IkConditionKeys() {
  return {{"poses", "{uniform: 0…1}, or 0…1 alone", "{uniform: 0.5}",
           "The true pose is drawn from this share of every joint's range, about its middle."},
          {"joint_noise_deg", "0…180 (degrees)", "15", "How far every angle of the start is from the truth."},
          {"noise", "gaussian, uniform", "gaussian",
           "`joint_noise_deg` is the standard deviation, or the largest deviation to either side."},
          {"max_sweeps", "1…100000", "200", "The limit of a solver's steps."},
          {"stop_at", "practical, tight", "practical",
           "Solvers stop when every effector is within 0.1 cm and 0.1°, or within 10⁻³ cm and 10⁻³°."}};
}

std::vector<KeyInfo> IkMethodKeys() {
  std::vector<KeyInfo> keys = IkSolverKeys();
  keys.insert(keys.end(), {{"limits", "true, false", "true", "Whether joint limits are kept."},
                           {"tolerance_deg", "0…360", "(no bound)", "How far an angle may leave its start."},
                           {"tolerance_times_noise", "0…100", "(no bound)",
                            "The same in multiples of joint_noise_deg; paper B's reading: 1.2."}});
  return keys;
}

}  // namespace etude
