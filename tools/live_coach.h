#pragma once

#include <cstdint>
#include <functional>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/coaching/session.h"
#include "engine/streams/live_stream.h"

namespace etude {

/// Writes the first line of `etude coach`: the song, its moves with their hints and key poses, the order of joints.
Result<std::string> CoachHead(const Dance& dance);

/// Writes one frame as a line of JSON (docs/coach.md). Places are metres, rounded to the millimetre; without the body
/// when `brief`.
Result<std::string> CoachLine(const CoachOutput& output, std::int64_t frame, const Dance& dance, bool brief);

/// The position of the music while a coach dances to it: as a line '#music 12.34' of the stream tells, else as the
/// coach had it played.
class MusicPosition {
 public:
  /// Pauses, or plays on from another place.
  void Follow(const MusicCommand& command);
  /// Lets the time of one frame pass.
  void Tick();
  /// Gives the seconds into the song; nothing while it is silent.
  std::optional<double> Seconds() const { return now_s_; }

  /// Takes a line of the stream; one that is not about music changes nothing. Refused: '#music' without seconds.
  Result<void> Take(std::string_view line, int number);

 private:
  std::optional<double> now_s_;
};

struct LiveCoachOptions {
  std::string policy;           ///< a name of LivePolicyNames()
  std::string filter;           ///< a name of FilterNames()
  bool dances_at_once = false;  ///< begins without a clap
  bool plans_ahead = false;     ///< spreads planning over frames, for streams that come live
  bool brief = false;           ///< leaves out frames in which nothing was decided, and bodies
  CoachOptions coach = {};
};

/// A coach's session fed by a stream of skeletons, frame by frame. It begins with the first frame, when it is known
/// where its sensor stands.
class LiveCoach {
 public:
  using OnLine = std::function<void(const std::string& line)>;

  /// `transitions` and `recogniser` must outlive it. `on_line` gets every line as soon as its frame was seen.
  LiveCoach(const DanceTransitions& transitions, const Recogniser& recogniser, LiveCoachOptions options,
            OnLine on_line);

  /// Reads a stream to its end.
  Result<void> Follow(std::istream& stream, LiveStream& live);

  /// Gives how long each frame took, ms, from its arrival until its line was written.
  const std::vector<double>& times_ms() const { return times_ms_; }

 private:
  Result<void> Take(const SensedFrame& frame, const StreamRecording& meaning);
  void Begin(const StreamRecording& meaning);

  const DanceTransitions& transitions_;
  const Recogniser& recogniser_;
  LiveCoachOptions options_;
  OnLine on_line_;
  std::unique_ptr<Coach> coach_;
  std::optional<CoachSession> session_;
  MusicPosition music_;
  std::int64_t frame_ = 0;
  std::vector<double> times_ms_;
};

}  // namespace etude
