#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/transition_join.h"
#include "bench/model/row.h"
#include "engine/motion/body.h"
#include "engine/motion/tree_motion.h"

namespace etude {

/// Measurements of a whole file, used to judge each window of the file. Bodies are scaled so that their hips stand at
/// 0.90 m.
struct JudgedFile {
  double floor_m = 0;  ///< the 5th percentile, over the frames, of the lowest joint's height (hands do not count)
  double scale = 1;    ///< factor from the size of the file's body to that of the judged body
  std::vector<double> natural_jumps_cm;
  double own_slide_cmps = 0;
  RealFrames frames;
};

/// A window of a motion in which some frames are hidden.
struct HiddenWindow {
  TreeMotion motion;
  int first = 0, last = 0;  ///< the hidden frames, both inclusive; three or more frames are on either side
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();  ///< the joint of each role; −1: none
  /// The divisors of L2P: the standard deviations of each joint's position in training, metres. Empty if they are
  /// unknown.
  std::vector<glm::dvec3> deviations;
  /// The measurements of the whole file. The windows of the file share them, because the file's motion may be freed
  /// before the windows.
  std::shared_ptr<const JudgedFile> file;
};

/// Returns the ids of all metrics of the task, in the order in which they are measured.
std::vector<std::string> InbetweenMetrics();

/// Measures a whole file. Only `motion` and `roles` of `whole` must be set.
std::shared_ptr<const JudgedFile> JudgeFile(const HiddenWindow& whole);

/// Measures a window after its hidden frames are replaced by `filled`, which has one pose per hidden frame. With
/// `keeps_motion`, the result's recording contains this window and the true window.
CellResult ScoreFilling(const HiddenWindow& hidden, std::span<const TreePose> filled, bool keeps_motion);

}  // namespace etude
