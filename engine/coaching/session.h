#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "engine/coaching/coach.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// What a session may be told beside what the sensor sees.
struct SessionInput {
  std::optional<double> music_s = {};   ///< CoachInput's
  std::optional<bool> told_right = {};  ///< likewise
  bool moment = false;                  ///< likewise
};

/// A coach with eyes: filter, recogniser and Coach::Step, frame by frame. What is judged in the benchmark and what runs
/// live is this.
class CoachSession {
 public:
  struct Parts {
    const Coach* coach = nullptr;
    const Recogniser* recogniser = nullptr;  ///< taught the moves of the dance, in their order
    FilterOptions filter = {};
    bool tells_wrong_side = true;  ///< a second follower looks at the mirror image: words only, and time
  };

  /// What `parts` points to must outlive the session. `begin`: Coach::Begin() or BeginDancing().
  CoachSession(const Parts& parts, CoachState begin);
  ~CoachSession();
  CoachSession(CoachSession&&) noexcept;
  CoachSession& operator=(CoachSession&&) noexcept;

  /// The sensor's next frame, as it came.
  CoachOutput Next(const SensedFrame& frame, const SessionInput& input = {});

  const CoachState& state() const { return state_; }
  /// Goes on from another state, when no window is open: what was seen of the player so far is not forgotten.
  void GoOnFrom(CoachState state) { state_ = std::move(state); }

 private:
  struct Eyes;

  const Coach* coach_;
  CoachState state_;
  std::unique_ptr<Eyes> eyes_;
};

/// What the sensor would have seen in a mirror: left and right exchanged, x reversed.
SensedFrame MirrorImage(const SensedFrame& frame);

}  // namespace etude
