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

/// Adds an error for keys without effect: `answers` if the method is a control, the keys of `spoiler` if it is not.
void CheckControl(Fields& fields, EvaluationMethod& method) {
  if (method.is_control && !method.answers.empty()) fields.Complain(fields.node().place, "a control has no 'answers'");
  if (!method.is_control && method.spoiler != Spoiler{})
    fields.Complain(fields.node().place, "keys that add errors to the truth need 'control: true'");
}

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
      {Key::Texts("truth", &EvaluationOptions::truth, "a list of motion files, patterns, folders",
                  "The truths; a truth and the answers of the same name are a pair.")
           .WhenAbsent("(`pairs` names them)"),
       {{"pairs", FileKind("a CSV file"), "(files of one name are a pair)",
         "A table of pairs: a column `truth`, a column named after each method and, optionally, a column `name`."},
        [](Fields& fields, EvaluationOptions& options) { options.pairs = fields.Text("pairs", ""); }},
       // Keys of the joints, the noise of controls, the units and the time shift.
       {{"joints", NameKind(JointSetNames()), "roles",
         "Which joints are judged: those with the same role, those with the same name, or those of a set that both "
         "files have."},
        [](Fields& fields, EvaluationOptions& options) {
          options.joints = fields.Choice("joints", JointSetNames(), options.joints);
        }},
       Key::Number("noise_mm", &EvaluationOptions::noise_mm, {0, 1000},
                   "Standard deviation of white noise, along each axis, that is added to every control's answer before "
                   "its other errors."),
       Key::Text("people", &EvaluationOptions::people, "a pattern such as '{person}_*'",
                 "Which part of a pair's name is the person; verdicts that hold for other files, too, count each "
                 "person once.")
           .WhenAbsent("(each pair counts for itself)"),
       Key::Name("lag", &EvaluationOptions::lag, {{"none", Lag::kNone}, {"find", Lag::kFind}},
                 "none: frames of equal times are compared, by the files' clocks if both state one, otherwise counted "
                 "from the first frames; find: the time shift between truth and answer is found and removed."),
       {{"statistics", FileKind("a CSV file"), "(L2P has no value)",
         "Means and standard deviations of joints over a training set: a heading `JOINT_x_m,…` and two rows."},
        [](Fields& fields, EvaluationOptions& options) { options.statistics = fields.Text("statistics", ""); }},
       {{"music_beats", FileKind("a text file"), "(beat alignment has no value)",
         "The times of the music's beats, one per line, in seconds from the truth's first frame."},
        [](Fields& fields, EvaluationOptions& options) { options.music_beats = fields.Text("music_beats", ""); }}}};
  return table;
}

Result<void> CheckFiles(const Node& condition, const EvaluationOptions& options) {
  if (options.truth.empty() == options.pairs.empty()) {
    return Fail(condition.place, "task evaluation needs either 'truth' or 'pairs', not both");
  }
  const Node* trials = condition.Find("trials");
  if (trials == nullptr) return {};
  return Fail(trials->place, "'trials' has no use in task evaluation: each pair is judged once");
}

const FieldTable<EvaluationMethod>& EvaluationMethodFields() {
  using Method = EvaluationMethod;
  using Key = Field<Method>;
  const auto part = [](auto member) { return Path(&Method::spoiler, member); };
  // The keys of the answers, or of a control, come first.
  static const FieldTable<Method> table{
      {Key::Texts("answers", &Method::answers, "a list of motion files, patterns, folders",
                  "The answers; they have the same names as their truths.")
           .WhenAbsent("(`pairs` names them)"),
       Key::Flag("control", &Method::is_control,
                 "The answer is the truth with the errors that the other keys add, in this order. If all methods are "
                 "controls, contacts are found from the motion, and the truth gives rotations, beats and statistics "
                 "that files lack."),
       Key::Number("noisy_mm", part(&Spoiler::noisy_mm), {0, 1000},
                   "Standard deviation of white noise, independent for each joint and axis."),
       Key::Number("smoothed_ms", part(&Spoiler::smoothed_ms), {0, 10'000},
                   "Length of the centred moving mean that smooths the answer."),
       Key::Number("faded_percent", part(&Spoiler::faded_percent), {0, 100},
                   "Each joint's distance from its mean position is reduced by this share."),
       Key::Number("scaled_percent", part(&Spoiler::scaled_percent), {-90, 1000},
                   "Increase of the size, about the world's origin."),
       Key::Number("moved_cm", part(&Spoiler::moved_cm), {-1e5, 1e5}, "Shift along X."),
       Key::Number("lifted_cm", part(&Spoiler::lifted_cm), {-1e5, 1e5}, "Shift upwards."),
       Key::Number("gliding_cm_s", part(&Spoiler::gliding_cm_s), {-1000, 1000}, "Speed of a shift along X."),
       Key::Number("feet_locked_cm", part(&Spoiler::feet_locked_cm), {0, 100},
                   "While its toes are lower than this, a foot does not move."),
       Key::Number("mirrored_share", part(&Spoiler::mirrored_share), {0, 1},
                   "Share of the take, at its end, in which left and right are exchanged."),
       Key::Number("kept_frames", part(&Spoiler::kept_frames), {1, 1000},
                   "Keeps every n-th frame; the others are interpolated linearly."),
       Key::Number("late_ms", part(&Spoiler::late_ms), {0, 60'000},
                   "Delay of the answer; until it begins, it stands in its first pose."),
       Key::Number("frozen_share", part(&Spoiler::frozen_share), {0, 1},
                   "Share of the take, at its end, that stands still."),
       Key::Number("hidden_percent", part(&Spoiler::hidden_percent), {0, 100},
                   "Share of all joint positions that is hidden; those with the largest errors are hidden first.")},
      CheckControl};
  return table;
}

}  // namespace etude
