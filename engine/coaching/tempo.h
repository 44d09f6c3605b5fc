#pragma once

#include "engine/coaching/dance.h"

namespace etude {

/// The moment of the music that belongs to a frame of the dance, seconds: straight between two tags, and at 30 Hz
/// before the first and after the last.
double MusicAt(const Dance& dance, double frame);

/// The first tag of the dance at `frame` or after it.
int NextTag(const Dance& dance, double frame);

/// Paper A's music-time tags (3.4): how many frames of the dance to show per frame, from `frame` on, where `music_s` is
/// heard, so that tag `next` (beyond the last one: the dance's end) is reached when its moment is. Below 1 the move is
/// slowed, above it is hurried; within [slowest, fastest].
double RateToTag(const Dance& dance, int next, double frame, double music_s, double slowest, double fastest);

}  // namespace etude
