#pragma once

#include <array>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree.h"
#include "reports/paper/paper_table.h"

namespace etude {

/// What paper B's tables are made of: its rows, in its order and under its names.
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

/// The heads of an effector's six columns, and of a joint's three.
std::vector<PaperColumns> PaperBErrorColumns();
std::vector<PaperColumns> PaperBAngleColumns();

/// Tables 5.1 (a)–(c) and 5.2 (b), (d), (e) as the paper prints them, of its one pose. 5.2 (a) and (c) repeat 5.1 (a)
/// and (c).
std::vector<PaperTable> PaperBPrintedErrors();
std::vector<PaperTable> PaperBPrintedAngles();

}  // namespace etude
