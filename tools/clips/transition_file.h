#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/transitions/transition_record.h"
#include "io/clips/open_clip.h"

namespace etude {

/// A request to write a transition into a file.
struct TransitionFileOptions {
  std::string from, to;  ///< references; each must name one clip
  double at_s = 0;       ///< the time of the request, seconds from the first frame of `from`'s file
  double budget_s = 1;   ///< the longest wait until `to` plays, seconds
  std::string choice = "played", join = "planted-feet";  ///< names of ChoiceNames() and JoinNames()
  std::vector<std::string> library;  ///< references of further clips, through which a transition may lead
  std::string output;                ///< a file of any MotionFormat but kBids
  OpenOptions reading;
};

/// The result. Times are in seconds; times of a clip count from the first frame of the clip's file.
struct TransitionFile {
  Branch branch = Branch::kNone;
  std::string why;                    ///< one sentence: why these frames were chosen, or why there is no transition
  double left_s = 0, entered_s = 0;   ///< times at which `from` is left and `to` is entered
  double wait_s = 0;                  ///< time from the request until `to` plays
  std::string through = {};           ///< name of the clip through which the transition leads, "" = none
  std::vector<double> points_s = {};  ///< times of the transition points in the written file
  double duration_s = 0;              ///< length of the written motion
  /// BodyConversion::changes of the two clips, without the doubts, which OpenOptions::on_doubt receives.
  std::vector<std::string> from_changes = {}, to_changes = {};
};

/// Plays `from` from its start, changes into `to` by a choice of frames and a join, plays `to` to its end, and writes
/// the whole motion: twenty joints with the proportions of `from`'s body, 30 Hz, metres, Y up. If no transition is
/// possible (`branch` is kNone), nothing is written. Fails if a clip cannot be opened or has fewer than two frames, and
/// if the time lies outside `from`.
Result<TransitionFile> WriteTransition(const TransitionFileOptions& options);

}  // namespace etude
