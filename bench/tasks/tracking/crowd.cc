#include "bench/tasks/tracking/crowd.h"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "engine/kinematics/body_tree.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "sim/choreography/move.h"

namespace etude {

Result<std::vector<TrackingWorld>> MakeCrowd(const CrowdOptions& options) {
  std::vector<std::string> references;
  for (const std::string& name : BuiltinMoveNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  for (const std::string& name : BuiltinActNames()) references.push_back(std::string(kBuiltinPrefix) + name);
  ASSIGN_OR_RETURN(const ClipLibrary library, LoadClips(references, {}));
  const KinematicTree body = MakeBodyTree({});
  const TrackingOptions tracking{.duration_s = options.frames / options.rate_hz, .rate_hz = options.rate_hz};
  constexpr int kTries = 4;  // tries per character, because some clips are too short for a window
  std::vector<TrackingWorld> crowd;
  for (int trial = 0; std::ssize(crowd) < options.characters && trial < kTries * options.characters; ++trial) {
    const LibraryClip& clip = library.clips[static_cast<std::size_t>(trial) % library.clips.size()];
    auto world =
        MakeTrackingWorld(body, tracking, clip, {.suite_seed = options.seed, .scenario = "crowd", .trial = trial});
    if (!world || std::ssize(world->truth) != options.frames) continue;
    crowd.push_back(*std::move(world));
  }
  if (std::ssize(crowd) == options.characters) return crowd;
  return Fail({}, "only {} of {} characters have a built-in motion with {} frames at {:g} Hz; choose fewer frames",
              crowd.size(), options.characters, options.frames, options.rate_hz);
}

Crowd::Crowd(std::span<const TrackingWorld> worlds)
    : worlds_(worlds),
      tree_(worlds[0].tree),
      batch_(tree_, static_cast<int>(worlds.size())),
      statuses_(worlds.size(), IkStatus::kStalled) {
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    IkProblem problem{worlds[i].truth[0], worlds[i].targets[0], tree_.limits};
    problem.start.angles = worlds[i].first_angles;
    batch_.Set(static_cast<int>(i), problem);
  }
}

Crowd::Followed Crowd::FollowNext(const IkOptions& options, Precision precision) {
  // Copy the roots and targets of this frame into the batch, which is a structure of arrays.
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    assert(next_ < worlds_[i].truth.size());
    const TreeState& state = worlds_[i].truth[next_];
    for (int k = 0; k < 3; ++k) batch_.root(k)[i] = state.root_position[k];
    for (int k = 0; k < 9; ++k) batch_.root(3 + k)[i] = state.root_frame[k / 3][k % 3];
    for (int e = 0; e < static_cast<int>(tree_.effectors.size()); ++e) {
      const EffectorTarget& target = worlds_[i].targets[next_][e];
      for (int k = 0; k < 3; ++k) batch_.target(e, k)[i] = target.position[k];
      for (int k = 0; k < 9; ++k) batch_.target(e, 3 + k)[i] = target.axes[k / 3][k % 3];
    }
  }
  ++next_;
  // Solve the batch. The next frame starts from these angles.
  IkBatchSolution solution = SolveGaussNewtonBatch(tree_, batch_, options, precision);
  for (int d = 0; d < tree_.dof_count(); ++d) std::ranges::copy(solution.angles_of(d), batch_.start_angles(d).begin());
  Followed followed;
  for (const int steps : solution.iterations) followed.steps += steps;
  statuses_ = std::move(solution.statuses);
  followed.met = static_cast<int>(std::ranges::count(statuses_, IkStatus::kConverged));
  return followed;
}

TreeState Crowd::StateOf(std::size_t character) const {
  TreeState state = worlds_[character].truth[next_ > 0 ? next_ - 1 : 0];
  for (int d = 0; d < tree_.dof_count(); ++d) state.angles[d] = batch_.start_angles(d)[character];
  return state;
}

}  // namespace etude
