#include "bench/model/recording.h"

#include <algorithm>

namespace etude {

Recording::Recording() = default;
Recording::Recording(std::vector<Track> motions, std::string extras)
    : tracks(std::move(motions)), extras_json(std::move(extras)) {}
Recording::Recording(const Recording&) = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(const Recording&) = default;
Recording& Recording::operator=(Recording&&) noexcept = default;
Recording::~Recording() = default;

const BodyMotion* FindTrack(const Recording& recording, std::string_view name) {
  const auto track = std::ranges::find(recording.tracks, name, &Track::name);
  return track == recording.tracks.end() ? nullptr : &track->motion;
}

}  // namespace etude
