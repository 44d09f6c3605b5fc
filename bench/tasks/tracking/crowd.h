#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bench/tasks/tracking/world.h"
#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/solvers/gauss_newton.h"

namespace etude {

struct CrowdOptions {
  int characters = 1000;
  int frames = 120;
  double rate_hz = 60;
  std::uint64_t seed = 1;
};

/// Motions of `frames` frames for so many bodies of one build, paper B's: windows, thrown by dice, of the built-in
/// moves and acts. Fails where these have no windows so long.
Result<std::vector<TrackingWorld>> MakeCrowd(const CrowdOptions& options);

/// All of them followed at once: each frame is a batch of `gauss-newton`, everybody from their last answer, within the
/// joints' limits. What becomes of one is what task `tracking` finds for it alone: in double to the last bit.
class Crowd {
 public:
  /// The worlds have one tree and as many frames each; there are some. They must outlive this.
  explicit Crowd(std::span<const TrackingWorld> worlds);

  struct Followed {
    int met = 0;    ///< who has met all targets
    int steps = 0;  ///< of all together
  };
  /// The next frame, of at most as many as there are.
  Followed FollowNext(const IkOptions& options, Precision precision);

  std::size_t size() const { return worlds_.size(); }
  /// Returns the character's state as it was followed last.
  TreeState StateOf(std::size_t character) const;
  bool HasMet(std::size_t character) const { return statuses_[character] == IkStatus::kConverged; }

 private:
  const std::span<const TrackingWorld> worlds_;
  const KinematicTree& tree_;
  IkBatch batch_;
  std::vector<IkStatus> statuses_;
  std::size_t next_ = 0;
};

}  // namespace etude
