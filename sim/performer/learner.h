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

/// The coach's action as a learner sees it in one frame.
struct Shown {
  enum class Act {
    kNothing,      ///< the coach stands by, dozes or wakes; the learner has nothing to follow
    kDance,        ///< the coach dances `move`, and the learner dances along
    kCorrect,      ///< the coach corrects `move` by one of its acts: head shake, wave or puzzled
    kDemonstrate,  ///< the coach shows `move` slowly, and the learner only watches
  };
  Act act = Act::kNothing;
  int move = -1;         ///< index into the learner's moves; −1 if the action has no move
  int repetition = -1;   ///< for kDance: number of the shown performance; a new number begins a new performance
  double beat = 0;       ///< for kDance: beats since that performance's first beat, up to the move's length
  bool praises = false;  ///< true: in this frame, the coach praises the latest finished performance; `act` may be any
};

struct LearnerOptions {
  LearningLaw law = LearningLaw::kExponential;
  LearningRates rates = {};
  /// The cost of frequent feedback (Salmoni, Schmidt and Walter 1984; Winstein and Schmidt 1990): if feedback follows
  /// every performance, this share of the learning from feedback is not retained. In [0, 1]; the default of 0.5 is
  /// ours.
  double guidance = 0.5;
  /// The initial level of every skill, in [0, 1]. The learner has one skill per move and fault: that of avoiding this
  /// fault. If empty, each level is drawn; its mean depends on the kind of person.
  std::optional<double> skill = {};
  /// The severity of every fault that happens, in [0, 1]; drawn if empty.
  std::optional<double> severity = {};
  bool gives_up = true;  ///< if false, the learner never loses patience
};

/// One performance that a learner was asked for, and the truth about it. Times are in seconds from the learner's first
/// frame.
struct LearnerPerformance {
  int repetition = -1;  ///< number of the performance within the dance
  int move = 0;
  int attempt = 0;       ///< number of the attempt at this move, from 0; the key of the attempt's random numbers
  bool is_over = false;  ///< true once the coach shows something else
  bool is_cut = false;   ///< true if the coach stopped the performance before its last beat, so it is not judged
  /// The event; faults, deviation and truth are known from the first frame of the performance on. `end_s` is an
  /// estimate until the performance is over; `first_right_s` is set when the last key beat is performed.
  SessionEvent event;
};

/// A person who dances along with a coach and learns, frame by frame. The person's behaviour depends only on what the
/// coach has shown so far.
///
/// Learners follow the coach with their lag and in their own style (Style). They make mistakes according to their
/// skills; there is one skill for every fault of every move. The random numbers of a performance are keyed by its move
/// and its attempt and never by time, so they are the same under every coach. Practice teaches a little, a
/// demonstration more, and a correction most; but a correction teaches only about the corrected performance's faults.
/// Feedback also guides: its effect on the next performances is larger than the part that is retained. Praise for a
/// mistake removes learning. Wrong praise and a correction without a mistake cost patience; without patience a learner
/// gives up and stands still. The constants are in learner.cc, with their sources or marked as ours.
class Learner {
 public:
  /// `showable` belongs to `moves`. Both, and the text of `key.scenario`, must outlive this object.
  Learner(const WorldKey& key, const Person& person, std::span<const Move> moves, const ShowableFaults& showable,
          const LearnerOptions& options = {});
  ~Learner();
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;

  /// Advances the learner by one frame (30 Hz), in which the coach shows `shown`. Returns the learner's pose.
  const BodyPose& Step(const Shown& shown);

  const Person& person() const { return person_; }
  /// Returns the performances in the order in which they began; the last one is the current performance.
  std::span<const LearnerPerformance> performances() const { return performances_; }
  /// Returns the remaining patience, in [0, 1]; at 0 the learner has given up.
  double patience() const { return patience_; }
  bool HasGivenUp() const { return patience_ <= 0; }
  /// Returns the probability that the next performance of this move has no fault.
  double ChanceOfRight(std::size_t move) const;
  /// Returns ChanceOfRight for a later time, after a pause without a coach as long as `performances_later`
  /// performances: the effect of guidance has ended, and part of the learning has been forgotten. For a learner who has
  /// given up, this is the probability that would hold if they danced again.
  double RetainedChanceOfRight(std::size_t move, int performances_later) const;

 private:
  struct Layer;      // one action of the body, blended over the one before
  struct MoveState;  // the skills of one move and the history of the move's performances

  void Notice(const Shown& shown);
  void Begin(const Shown& shown);
  void End();
  void Correct(std::size_t move);
  void Demonstrate(std::size_t move);
  void Praise();
  void NoteFeedback(std::size_t move);
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

  double time_s_ = 0;    // time of this frame
  double danced_s_ = 0;  // time spent dancing so far
  double patience_ = 1;
  Shown before_;  // what the coach showed in the previous frame
  std::vector<LearnerPerformance> performances_;
  std::optional<std::size_t> latest_;  // index of the latest performance that is over and was not cut
  std::vector<MoveState> known_;       // skills and history of each move
  std::vector<Layer> layers_;          // actions of the body; later layers are blended over earlier ones
  BodyPose pose_;
};

}  // namespace etude
