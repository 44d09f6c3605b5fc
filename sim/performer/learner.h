#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "sim/choreography/move.h"
#include "sim/performer/learning_law.h"
#include "sim/performer/person.h"
#include "sim/performer/rendition.h"
#include "sim/performer/session.h"
#include "sim/performer/style.h"
#include "sim/random/stream.h"

namespace etude {

/// The part of the coach that a learner sees in one frame.
struct Shown {
  enum class Act {
    kNothing,      ///< stands by, dozes, wakes: there is nothing to follow
    kDance,        ///< dances `move`, to be danced along
    kCorrect,      ///< a head shake, a wave, the puzzled act: about `move`
    kDemonstrate,  ///< `move` slowly: the learner only watches
  };
  Act act = Act::kNothing;
  int move = -1;         ///< index of the learner's moves; −1 where there is none
  int repetition = -1;   ///< of kDance: which performance of the dance; another number is another performance
  double beat = 0;       ///< of kDance: beats since that performance's first, up to the move's
  bool praises = false;  ///< whether the latest finished performance is praised in this frame, in whatever act
};

struct LearnerOptions {
  LearningLaw law = LearningLaw::kExponential;
  LearningRates rates = {};
  /// The cost of frequent feedback (Salmoni, Schmidt and Walter 1984; Winstein and Schmidt 1990): the share of what
  /// feedback teaches that does not last when it follows every performance. In [0, 1]; a half is ours.
  double guidance = 0.5;
  /// The level at which every skill starts, in [0, 1]; without a value it follows the person's kind and differs for
  /// every fault of every move.
  std::optional<double> skill = {};
  /// The severity of every fault that happens, in [0, 1]; drawn when there is no value.
  std::optional<double> severity = {};
  bool gives_up = true;  ///< whether patience can end
};

/// One performance that a learner was asked for, and its truth. Times are seconds since the learner's first frame.
struct LearnerPerformance {
  int repetition = -1;  ///< of the dance
  int move = 0;
  int attempt = 0;       ///< the number of the attempt at this move, from 0; keys its luck
  bool is_over = false;  ///< the coach shows it no more
  bool is_cut = false;   ///< and stopped before its last beat: there is nothing to judge
  /// The event, with faults, stray and truth from its first frame on; `end_s` is expected until it is over;
  /// `first_right_s` is found when it comes.
  SessionEvent event;
};

/// A person who dances along with a coach and learns, frame by frame: what they do depends on what was shown so far.
///
/// They follow what they see with their lag and in their own way (Style), and err by their skills, one for every fault
/// of every move. A performance's luck is keyed by its move and its attempt, never by time, so that every coach meets
/// the same luck. Practice teaches a little, a demonstration more, a correction most, but only of the faults of a
/// mistake that it follows. Feedback guides, too: it helps the next performances more than it teaches. Praise for a
/// mistake unteaches. A correction without a mistake and wrong praise cost patience; without patience a learner gives
/// up, and stands there. The sizes stand in learner.cc, with their sources or as ours.
class Learner {
 public:
  /// `moves`, `showable` (of the same moves) and the text of `key.scenario` must outlive this.
  Learner(const WorldKey& key, const Person& person, std::span<const Move> moves, const ShowableFaults& showable,
          const LearnerOptions& options = {});
  ~Learner();
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;

  /// Moves the learner on by one frame (30 Hz), in which they see this of the coach; returns the pose.
  const BodyPose& Step(const Shown& shown);

  const Person& person() const { return person_; }
  /// Returns the performances in the order in which they began, the current one last.
  std::span<const LearnerPerformance> performances() const { return performances_; }
  /// Returns the patience that is left, in [0, 1]; at 0 the learner has given up.
  double patience() const { return patience_; }
  bool HasGivenUp() const { return patience_ <= 0; }
  /// Returns the chance that the next performance of this move has no fault, as things stand.
  double ChanceOfRight(std::size_t move) const;
  /// Returns that chance without a coach, after the time of so many performances: nothing guides any more, and what is
  /// forgotten by then is forgotten. That of somebody who has given up is what they could do.
  double RetainedChanceOfRight(std::size_t move, int performances_later) const;

 private:
  struct Layer;      // one thing that the body does, blended over the one before
  struct MoveState;  // what is known and remembered of one move

  void Notice(const Shown& shown);
  void Begin(const Shown& shown);
  void End();
  void Correct(std::size_t move);
  void Demonstrate(std::size_t move);
  void Praise();
  void Feed(std::size_t move);
  void SpendPatience(double cost);
  std::vector<GradedFault> DrawFaults(RandomStream& dice, std::size_t move, std::size_t& instead) const;
  const Style& StyleOf(std::size_t move);
  Controls ControlsNow() const;
  void NoteLastKeyBeat();

  const WorldKey key_;
  const Person person_;
  const std::span<const Move> moves_;
  const ShowableFaults& showable_;
  const LearnerOptions options_;
  const Controls rest_;
  const Sway sway_;

  double time_s_ = 0;    // of this frame
  double danced_s_ = 0;  // of it dancing
  double patience_ = 1;
  Shown before_;  // what was shown in the frame before
  std::vector<LearnerPerformance> performances_;
  std::optional<std::size_t> latest_;  // of those that are over and were not cut
  std::vector<MoveState> known_;       // by move
  std::vector<Layer> layers_;          // the later over the earlier
  BodyPose pose_;
};

}  // namespace etude
