#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "sim/choreography/move.h"
#include "sim/performer/learning_law.h"
#include "sim/performer/person.h"
#include "sim/performer/rendition.h"
#include "sim/performer/session.h"
#include "sim/performer/sway.h"
#include "sim/random/stream.h"

namespace etude {

/// What a learner sees of the coach in one frame.
struct Shown {
  enum class Act {
    kNothing,      ///< stands by, dozes, wakes: there is nothing to follow
    kDance,        ///< the move to be danced along
    kCorrect,      ///< a head shake, a wave, the puzzled act: about `move`
    kDemonstrate,  ///< `move` slowly: the learner only watches
    kPraise,       ///< about `move`; may come while the coach dances on (`praises`)
  };
  Act act = Act::kNothing;
  int move = -1;        ///< index of the learner's moves; −1: none
  int repetition = -1;  ///< of kDance: which performance of the dance; another number is another performance
  double beat = 0;      ///< of kDance: beats since that performance's first, in [0, the move's)
  bool praises = false;  ///< the latest finished performance is praised in this frame
};

struct LearnerOptions {
  LearningLaw law = LearningLaw::kExponential;
  LearningRates rates;
  /// How much frequent feedback costs: 0 nothing; 1: feedback after every performance teaches nothing that lasts.
  double guidance = 0.5;
  /// Where every skill starts, in [0, 1]; else by the person's kind, another for every move and fault.
  std::optional<double> skill = {};
  /// Whether patience ends.
  bool gives_up = true;
};

/// One performance that a learner was asked for, and its truth. Times are seconds since the learner's first frame.
struct LearnerPerformance {
  int repetition = -1;  ///< of the dance
  int move = 0;
  int attempt = 0;     ///< the how-manieth of this move: what its luck is keyed by
  bool is_cut = false;  ///< the coach stopped before its last beat: nothing is to be judged
  bool is_over = false;
  SessionEvent event;  ///< `end_s` is an estimate until it is over
};

/// A person who dances along with a coach, frame by frame, and learns: each frame depends on what was shown up to it,
/// never on what comes.
///
/// They follow what they see with their lag, in their own way (Style), and err by their skills: of every fault of every
/// move one in [0, 1]. A performance's luck is keyed by its move and the attempt, never by time, so that every coach
/// meets the same. Practice teaches a little, a demonstration more, a correction most, if it follows a mistake in that
/// move (contingent). Praise for a mistake unteaches; corrections without one, and wrong praise, cost patience, and
/// without patience a learner gives up: stands there, absent. Sizes are ours unless a source is named.
class Learner {
 public:
  /// `moves` must outlive this.
  Learner(const WorldKey& key, const Person& person, std::span<const Move> moves, const LearnerOptions& options = {});

  /// The learner's next frame (30 Hz), after they have seen this one of the coach's.
  const BodyPose& Step(const Shown& shown);

  /// In the order in which they began, the current one last. Faults, stray and truth are known from the beginning.
  std::span<const LearnerPerformance> performances() const { return performances_; }
  bool HasGivenUp() const { return patience_ <= 0; }
  double patience() const { return patience_; }
  /// The chance that a performance of this move has no fault: now; and after a rest, without a coach, so many
  /// performances' time later (retention).
  double ChanceOfRight(int move) const;
  double RetainedChanceOfRight(int move, int performances_later) const;

 private:
  struct Layer;
};

}  // namespace etude
