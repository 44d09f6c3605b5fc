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

/// Returns one motion of `frames` frames for each character, all with paper B's body. The motions are random windows of
/// the built-in moves and acts. Fails if these clips are too short for enough windows.
Result<std::vector<TrackingWorld>> MakeCrowd(const CrowdOptions& options);

/// Follows the motions of many characters at once. In each frame, one batch of `gauss-newton` solves the problems of
/// all characters. Every character starts from its previous answer and keeps the joint limits. In double precision,
/// each character's result equals, bit for bit, the result of task `tracking` for that character alone.
class Crowd {
 public:
  /// There must be at least one world. All worlds must have the same tree and number of frames, and must outlive this
  /// object.
  explicit Crowd(std::span<const TrackingWorld> worlds);

  struct Followed {
    int met = 0;    ///< number of characters that met all targets
    int steps = 0;  ///< number of solver steps of all characters together
  };
  /// Solves the next frame. May be called as often as the worlds have frames.
  Followed FollowNext(const IkOptions& options, Precision precision);

  std::size_t size() const { return worlds_.size(); }
  /// Returns the character's state in the last solved frame.
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
