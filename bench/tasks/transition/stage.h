#pragma once

#include <string>
#include <vector>

#include "bench/metrics/transition_join.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"
#include "io/clips/clip_library.h"
#include "sim/random/stream.h"

namespace etude {

/// The rules by which a library is prepared for transitions.
struct StageRules {
  FuzzySystem fuzzy;
  HeadRule head;
  int min_clips = TagRules{}.min_clips;
  int most_per_class = TagRules{}.most_per_class;
  TweenRules tween;            ///< the rules by which tweens are made
  bool asks_for_acts = false;  ///< true: if there are acts and other clips, the coach's acts are requested while other
                               ///< clips play
};

/// A library of clips prepared for transitions. All clips are transferred to one body (`JudgedProportions`) and tagged.
/// The natural jumps of each clip are measured, because transitions are compared with them.
struct Stage {
  MotionLibrary library;                ///< the clips, with the names that rows and videos show
  std::vector<std::string> identities;  ///< the source of each clip; equal for equal clips
  std::vector<std::vector<double>> natural_jumps_cm;
  std::vector<double> natural_slides_cmps;  ///< foot slide over each clip, cm/s
  RealFrames real_frames;                   ///< the frames of all clips
  FuzzySystem fuzzy;                        ///< the fuzzy system by which the clips are tagged
  std::vector<int> playing;                 ///< clips that may play at a request: all, or all but the coach's acts
  std::vector<int> wanted;                  ///< clips that may be requested: all, or the coach's acts alone
};

/// The smallest number of frames of a usable clip. A shorter clip has no unbroken window of eleven frames with second
/// differences.
constexpr int kMinClipFrames = 13;

/// Returns the natural jumps, centimetres, with which a transition from clip `from` to clip `to` is compared
/// (docs/reference/metrics.md). A clip that plays in between has no influence.
std::vector<double> NaturalJumpsOf(const Stage& stage, int from, int to);
/// Returns the smaller of the natural limits of two clips, centimetres.
double CalmerLimitCm(const Stage& stage, int from, int to);

Stage SetStage(const ClipLibrary& library, const StageRules& rules = {});

/// Returns the index of the clip that plays in this trial. The stage must contain clips.
int FromClip(const Stage& stage, const WorldKey& key);

/// Draws one trial: the clip that plays, the requested clip, and the time of the request. The method will set the
/// waiting time. If this fails, the error is the reason why the world is skipped.
Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key);

}  // namespace etude
