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

/// TaskKind::find_files of task inbetween: the windows of all files, as LAFAN1's code takes them, so that a frame is
/// left behind the last. They are named CLIP@FIRST, FIRST a frame at the protocol's rate. A file that cannot be read or
/// is shorter is left out. Fails if no window is left, for more than kMaxPairs, for files of one name, and if a
/// judged file also trains.
Result<FoundFiles> FindWindows(const Node& condition, std::span<const Node> methods,
                               const std::map<std::string, std::string>& texts);

/// Returns the first frame that the name of a window states.
int FirstFrameOf(const std::string& window);

/// Reads a whole motion at the protocol's rate, with its roles; nothing is hidden yet.
Result<HiddenWindow> OpenJudged(const std::string& reference, const InbetweenOptions& options,
                                const OpenOptions& opening);

/// Returns `count` frames from `first` on as LAFAN1's code places them: the root's mean over them is above the origin,
/// and its `facing` axis points along X in the last of `past` frames.
std::vector<TreePose> PlacedWindow(std::span<const TreePose> poses, int first, int count, int past,
                                   const glm::dvec3& facing);

/// What is taken from the training files of one joint tree.
struct TrainingTree {
  JointTree tree;                         ///< with the offsets of the first frame of the first file
  std::vector<glm::dvec3> sums, squares;  ///< of each joint's positions in all training windows
  double count = 0;                       ///< frames of these windows

  /// Returns the standard deviation of each joint's coordinates, metres; none without windows.
  std::vector<glm::dvec3> Deviations() const;
};

/// Reads the training files, and adds them to `library` unless that is null. Trees are in the order of their first
/// files.
Result<std::vector<TrainingTree>> Train(const InbetweenOptions& options, const OpenOptions& opening,
                                        GapLibrary* library);

}  // namespace etude
