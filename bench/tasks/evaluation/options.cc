#include "bench/tasks/evaluation/options.h"

#include <string_view>

#include "engine/retargeting/joint_arrays.h"

namespace etude {
namespace {

/// A set of joints: the joints of the array layout `layout` (JointsOfLayout) in its variant with `joints` joints.
struct JointSetOfLayout {
  std::string_view name, layout;
  std::size_t joints;
};
constexpr JointSetOfLayout kSets[] = {{"roles-20", "etude", 20},
                                      {"h36m-17", "h36m", 17},
                                      {"coco-17", "coco", 17},
                                      {"smpl-22", "smpl", 22},
                                      {"smpl-24", "smpl", 24}};
// In Leeds Sports Pose, the joint "neck" is the base of the neck, and the joint "head" is the top of the head.
constexpr std::string_view kLsp = "lsp-14";
constexpr std::string_view kLspJoints[] = {
    "right_ankle", "right_knee",     "right_hip",     "left_hip",   "left_knee",  "left_ankle",      "right_wrist",
    "right_elbow", "right_shoulder", "left_shoulder", "left_elbow", "left_wrist", "shoulder_centre", "head"};

}  // namespace

std::vector<std::string> JointSetNames() {
  std::vector<std::string> names = {"roles", "same"};
  for (const JointSetOfLayout& set : kSets) names.emplace_back(set.name);
  names.emplace_back(kLsp);
  return names;
}

std::vector<std::string> JointsOfSet(std::string_view name) {
  if (name == kLsp) return {std::begin(kLspJoints), std::end(kLspJoints)};
  for (const JointSetOfLayout& set : kSets) {
    if (set.name == name) return JointsOfLayout(set.layout, set.joints);
  }
  return {};
}

const FieldTable<EvaluationOptions>& EvaluationConditionFields() {
  using Key = Field<EvaluationOptions>;
  // The keys of the judged files come first.
  static const FieldTable<EvaluationOptions> table{
      {Key::Texts("truth", &EvaluationOptions::truth, "a list of motion files, patterns and folders",
                  "The true motions. A truth and an answer with the same file name form a pair.")
           .WhenAbsent("(listed in `pairs`)"),
       {{"pairs", FileKind("a CSV file"), "(files with the same name form a pair)",
         "A table of pairs. It has a column `truth`, one column for each method with the method's name, and optionally "
         "a column `name`."},
        [](Fields& fields, EvaluationOptions& options) { options.pairs = fields.Text("pairs", ""); }},
       // Keys of the joints, the noise of controls, the units and the time shift.
       {{"joints", NameKind(JointSetNames()), "roles",
         "The joints that are judged. roles: joints with the same role in both files; same: joints with the same name; "
         "other values: the joints of a set that both files contain."},
        [](Fields& fields, EvaluationOptions& options) {
          options.joints = fields.Choice("joints", JointSetNames(), options.joints);
        }},
       Key::Number("noise_mm", &EvaluationOptions::noise_mm, {0, 1000},
                   "Standard deviation of white noise along each axis. The noise is added to the answer of every "
                   "control before the control's other errors."),
       Key::Text("people", &EvaluationOptions::people, "a pattern such as '{person}_*'",
                 "A pattern that marks the part of a pair's name that identifies the person. Verdicts that are meant "
                 "for other files count each person once.")
           .WhenAbsent("(each pair counts once)"),
       Key::Name("lag", &EvaluationOptions::lag, {{"none", Lag::kNone}, {"find", Lag::kFind}},
                 "none: frames at equal times are compared; times come from the files' clocks if both files have a "
                 "clock, and otherwise begin at the first frames. find: Etude estimates the time shift between truth "
                 "and answer and removes it."),
       {{"statistics", FileKind("a CSV file"), "(L2P has no value)",
         "Means and standard deviations of joint positions over a training set. The file has a heading `JOINT_x_m,…` "
         "and two rows."},
        [](Fields& fields, EvaluationOptions& options) { options.statistics = fields.Text("statistics", ""); }},
       {{"music_beats", FileKind("a text file"), "(beat alignment has no value)",
         "The times of the music's beats in seconds from the truth's first frame. Each line contains one time."},
        [](Fields& fields, EvaluationOptions& options) { options.music_beats = fields.Text("music_beats", ""); }}}};
  return table;
}

Result<void> CheckFiles(const Node& condition, const EvaluationOptions& options) {
  if (options.truth.empty() == options.pairs.empty()) {
    return Fail(condition.place, "a scenario of task evaluation needs exactly one of the keys 'truth' and 'pairs'");
  }
  const Node* trials = condition.Find("trials");
  if (trials == nullptr) return {};
  return Fail(trials->place, "'trials' is not allowed in task evaluation, because each pair is judged once");
}

namespace {

/// Adds an error for keys without effect: `answers` if the method is a control, the keys of `spoiler` if it is not.
void CheckControl(Fields& fields, EvaluationMethod& method) {
  if (method.is_control && !method.answers.empty())
    fields.Complain(fields.node().place, "a control must not have the key 'answers'");
  if (!method.is_control && method.spoiler != Spoiler{})
    fields.Complain(fields.node().place, "keys that add errors to the truth are allowed only with 'control: true'");
}

}  // namespace

const FieldTable<EvaluationMethod>& EvaluationMethodFields() {
  using Method = EvaluationMethod;
  using Key = Field<Method>;
  const auto part = [](auto member) { return Path(&Method::spoiler, member); };
  // The keys of the answers, or of a control, come first.
  static const FieldTable<Method> table{
      {Key::Texts("answers", &Method::answers, "a list of motion files, patterns and folders",
                  "The method's results. A result and its truth have the same file name.")
           .WhenAbsent("(listed in `pairs`)"),
       Key::Flag("control", &Method::is_control,
                 "true: the method is a control. Its answer is the truth with the errors that the keys below add, in "
                 "this order. If all methods are controls, contacts are computed from the motion, and Etude derives "
                 "missing rotations, beats and statistics from the truth."),
       Key::Number("noisy_mm", part(&Spoiler::noisy_mm), {0, 1000},
                   "Standard deviation of white noise. The noise is independent for each joint and axis."),
       Key::Number("smoothed_ms", part(&Spoiler::smoothed_ms), {0, 10'000},
                   "Length of the centred moving mean that smooths the answer."),
       Key::Number("faded_percent", part(&Spoiler::faded_percent), {0, 100},
                   "Each joint's distance from the joint's mean position is reduced by this percentage."),
       Key::Number("scaled_percent", part(&Spoiler::scaled_percent), {-90, 1000},
                   "Increase of the size of the motion, with the world's origin as the centre."),
       Key::Number("moved_cm", part(&Spoiler::moved_cm), {-1e5, 1e5}, "Shift along X."),
       Key::Number("lifted_cm", part(&Spoiler::lifted_cm), {-1e5, 1e5}, "Shift upwards."),
       Key::Number("gliding_cm_s", part(&Spoiler::gliding_cm_s), {-1000, 1000}, "Speed of a continuous shift along X."),
       Key::Number("feet_locked_cm", part(&Spoiler::feet_locked_cm), {0, 100},
                   "A foot does not move while its toes are lower than this height."),
       Key::Number("mirrored_share", part(&Spoiler::mirrored_share), {0, 1},
                   "Share of the take in which left and right are exchanged. This part is at the end of the take."),
       Key::Number("kept_frames", part(&Spoiler::kept_frames), {1, 1000},
                   "Every n-th frame is kept. The other frames are interpolated linearly."),
       Key::Number("late_ms", part(&Spoiler::late_ms), {0, 60'000},
                   "Delay of the answer. Before the answer begins, the body stands in its first pose."),
       Key::Number("frozen_share", part(&Spoiler::frozen_share), {0, 1},
                   "Share of the take in which the body stands still. This part is at the end of the take."),
       Key::Number("hidden_percent", part(&Spoiler::hidden_percent), {0, 100},
                   "Percentage of all joint positions that are hidden. The positions with the largest errors are "
                   "hidden first.")},
      CheckControl};
  return table;
}

}  // namespace etude
