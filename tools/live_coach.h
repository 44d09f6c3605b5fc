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

/// Returns the first line of `etude coach`: the song, the song's moves with hints and key poses, and the order of the
/// joints.
Result<std::string> CoachHead(const Dance& dance);

/// Returns one frame as a line of JSON (docs/coach.md). Positions are in metres, rounded to the millimetre; with
/// `brief`, the line has no body.
Result<std::string> CoachLine(const CoachOutput& output, std::int64_t frame, const Dance& dance, bool brief);

/// The position in the music while a coach dances. The position comes from lines '#music 12.34' of the stream; without
/// such lines, it is computed from the coach's own music commands.
class MusicPosition {
 public:
  /// Pauses the music, or continues the music at another position.
  void Follow(const MusicCommand& command);
  /// Advances the music by one frame.
  void Tick();
  /// Returns the seconds since the start of the song; nullopt while the music is silent.
  std::optional<double> Seconds() const { return now_s_; }

  /// Reads any line of the stream. Only a '#music' line changes the position, and only while the music plays. Fails on
  /// '#music' without seconds.
  Result<void> Take(std::string_view line, int number);

 private:
  std::optional<double> now_s_;
};

struct LiveCoachOptions {
  std::string policy;           ///< a name of LivePolicyNames()
  std::string filter;           ///< a name of FilterNames()
  bool dances_at_once = false;  ///< true: the coach begins to dance without waiting for a clap
  bool plans_ahead = false;     ///< true: planning is spread over frames, as live streams need
  bool brief = false;           ///< true: all bodies, and all frames without a decision, are left out
  CoachOptions coach = {};
  /// Receives a remark at the start if the sensor's tilt was corrected or trunks are far from upright.
  std::function<void(const std::string& remark)> on_remark = {};
};

/// Runs a coach's session on a stream of skeletons, frame by frame. The session begins with the first frame, because
/// the position of the sensor is known only then.
class LiveCoach {
 public:
  using OnLine = std::function<void(const std::string& line)>;

  /// `transitions` and `recogniser` must outlive this object. `on_line` receives every line as soon as the line's frame
  /// is processed.
  LiveCoach(const DanceTransitions& transitions, const Recogniser& recogniser, LiveCoachOptions options,
            OnLine on_line);

  /// Reads a stream to its end.
  Result<void> Follow(std::istream& stream, LiveStream& live);

  /// Returns the processing time of each frame in ms, from the arrival of the frame until the frame's line was written.
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
