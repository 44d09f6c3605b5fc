#include "bench/tasks/ik/ik_options.h"

#include <algorithm>
#include <array>
#include <utility>

#include "bench/tasks/base/misplaced_keys.h"
#include "bench/tasks/base/solver_fields.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr int kMostSweeps = 100'000;

using RecordName = std::pair<std::string_view, bool IkRecords::*>;
constexpr std::array<RecordName, 3> kRecords = {{{"effector_errors", &IkRecords::effector_errors},
                                                 {"angle_changes", &IkRecords::angle_changes},
                                                 {"effector_curves", &IkRecords::effector_curves}}};

std::vector<std::string> RecordNames() {
  std::vector<std::string> names;
  for (const RecordName& record : kRecords) names.emplace_back(record.first);
  return names;
}

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

IkStart ReadStart(Fields& condition) {
  const std::string start = condition.Choice("start", {"disturbed", "middle", "stretched"}, "disturbed");
  RefuseMisplacedKeys(condition, IkConditionKeys(), "start", start);
  return start == "middle" ? IkStart::kMiddle : start == "stretched" ? IkStart::kStretched : IkStart::kDisturbed;
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
  if (times_noise && trial.start != IkStart::kDisturbed) {
    fields.Complain(node.place, "'tolerance_times_noise' needs noise; allowed with start: disturbed");
  }
  if (degrees) method.options.angle_change_tolerance = Radians(*degrees);
  if (times_noise) method.options.angle_change_tolerance = Radians(*times_noise * trial.joint_noise_deg);
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

IkTrialOptions ReadIkTrialOptions(Fields& condition) {
  IkTrialOptions options;
  options.limit_set = *FindLimitSet(condition.Choice("limit_set", LimitSetNames(), "adult"));
  options.start = ReadStart(condition);
  options.pose_range = ReadPoseRange(condition);
  options.joint_noise_deg = condition.Number("joint_noise_deg", options.joint_noise_deg, {0, 180});
  if (condition.Choice("noise", {"gaussian", "uniform"}, "gaussian") == "uniform") options.noise = NoiseKind::kUniform;
  options.target_noise.position_cm = condition.Number("target_noise_cm", 0, {0, 100});
  options.target_noise.orientation_deg = condition.Number("target_noise_deg", 0, {0, 180});
  options.unreachable_cm = condition.Number("unreachable_cm", 0, {0, 1000});
  const std::string asked = condition.Choice("targets", {"both", "position", "orientation"}, "both");
  options.asks_positions = asked != "orientation";
  options.asks_axes = asked != "position";
  if (options.unreachable_cm > 0 && !options.asks_positions) {
    condition.Complain(condition.Raw("unreachable_cm")->place,
                       "'unreachable_cm' needs positions; allowed with targets: both, position");
  }
  return options;
}

IkRecords ReadIkRecords(Fields& condition) {
  IkRecords records;
  const std::vector<std::string> names = condition.Texts("record");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto record = std::ranges::find(kRecords, names[i], &RecordName::first);
    if (record == kRecords.end()) {
      condition.Complain(condition.Raw("record")->items[i].place, UnknownName("record", names[i], RecordNames()));
    } else {
      records.*record->second = true;
    }
  }
  return records;
}

IkOptions ReadIkCommonOptions(Fields& condition) {
  IkOptions options;
  options.max_iterations = condition.Integer("max_sweeps", 200, {1, kMostSweeps});
  ReadIkGoals(condition, options);
  return options;
}

Result<std::vector<IkMethod>> ReadIkMethods(std::span<const Node> methods, const IkOptions& common,
                                            const IkTrialOptions& trial) {
  std::vector<IkMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node, common, trial));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> IkConditionKeys() {
  const KeyCondition with_noise{"start", {"disturbed"}}, with_poses{"start", {"disturbed", "middle"}};
  return {
      {"limit_set", Join(LimitSetNames()), "adult", "How far joints may turn: Etude's adult, or paper B's table 3.1."},
      {"poses", "{uniform: 0…1}, or 0…1 alone", "{uniform: 0.5}",
       "The true pose is drawn from this share of every joint's range, about its middle.", with_poses},
      {"start", "disturbed, middle, stretched", "disturbed",
       "Solvers begin at the disturbed truth, in the middle of every joint's range, or standing with stretched "
       "arms that the hands' targets lie along (paper B, figure 3.8)."},
      {"joint_noise_deg", "0…180 (degrees)", "15", "How far every angle of the start is from the truth.", with_noise},
      {"noise", "gaussian, uniform", "gaussian",
       "`joint_noise_deg` is the standard deviation, or the largest deviation to either side.", with_noise},
      {"target_noise_cm", "0…100", "0", "Standard deviation of every target's place, along each axis.", with_poses},
      {"target_noise_deg", "0…180", "0", "Standard deviation of every target's rotation vector.", with_poses},
      {"unreachable_cm", "0…1000", "0",
       "One target is pulled away from the root, this far beyond where all limbs together are too short.", with_poses},
      {"targets", "both, position, orientation", "both",
       "What effectors are to meet of their targets; a world is solved when they meet that."},
      {"record", "a list of: " + Join(RecordNames()), "[]",
       "Which series a cell keeps for the report: every effector's errors, every angle's change, curves of every "
       "effector."},
      {"max_sweeps", "1…100000", "200", "The limit of a solver's steps."},
      IkGoalsKey()};
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
