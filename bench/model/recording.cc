#include "bench/model/recording.h"

#include <algorithm>

namespace etude {

const BodyMotion* FindTrack(const Recording& recording, std::string_view name) {
  const auto track = std::ranges::find(recording.tracks, name, &Track::name);
  return track == recording.tracks.end() ? nullptr : &track->motion;
}

}  // namespace etude
