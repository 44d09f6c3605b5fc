#pragma once

#include <etude/motion.h>
#include <etude/recognition.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/coaching/coach_output.h"
#include "engine/coaching/dance.h"

namespace etude::engine {

/// Returns the names of the rules that decide when a coach interrupts: "at-first-mistake" (paper A's), "never", …
ETUDE_API std::vector<std::string> CoachPolicies();

struct CoachOptions {
  std::string policy = "at-first-mistake";  ///< name of the policy: one of CoachPolicies()
  /// Name of the rule that selects the frames of a transition between clips, as in TransitionOptions.
  std::string choice = "played";
  std::string join = "planted-feet";      ///< name of the method that joins two clips, as in TransitionOptions
  std::string recogniser = "whole-body";  ///< name of the recogniser: "whole-body", "dtw" or "nearest"
  /// If true, Kinect's own smoothing filter is applied to the stream before recognition.
  bool smooths = false;
  /// If true, players dance as in a mirror, with the right side of the body when the coach uses the left side.
  bool mirrors = false;
  bool dances_at_once = false;  ///< true: the coach starts with the dance, without waiting for a clap
  /// A performance is right if its evidence is at least this, in (0, 1]; nullopt: the recogniser's own threshold.
  std::optional<double> right_from = {};
  /// The position of the sensor in the world, metres; players are asked to stand 1.5 to 3.6 m from it.
  glm::dvec3 sensor_m{0, 1, 2.75};
};

/// Paper A's coach with a sensor: watches a player, shows a dance, corrects, and says why. It runs frame by frame at 30
/// Hz.
class ETUDE_API Coach {
 public:
  /// @param moves right performances of each move, in the order of the dance's moves. Throws BadInput for a dance that
  /// violates the rules stated at its fields, for other moves than the dance's, for an example without frames, and for
  /// unknown names.
  Coach(const Dance& dance, std::span<const TaughtMove> moves, const CoachOptions& options = {});
  Coach(Coach&&) noexcept;
  Coach& operator=(Coach&&) noexcept;
  ~Coach();

  /// Takes the sensor's next frame and returns the coach's next frame. `music_s` is the position of the heard music,
  /// seconds into the song; nullopt: no music. Throws BadInput for positions that are not finite, and for a `music_s`
  /// outside 0 to 10⁶. Texts and the picture in the result stay valid as long as the coach exists.
  CoachOutput Step(const SensedFrame& frame, std::optional<double> music_s = {});

 private:
  struct Session;
  std::unique_ptr<Session> session_;
};

}  // namespace etude::engine
