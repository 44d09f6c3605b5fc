#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/streams/recording.h"

namespace etude {

/// The people of one file, distinguished by the file's identifiers of bodies. If several bodies of one frame have the
/// same identifier, or none, positions distinguish them: each body continues the nearest body of the frames before.
class Bodies {
 public:
  /// Adds a frame in which the body `id` ("" if the file gives none) is seen. `frame` is the frame's index in the file;
  /// it must not decrease.
  void Add(std::string_view id, std::size_t frame, const RolePositions& places,
           const std::array<TrackingState, kRoleCount>& states);

  /// Copies one body into the recording's frames: the requested body, counted by first appearance, or, without a
  /// request, the body in most frames. Of bodies in equally many frames, takes the body that moves most (SpreadOf),
  /// because sensors sometimes take furniture for a person. Calls JoinContinued before it chooses.
  Result<void> Choose(const StreamReading& reading, const std::string& file, StreamRecording& recording);

 private:
  struct Seen {
    std::size_t frame;
    RolePositions places;
    std::array<TrackingState, kRoleCount> states;
  };
  struct Body {
    std::string id;
    std::vector<Seen> frames;
  };
  struct Ambiguous {
    std::string id;
    std::size_t frame;
  };

  /// Finds two bodies of the last frame (`pending_`) that have exchanged their identifiers: each is much nearer to
  /// where the other was in the frame before. From this frame on, each keeps its earlier identifier (`ids_`).
  void FollowExchange();

  /// Appends the bodies of the last frame (`pending_`) to `bodies_`.
  void Assign();
  /// Appends bodies of one frame that have the same identifier, the nearest pair of bodies first.
  void AssignByNearness(const std::vector<Body>& same);

  /// Joins bodies that are one person (ours): a tracker that loses a person for a moment gives the person a new
  /// identifier. The second body must appear at most a second after the first body disappears (at most three seconds if
  /// the file shows nobody in between), and the joints of the two must then be at most half a trunk apart on average.
  /// The nearest pair is joined first, and a body continues at most one other body. A remark reports each pair.
  void JoinContinued(StreamRecording& recording);

  /// Returns how far the joints move, in squares of the file's unit (ours): the sum over the joints of the squared
  /// diagonal of the box that holds the joint's places, without the lowest and the highest 5 % along each axis. A place
  /// is the median of up to ten frames, and a step by more than a trunk per frame is left out, so that neither jitter
  /// nor a jump counts as motion. The diagonals are squared so that one waving hand counts as more motion than a little
  /// jitter of every joint.
  static double SpreadOf(const Body& body);
  static std::optional<double> GapInTrunks(const Seen& before, const Seen& after);

  std::vector<Body> bodies_;
  std::vector<Body> pending_;           // the bodies of the last frame, each with this one frame
  std::map<std::string, std::string, std::less<>> ids_;  // the earlier identifiers of exchanged bodies
  std::vector<Ambiguous> exchanged_;    // the frames in which identifiers are exchanged; one identifier of each pair
  std::optional<Ambiguous> ambiguous_;  // the first identifier that several bodies of one frame have
};

}  // namespace etude
