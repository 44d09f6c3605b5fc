#pragma once

#include <string>
#include <vector>

#include "bench/keys/field_table.h"
#include "bench/tasks/evaluation/match.h"
#include "bench/tasks/evaluation/spoil.h"

namespace etude {

/// A condition of task evaluation.
struct EvaluationOptions {
  std::vector<std::string> truth;  ///< files, patterns or folders with the truths
  std::string pairs;               ///< the name of a CSV file; "" = pairs are made by name
  std::string joints = "roles";    ///< one of JointSetNames()
  double noise_mm = 0;             ///< standard deviation of the noise of all controls' answers
  std::string people;              ///< a pattern for names, such as "{person}_*"; "" = each pair is a unit of its own
  Lag lag = Lag::kNone;
  std::string statistics;   ///< the name of a file that ReadJointStatistics reads; "" = L2P has no value
  std::string music_beats;  ///< the name of a file that ReadMusicBeats reads; "" = beat alignment has no value
};

const FieldTable<EvaluationOptions>& EvaluationConditionFields();

/// Fails unless the condition names its files in exactly one way. Fails also if the condition states a number of
/// trials.
Result<void> CheckFiles(const Node& condition, const EvaluationOptions& options);

/// A method of task evaluation: answers from elsewhere, or a control that tests the metrics.
struct EvaluationMethod {
  std::string name;
  std::vector<std::string> answers;  ///< files, patterns or folders; empty if the condition's `pairs` name the files
  bool is_control = false;           ///< true: the method's answer is the truth with the spoiler's faults
  Spoiler spoiler;                   ///< the faults of a control's answer
};

const FieldTable<EvaluationMethod>& EvaluationMethodFields();

/// Returns the names of the sets of joints: "roles", "same", "roles-20", "h36m-17", "lsp-14", "coco-17", "smpl-22",
/// "smpl-24".
std::vector<std::string> JointSetNames();
/// Returns the joints of a set, by its name. A joint that has a role is given as its role. The result is empty for
/// "roles" and "same", which depend on the files.
std::vector<std::string> JointsOfSet(std::string_view set);

}  // namespace etude
