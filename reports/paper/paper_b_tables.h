#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree.h"
#include "io/drawing/table.h"

namespace etude {

/// Neighbouring columns under one head.
struct PaperColumns {
  std::string head;  ///< with the unit: "position error (cm)"
  std::vector<std::string> names;
};

/// One row of figures, as many as the table has columns. Nothing where a value cannot exist or is missing.
struct PaperRow {
  std::string label;
  std::vector<std::optional<double>> values;
};

/// A table of figures in the layout of a printed one: six decimals, values of one row beside each other.
struct PaperTable {
  std::string caption;
  std::vector<PaperColumns> columns;
  std::vector<PaperRow> rows;
};

/// Gives "(a)", "(b)", …, "(z)", "(27)", …
std::string PaperLetter(std::size_t index);

/// Gives the table as what all writers take: the caption, two rows of heads, values beside their six decimals.
Table TableOf(const PaperTable& table);

/// A row of paper B's tables of errors, in its order and under its name.
struct PaperBEffector {
  const char* label;        ///< "R_hand"
  const char* name;         ///< of the tree's effector
  const char* description;  ///< in figure 5.2
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

/// Gives tables 5.1 (a)–(c) and 5.2 (b), (d), (e) as the paper prints them, of its one pose. 5.2 (a) and (c) repeat 5.1
/// (a) and (c).
std::vector<PaperTable> PaperBPrintedErrors();
std::vector<PaperTable> PaperBPrintedAngles();

/// Tables 5.1 and 5.2 of paper B, filled from a run: of one trial, or summed up over all.
struct PaperBSet {
  std::string title;                  ///< "trial 0", "all 200 trials"
  std::string error_note;             ///< what the figures of `errors` are, in words
  std::string angle_note;             ///< what those of `angles` are; "" without any
  std::string replay;                 ///< the command that repeats the trial; "" for all trials
  std::vector<PaperTable> errors;     ///< "(a) before", then one per method: of each effector
  std::vector<PaperTable> angles;     ///< one per method: the hidden angles of each joint
  std::vector<std::string> outcomes;  ///< one line per method: how it ended, after how many iterations
};

struct PaperBCondition {
  std::vector<SweptValue> condition;
  std::vector<PaperBSet> sets;  ///< the first trial; then, when there are several, all
};

/// Is true when any cell of this scenario keeps the errors that the tables are made of: its task is `ik`, and it asks
/// to `record: [effector_errors]`.
bool HasPaperBTables(const RunData& run, const ScenarioSummary& scenario);

/// Fills the tables, one entry per condition whose cells keep effectors' errors; empty for other scenarios. A method
/// without such figures has no table, and its line in `outcomes` says why. Position errors have signs; over all trials
/// they are medians of absolute values.
std::vector<PaperBCondition> PaperBTables(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
