#pragma once

#include <string>
#include <vector>

#include "bench/metrics/transition_join.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "engine/transitions/library/library.h"
#include "io/clips/clip_library.h"

namespace etude {

/// The rules by which a library is made ready for transitions.
struct StageRules {
  FuzzySystem fuzzy;
  HeadRule head;
  int min_clips = TagRules{}.min_clips;
  int most_per_class = TagRules{}.most_per_class;
  TweenRules tween;            ///< of in-betweens
  bool asks_for_acts = false;  ///< the coach's acts are asked for while other clips play, where there are both
};

/// A library of clips made ready for transitions: all performed by one body (`JudgedProportions`), tagged, and each
/// with nature's own jumps to be compared with.
struct Stage {
  MotionLibrary library;                ///< its names are as rows and videos show them
  std::vector<std::string> identities;  ///< equal for equal clips: what opens the clip
  std::vector<std::vector<double>> natural_jumps_cm;
  std::vector<double> natural_slides_cmps;  ///< foot slide over each clip
  RealFrames real_frames;                   ///< of all clips
  FuzzySystem fuzzy;                        ///< by which they are tagged
  std::vector<int> playing;                 ///< the clips that play when another is asked for: all, unless acts are
  std::vector<int> wanted;                  ///< those that are asked for
};

/// Shorter clips have no unbroken window of eleven frames to be judged by.
constexpr int kShortestClip = 13;

/// The jumps that a transition between these two clips is compared with, in centimetres (docs/reference/metrics.md):
/// the clips asked for set the standard, not one played in between.
std::vector<double> NaturalJumpsOf(const Stage& stage, int from, int to);
/// The limit of the calmer of the two: the smaller of both clips' own.
double CalmerLimitCm(const Stage& stage, int from, int to);

Stage SetStage(const ClipLibrary& library, const StageRules& rules = {});

}  // namespace etude
