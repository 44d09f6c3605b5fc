#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/inbetween/options.h"
#include "bench/tasks/inbetween/score.h"
#include "engine/motion/tree_motion.h"
#include "engine/transitions/fillers/gap_library.h"

namespace etude {

/// TaskKind::find_files of task inbetween: lists the windows of all files. As in LAFAN1's code, at least one frame of
/// the file follows the last window. A window's name is CLIP@FIRST; FIRST is its first frame at the protocol's rate.
/// Files that cannot be read or are too short are left out. Fails if no window is left, for more than kMaxPairs
/// windows, for two files of the same name, and if a judged file is also a training file.
Result<FoundFiles> FindWindows(const Node& condition, std::span<const Node> methods,
                               const std::map<std::string, std::string>& texts);

/// Returns the first frame that the name of a window states.
int FirstFrameOf(const std::string& window);

/// Reads a whole motion at the protocol's rate. Of the result, only `motion` and `roles` are set.
Result<HiddenWindow> OpenJudged(const std::string& reference, const InbetweenOptions& options,
                                const OpenOptions& opening);

/// Returns `count` frames from `first` on, placed as by LAFAN1's code: the root's mean position over them is above the
/// origin, and the root's axis `facing` points along the world's X, seen from above, in the last of the `past` frames.
std::vector<TreePose> PlacedWindow(std::span<const TreePose> poses, int first, int count, int past,
                                   const glm::dvec3& facing);

/// Statistics of the training files that have one joint tree.
struct TrainingTree {
  JointTree tree;                         ///< with the offsets of the first frame of the first file
  std::vector<glm::dvec3> sums, squares;  ///< of each joint's coordinates (m, m²) over all training windows
  double count = 0;                       ///< frames of these windows

  /// Returns the standard deviation of each joint's coordinates, metres; empty if there are no windows.
  std::vector<glm::dvec3> Deviations() const;
};

/// Reads the training files, and adds them to `library` unless that is null. Returns one entry per joint tree, in the
/// order of their first files. Fails for a file that cannot be read, and for too many frames for a library.
Result<std::vector<TrainingTree>> Train(const InbetweenOptions& options, const OpenOptions& opening,
                                        GapLibrary* library);

}  // namespace etude
