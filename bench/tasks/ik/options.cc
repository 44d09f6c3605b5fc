#include "bench/tasks/ik/options.h"

#include "bench/tasks/base/read_methods.h"

namespace etude {
namespace {

constexpr Range kShare{0, 1};

// The value is written as "poses: {uniform: 0.5}" or, for short, "poses: 0.5", which can be swept.
KeyInfo PosesKey() {
  const ValueKind share = NumberKind(kShare);
  const ValueKind mapping = MappingKind(
      "", std::vector<KeyInfo>{
              {"uniform", share, "0.5",
               "True angles are drawn from this share of each joint's range, around the middle of the range."}});
  return {"poses",
          {"{uniform: 0…1}, or 0…1 alone", fmt::format(R"({{"anyOf":[{},{}]}})", share.schema, mapping.schema)},
          "{uniform: 0.5}",
          "True angles are drawn from this share of each joint's range, around the middle of the range.",
          {"start", {"disturbed", "middle"}}};
}

void ReadPoses(Fields& condition, IkCondition& options) {
  double& share = options.trial.pose_range;
  const Node* poses = condition.Raw("poses");
  if (poses == nullptr || poses->kind == Node::Kind::kScalar) {
    share = condition.Number("poses", share, kShare);
    return;
  }
  Fields fields(*poses, "'poses'");
  share = fields.Number("uniform", share, kShare);
  if (auto done = fields.Finish(); !done) condition.Complain(done.error().place, done.error().message);
}

void ReadTargets(Fields& condition, IkCondition& options) {
  const std::string asked = condition.Choice("targets", {"both", "position", "orientation"}, "both");
  options.trial.asks_positions = asked != "orientation";
  options.trial.asks_axes = asked != "position";
}

void CheckCondition(Fields& condition, IkCondition& options) {
  if (options.trial.unreachable_cm == 0 || options.trial.asks_positions) return;
  condition.Complain(condition.Raw("unreachable_cm")->place,
                     "'unreachable_cm' is allowed only with 'targets: both' or 'targets: position'");
}

void CheckMethod(Fields& method, IkMethod& options) {
  if (!options.options.angle_change_tolerance || !options.tolerance_times_noise) return;
  method.Complain(method.node().place, "'tolerance_deg' and 'tolerance_times_noise' are not allowed together");
}

}  // namespace

const FieldTable<IkCondition>& IkConditionFields() {
  using Key = Field<IkCondition>;
  static const FieldTable<IkCondition> table{
      // Keys of the true pose, the start pose and the targets.
      {Key::Name("limit_set", Path(&IkCondition::trial, &IkTrialOptions::limit_set), LimitSetNames(), FindLimitSet,
                 "The set of joint limits: the limits of Etude's adult body, or the limits of one source in table 3.1 "
                 "of paper B."),
       Key{PosesKey(), ReadPoses},
       Key::Name("start", Path(&IkCondition::trial, &IkTrialOptions::start),
                 {{"disturbed", IkStart::kDisturbed}, {"middle", IkStart::kMiddle}, {"stretched", IkStart::kStretched}},
                 "The pose from which solvers start. disturbed: the true pose with random errors; middle: the middle "
                 "of every joint's range; stretched: standing, with the arms stretched along the line to the hands' "
                 "targets (paper B, figure 3.8)."),
       Key::Number("joint_noise_deg", Path(&IkCondition::trial, &IkTrialOptions::joint_noise_deg), {0, 180},
                   "Size of the random error of each start angle.")
           .Unit("degrees")
           .With("start", {"disturbed"}),
       Key::Name("noise", Path(&IkCondition::trial, &IkTrialOptions::noise),
                 {{"gaussian", NoiseKind::kGaussian}, {"uniform", NoiseKind::kUniform}},
                 "gaussian: `joint_noise_deg` is the standard deviation of the error; uniform: it is the largest error "
                 "in both directions.")
           .With("start", {"disturbed"}),
       Key::Number("target_noise_cm",
                   Path(&IkCondition::trial, &IkTrialOptions::target_noise, &TargetNoise::position_cm), {0, 100},
                   "Standard deviation of the error of every target's position, along each axis.")
           .With("start", {"disturbed", "middle"}),
       Key::Number("target_noise_deg",
                   Path(&IkCondition::trial, &IkTrialOptions::target_noise, &TargetNoise::orientation_deg), {0, 180},
                   "Standard deviation of the error of every target's rotation vector, along each axis.")
           .With("start", {"disturbed", "middle"}),
       Key::Number(
           "unreachable_cm", Path(&IkCondition::trial, &IkTrialOptions::unreachable_cm), {0, 1000},
           "One target is moved away from the root until it is this far beyond the reach of all limbs together.")
           .With("start", {"disturbed", "middle"}),
       Key{{"targets", NameKind(std::vector<std::string>{"both", "position", "orientation"}), "both",
            "What every effector must reach before a world counts as solved: the target's position, the target's "
            "orientation, or both."},
           ReadTargets},
       // Keys of the data that a cell keeps, and of the goals at which solvers stop.
       Key::Flags("record",
                  {{"effector_errors", Path(&IkCondition::records, &IkRecords::effector_errors)},
                   {"angle_changes", Path(&IkCondition::records, &IkRecords::angle_changes)},
                   {"effector_curves", Path(&IkCondition::records, &IkRecords::effector_curves)}},
                  "Series that a cell keeps for the report: the errors of each effector, the change of each angle, the "
                  "curves of each effector."),
       SweepsField(&IkCondition::common, "Maximum number of solver steps."), GoalsField(&IkCondition::common)},
      CheckCondition};
  return table;
}

const FieldTable<IkMethod>& IkMethodFields() {
  using Key = Field<IkMethod>;
  static const FieldTable<IkMethod> table = [] {
    FieldTable<IkMethod> made{IkSolverFields(&IkMethod::solver, &IkMethod::options), CheckMethod};
    std::vector<Key> own = {
        Key::Flag("limits", Path(&IkMethod::options, &IkOptions::limits), "true: the solver keeps the joint limits."),
        ToleranceField(&IkMethod::options, "Largest allowed difference between a solved angle and its start angle."),
        Key::Number("tolerance_times_noise", &IkMethod::tolerance_times_noise, {0, 100},
                    "The same limit as `tolerance_deg`, given as a multiple of `joint_noise_deg`. The value of paper B "
                    "is about 1.2.")
            .WhenAbsent("(no bound)")};
    Append(std::move(own), made.fields);
    return made;
  }();
  return table;
}

Result<std::vector<IkMethod>> ReadIkMethods(TaskInput& input, const IkCondition& condition) {
  IkMethod start;
  start.options = condition.common;
  return ReadMethods<IkMethod>(input, "ik", IkMethodFields(), start, [&](Fields& fields, IkMethod& method) {
    if (!method.tolerance_times_noise) return;
    if (condition.trial.start != IkStart::kDisturbed) {
      fields.Complain(fields.node().place, "'tolerance_times_noise' is allowed only with 'start: disturbed'");
    }
    method.options.angle_change_tolerance = Radians(*method.tolerance_times_noise * condition.trial.joint_noise_deg);
  });
}

}  // namespace etude
