#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "io/clips/clip_library.h"

namespace etude {

inline LibraryClip BuiltinClipOf(const std::string& name) {
  const auto clips = LoadClips({name}, {});
  EXPECT_TRUE(clips) << ToString(clips.error());
  return clips->clips.front();
}

/// Returns states of a standing body whose arms and trunk swing, with all angles well within their limits.
inline std::vector<TreeState> SwingingStates(const KinematicTree& tree, int frames) {
  std::vector<TreeState> states(static_cast<std::size_t>(frames), StandingState(tree));
  for (int k = 0; k < frames; ++k) {
    TreeState& state = states[static_cast<std::size_t>(k)];
    state.root_frame = tree.standing_root;
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      const double middle = 0.5 * (tree.limits[i].lower + tree.limits[i].upper);
      const double half = 0.5 * (tree.limits[i].upper - tree.limits[i].lower);
      state.angles[i] = middle + 0.4 * half * std::sin(0.1 * k + static_cast<double>(i));
    }
  }
  return states;
}

inline LibraryClip ClipOf(const KinematicTree& tree, const std::vector<TreeState>& states) {
  LibraryClip clip{.name = "swing", .source = "", .motion = {}, .move = {}};
  for (const TreeState& state : states) clip.motion.poses.push_back(ToBodyPose(tree, state));
  return clip;
}

}  // namespace etude
