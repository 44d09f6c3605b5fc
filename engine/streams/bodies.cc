#include "engine/streams/bodies.h"

#include <fmt/format.h>

#include <algorithm>

namespace etude {

void Bodies::Add(std::string_view id, std::size_t frame, const RolePlaces& places,
                 const std::array<TrackingState, kRoleCount>& states) {
  auto body = std::ranges::find(bodies_, id, &Body::id);
  if (body == bodies_.end()) body = bodies_.insert(bodies_.end(), Body{std::string(id), {}});
  body->frames.push_back({frame, places, states});
}

/// How far all joints have come, in the file's unit.
double Bodies::PathOf(const Body& body) {
  double path = 0;
  for (std::size_t t = 1; t < body.frames.size(); ++t) {
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const auto &before = body.frames[t - 1].places[i], &now = body.frames[t].places[i];
      if (before && now) path += glm::distance(*before, *now);
    }
  }
  return path;
}

Result<void> Bodies::Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording) const {
  if (bodies_.empty()) return {};
  std::size_t chosen = 0;
  if (reading.body) {
    chosen = static_cast<std::size_t>(*reading.body);
    if (chosen >= bodies_.size()) return Fail({file}, "body {} of {}, counted from 0", chosen, bodies_.size());
  } else {
    for (std::size_t b = 1; b < bodies_.size(); ++b) {
      const std::size_t most = bodies_[chosen].frames.size(), here = bodies_[b].frames.size();
      if (here > most || (here == most && PathOf(bodies_[b]) > PathOf(bodies_[chosen]))) chosen = b;
    }
  }
  if (bodies_.size() > 1) {
    recording.remarks.push_back(fmt::format("{} bodies, of which body {}{}", bodies_.size(), chosen,
                                            reading.body ? "" : ", in the most frames"));
  }
  for (const Seen& seen : bodies_[chosen].frames) {
    recording.frames[seen.frame].places = seen.places;
    recording.frames[seen.frame].states = seen.states;
  }
  return {};
}

}  // namespace etude
