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

/// Lists the windows of all files of task inbetween (TaskKind::find_files). As in LAFAN1's code, at least one frame of
/// the file follows the last window. A window's name is CLIP@FIRST, where FIRST is its first frame at the protocol's
/// rate. Files that cannot be read or are too short are left out. Fails if no window is left, if there are more than
/// kMaxPairs windows, if two files have the same name, or if a judged file is also a training file.
Result<FoundFiles> FindWindows(const Node& condition, std::span<const Node> methods,
                               const std::map<std::string, std::string>& texts);

/// Returns the index of a window's first frame, as stated in the window's name `window`.
int FirstFrameOf(const std::string& window);

/// Reads a whole motion at the protocol's rate. Only `motion` and `roles` of the result are set.
Result<HiddenWindow> OpenJudged(const std::string& reference, const InbetweenOptions& options,
                                const OpenOptions& opening);

/// Returns `count` frames from `first` on, moved and turned as in LAFAN1's code: the root's mean position over these
/// frames is above the origin. Seen from above, the root's axis `facing` points along the world's X in the last of the
/// `past` frames.
std::vector<TreePose> PlacedWindow(std::span<const TreePose> poses, int first, int count, int past,
                                   const glm::dvec3& facing);

/// Statistics of all training files that have the same joint tree.
struct TrainingTree {
  JointTree tree;                         ///< the tree, with the offsets of the first frame of the first file
  std::vector<glm::dvec3> sums, squares;  ///< sums of each joint's coordinates (m) and their squares (m²)
  double count = 0;                       ///< number of frames of all training windows

  /// Returns the standard deviation of each joint's coordinates, metres; empty if there are no windows.
  std::vector<glm::dvec3> Deviations() const;
};

/// Reads the training files. Adds them to `library` unless it is null. Returns one entry per joint tree, in the order
/// of the trees' first files. Fails if a file cannot be read, or if there are too many frames for a library.
Result<std::vector<TrainingTree>> Train(const InbetweenOptions& options, const OpenOptions& opening,
                                        GapLibrary* library);

}  // namespace etude
