#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "engine/coaching/coach.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// The inputs of a session in addition to the sensor's frame, as in CoachInput.
struct SessionInput {
  std::optional<double> music_s = {};
  std::optional<bool> told_right = {};
  bool moment = false;
};

/// A coach with a sensor: it runs the recogniser and Coach::Step frame by frame. The benchmark uses this class, and so
/// do live sessions.
class CoachSession {
 public:
  struct Parts {
    const Coach* coach = nullptr;
    const Recogniser* recogniser = nullptr;  ///< a recogniser that was taught the moves of the dance, in the same order
    FilterOptions filter = {};
    /// If true, the recogniser also follows the mirrored skeleton, so that the coach can tell players that they use
    /// the wrong side. This changes only the coach's words and the computing time.
    bool tells_wrong_side = true;
  };

  /// Starts in the state `begin`, a result of Coach::Begin() or BeginDancing(). The objects that `parts` points to must
  /// outlive the session.
  CoachSession(const Parts& parts, CoachState begin);
  ~CoachSession();
  CoachSession(CoachSession&&) noexcept;
  CoachSession& operator=(CoachSession&&) noexcept;

  /// Processes the sensor's next raw frame.
  CoachOutput Next(const SensedFrame& frame, const SessionInput& input = {});

  const CoachState& state() const { return state_; }
  /// Replaces the state. The states of filters and of the recogniser's MoveFollowers do not change. Call this only
  /// while no window is open.
  void ReplaceState(CoachState state) { state_ = std::move(state); }

 private:
  struct Perception;

  const Coach* coach_;
  CoachState state_;
  std::unique_ptr<Perception> perception_;
};

/// Returns the frame as the sensor would see it in a mirror: left and right exchanged, x negated.
SensedFrame MirrorImage(const SensedFrame& frame);

}  // namespace etude
