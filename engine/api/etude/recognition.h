#pragma once

#include <etude/motion.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/recognition/skeleton_stream.h"
#include "engine/recognition/taught_move.h"

namespace etude::engine {

struct RecogniserOptions {
  std::string kind = "whole-body";  ///< name of the recogniser: "whole-body", "dtw" or "nearest"
  bool smooths = true;              ///< true: Kinect's own smoothing filter is applied before recognition
};

/// The evidence for moves at one frame, computed from this frame and all earlier frames of the stream; values in 0…1.
struct Evidence {
  double asked = 0;             ///< evidence that the requested move is right so far; never falls during one request
  std::vector<double> spotted;  ///< for each move, how much the motion looks like the end of a right performance
};

class RecogniserStream;

/// A recogniser that was taught moves. It is immutable, so several threads may use it.
class ETUDE_API Recogniser {
 public:
  /// Throws BadInput for no moves, two moves with one name, a move without examples, examples without frames or with
  /// positions that are not finite, and an unknown kind. `StreamOf` converts a motion to an example.
  explicit Recogniser(std::span<const TaughtMove> moves, const RecogniserOptions& options = {});
  Recogniser(Recogniser&&) noexcept;
  Recogniser& operator=(Recogniser&&) noexcept;
  ~Recogniser();

  /// Begins to follow a stream; the stream keeps the data of the recogniser alive. Throws BadInput for a rate outside
  /// (0, 1000].
  RecogniserStream Follow(double rate_hz = 30) const;

 private:
  friend class RecogniserStream;
  struct Taught;
  std::shared_ptr<const Taught> taught_;
};

/// Recognises moves in one stream, frame by frame.
class ETUDE_API RecogniserStream {
 public:
  RecogniserStream(RecogniserStream&&) noexcept;
  RecogniserStream& operator=(RecogniserStream&&) noexcept;
  ~RecogniserStream();

  /// Requests a move, by its index, from the next frame on; earlier frames do not count. nullopt ends the request.
  /// Throws BadInput for a move that does not exist.
  void Ask(std::optional<int> move);
  /// Takes the next frame. Throws BadInput for positions that are not finite.
  Evidence Update(const SensedFrame& frame);

 private:
  friend class Recogniser;
  struct Following;
  explicit RecogniserStream(std::unique_ptr<Following> following);
  std::unique_ptr<Following> following_;
};

}  // namespace etude::engine
