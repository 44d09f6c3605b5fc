#pragma once

#include <glm/glm.hpp>

namespace etude {

/// What a coach can be set by. Times in seconds, ours where paper A gives none.
struct CoachOptions {
  /// From which evidence on a performance counts as right, in (0, 1]. A recogniser's own: tune it where false alarms
  /// are to be equal.
  double right_from = 0.5;
  /// Windows open and close so much after the repetition that the coach dances: a learner follows with a lag.
  double reaction_s = 0.3;
  /// The player's left is the coach's right, as in a mirror: what is seen is mirrored before it is judged. Whoever
  /// feeds the coach does that (CoachSession); here it decides words only.
  bool player_mirrors = false;
  /// From so many mistakes in a row on the coach is puzzled instead of shaking its head.
  int puzzled_after = 3;
  /// So often at most one repetition is corrected before the dance goes on.
  int most_corrections = 3;
  /// Share of a song's judged performances that must be right for praise at its end.
  double praise_share = 0.8;
  /// A window in which the body moved less than this share of the time is stood through.
  double still_share = 0.1;
  /// Without anybody moving or in sight for so long, the dance is left for the attract act; likewise standby.
  double idle_s = 30;
  /// After so much attracting the coach dozes off.
  double doze_s = 30;
  /// By how much tags may slow and hurry a move: frames of the dance per frame.
  double slowest = 0.8, fastest = 1.25;
  bool follows_tags = true;  ///< false: the dance keeps its own tempo, whatever the music does
  /// The sensor in the world, and how far from it on the floor the player should be, metres.
  glm::dvec3 sensor{0, 1, 2.75};
  double nearest_m = 1.5, farthest_m = 3.6;
};

}  // namespace etude
