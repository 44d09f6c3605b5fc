#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "engine/coaching/coach.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// The inputs of a session beside the sensor's frame.
struct SessionInput {
  std::optional<double> music_s = {};   ///< CoachInput's
  std::optional<bool> told_right = {};  ///< likewise
  bool moment = false;                  ///< likewise
};

/// A coach with a sensor: recogniser and Coach::Step, frame by frame. What is judged in the benchmark and what runs
/// live is this.
class CoachSession {
 public:
  struct Parts {
    const Coach* coach = nullptr;
    const Recogniser* recogniser = nullptr;  ///< taught the moves of the dance, in their order
    FilterOptions filter = {};
    bool tells_wrong_side = true;  ///< a second follower looks at the mirror image: words only, and time
  };

  /// Starts in `begin`, which Coach::Begin() or BeginDancing() made. All that `parts` points to must outlive the
  /// session.
  CoachSession(const Parts& parts, CoachState begin);
  ~CoachSession();
  CoachSession(CoachSession&&) noexcept;
  CoachSession& operator=(CoachSession&&) noexcept;

  /// Takes the sensor's next frame, as it came.
  CoachOutput Next(const SensedFrame& frame, const SessionInput& input = {});

  const CoachState& state() const { return state_; }
  /// Replaces the state while no window is open; what was seen of the player so far is kept.
  void ReplaceState(CoachState state) { state_ = std::move(state); }

 private:
  struct Perception;

  const Coach* coach_;
  CoachState state_;
  std::unique_ptr<Perception> perception_;
};

/// Returns the frame as the sensor would have seen it in a mirror: left and right exchanged, x reversed.
SensedFrame MirrorImage(const SensedFrame& frame);

}  // namespace etude
