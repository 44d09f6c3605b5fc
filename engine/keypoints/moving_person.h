#pragma once

#include <algorithm>
#include <optional>

#include "engine/capture/synchronise.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// A tracked person of one camera, interpolated between frames.
class MovingPerson {
 public:
  MovingPerson(const SeenPeople& people, const PersonTrack& track) : people_(people), track_(track) {}

  const PersonTrack& track() const { return track_; }

  /// Returns the person at a fractional frame; nullopt if a frame next to it does not show the person.
  std::optional<SeenPerson> At(double frame) const {
    if (frame < 0) return std::nullopt;
    const auto at = static_cast<std::size_t>(frame);
    const double share = frame - static_cast<double>(at);
    const SeenPerson *a = at > 0 ? In(at - 1) : nullptr, *b = In(at), *c = In(at + 1), *d = In(at + 2);
    if (b == nullptr || (share > 0 && c == nullptr)) return std::nullopt;
    if (share == 0) return *b;
    SeenPerson between;
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      const auto pixel = PixelBetween(PixelOf(a, i), PixelOf(b, i), PixelOf(c, i), PixelOf(d, i), share);
      if (pixel) between.keypoints[i] = {*pixel, std::min(b->keypoints[i].confidence, c->keypoints[i].confidence)};
    }
    return between;
  }

 private:
  const SeenPerson* In(std::size_t frame) const {
    const auto entry = track_.entries.find(frame);
    return entry == track_.entries.end() ? nullptr : &people_[frame][entry->second];
  }

  static OptionalPixel PixelOf(const SeenPerson* person, std::size_t landmark) {
    if (person == nullptr || !(person->keypoints[landmark].confidence > 0)) return std::nullopt;
    return person->keypoints[landmark].pixel;
  }

  const SeenPeople& people_;
  const PersonTrack& track_;
};

}  // namespace etude
