#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/kinematics/body_tree.h"
#include "io/drawing/table.h"

namespace etude {

/// A group of neighbouring columns under one common heading.
struct PaperColumns {
  std::string head;  ///< heading with the unit: "position error (cm)"
  std::vector<std::string> names;
};

/// One row of a table, with a number per column. A number is nullopt if its value is missing or cannot exist.
struct PaperRow {
  std::string label;
  std::vector<std::optional<double>> values;
};

/// A table in the layout of one of paper B's tables. Numbers are shown with six decimals.
struct PaperTable {
  std::string caption;
  std::vector<PaperColumns> columns;
  std::vector<PaperRow> rows;
};

/// Returns the letter of the table with this index: "(a)", "(b)", …, "(z)", then "(27)", …
std::string PaperLetter(std::size_t index);

/// Converts the table for the HTML, Markdown and LaTeX writers: a caption, two rows of headings, and cells that hold a
/// value and its text of six decimals.
Table TableOf(const PaperTable& table);

/// An end effector that has a row in paper B's tables of errors, in the paper's order.
struct PaperBEffector {
  const char* label;        ///< the paper's label: "R_hand"
  const char* name;         ///< the effector's name in the tree
  const char* description;  ///< the effector's description in figure 5.2
};
inline constexpr std::array<PaperBEffector, 4> kPaperBEffectors{{{"foot", "right_foot", "right foot"},
                                                                 {"R_hand", "right_hand", "right hand"},
                                                                 {"L_hand", "left_hand", "left hand"},
                                                                 {"head", "head", "head"}}};

struct PaperBJoint {
  const char* label;
  BodyTreeJoint joint;
};
inline constexpr std::array<PaperBJoint, 14> kPaperBJoints{{{"R_shoulder", kTreeRightShoulder},
                                                            {"R_elbow", kTreeRightElbow},
                                                            {"R_wrist", kTreeRightWrist},
                                                            {"L_shoulder", kTreeLeftShoulder},
                                                            {"L_elbow", kTreeLeftElbow},
                                                            {"L_wrist", kTreeLeftWrist},
                                                            {"Neck", kTreeNeck},
                                                            {"Navel", kTreeNavel},
                                                            {"R_ankle", kTreeRightAnkle},
                                                            {"R_knee", kTreeRightKnee},
                                                            {"R_hipbone", kTreeRightHip},
                                                            {"L_hipbone", kTreeLeftHip},
                                                            {"L_knee", kTreeLeftKnee},
                                                            {"L_ankle", kTreeLeftAnkle}}};

/// Returns tables 5.1 (a)–(c) and 5.2 (b), (d), (e) as the paper prints these tables for its single pose. The paper's
/// tables 5.2 (a) and (c) repeat 5.1 (a) and (c).
std::vector<PaperTable> PaperBPrintedErrors();
std::vector<PaperTable> PaperBPrintedAngles();

/// Tables 5.1 and 5.2 of paper B, filled from a run: for one trial, or over all trials.
struct PaperBSet {
  std::string title;               ///< the trials of the tables: "trial 0", "all 200 trials"
  std::string error_note;          ///< a sentence that explains the numbers in `errors`
  std::string angle_note;          ///< a sentence that explains the numbers in `angles`; "" if there are no angles
  std::string replay;              ///< the command that repeats the trial; "" for all trials
  std::vector<PaperTable> errors;  ///< table "(a) before", then one table per method; a row per effector
  std::vector<PaperTable> angles;  ///< one table per method: each joint's hidden angles, which no target determines
  /// One line per method: the status in which the method ended, and the number of its iterations.
  std::vector<std::string> outcomes;
};

struct PaperBCondition {
  std::vector<SweptValue> condition;
  /// Tables of the first trial; then, if there are several trials, tables over all trials together.
  std::vector<PaperBSet> sets;
};

/// Returns true if a cell of this scenario recorded the errors of its end effectors: the task is `ik`, with `record:
/// [effector_errors]`.
bool HasPaperBTables(const RunData& run, const ScenarioSummary& scenario);

/// Returns the filled tables, one entry per condition whose cells recorded the errors of end effectors; empty if no
/// cell did. A method whose cells recorded no errors has no table; its line in `outcomes` says why. In tables of one
/// trial, position errors are signed; in tables over all trials, they are medians of absolute values.
std::vector<PaperBCondition> PaperBTables(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
