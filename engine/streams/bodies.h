#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/streams/recording.h"

namespace etude {

/// Several people of one file, told apart by the names that the file gives them.
class Bodies {
 public:
  /// The frame of the body called `id`, at this index of the file's frames.
  void Add(std::string_view id, std::size_t frame, const RolePlaces& places,
           const std::array<TrackingState, kRoleCount>& states);

  /// Puts one body into the recording's frames: the one asked for, by first appearance, else the one in most frames,
  /// of those the one that moves most. Files of crowded rooms hold furniture that was taken for a person for a while.
  Result<void> Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording) const;

 private:
  struct Seen {
    std::size_t frame;
    RolePlaces places;
    std::array<TrackingState, kRoleCount> states;
  };
  struct Body {
    std::string id;
    std::vector<Seen> frames;
  };

  static double PathOf(const Body& body);

  std::vector<Body> bodies_;
};

}  // namespace etude
