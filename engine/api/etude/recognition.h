#pragma once

#include <etude/motion.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude::engine {

/// A move as it is taught: right performances of it, from the first beat to the last.
struct TaughtMove {
  std::string name;
  std::vector<Motion> examples;  ///< at least one
};

struct RecogniserOptions {
  std::string kind = "whole-body";  ///< or "dtw", "nearest"
  bool smooths = true;              ///< the stream goes through Kinect's own filter first
};

/// The sight that a sensor had of a joint.
enum class Seen { kTracked, kInferred, kNotTracked };

/// One frame of a skeleton sensor, in the world.
struct SensedPose {
  Pose pose;
  std::array<Seen, kRoleCount> seen{};  ///< all tracked
  bool body_seen = true;                ///< false: nothing of the rest means anything
};

/// The evidence for moves in one frame, from this frame and those before it; all in 0…1.
struct Evidence {
  double asked = 0;             ///< that the one asked for is right so far; never falls while it is asked for
  std::vector<double> spotted;  ///< per move, how much this looks like the end of a right performance of it
};

class RecogniserStream;

/// A recogniser that was taught moves; never changes, and may be used by several threads.
class ETUDE_API Recogniser {
 public:
  /// Throws BadInput for no moves, two of one name, a move without examples, examples without frames or of places that
  /// are not finite, and a kind that there is not.
  explicit Recogniser(std::span<const TaughtMove> moves, const RecogniserOptions& options = {});
  Recogniser(Recogniser&&) noexcept;
  Recogniser& operator=(Recogniser&&) noexcept;
  ~Recogniser();

  /// Begins to follow a stream, which keeps what it needs of the recogniser. Throws BadInput for a rate of 0 or below.
  RecogniserStream Follow(double rate_hz = 30) const;

 private:
  friend class RecogniserStream;
  struct Taught;
  std::shared_ptr<const Taught> taught_;
};

/// One stream, frame by frame.
class ETUDE_API RecogniserStream {
 public:
  RecogniserStream(RecogniserStream&&) noexcept;
  RecogniserStream& operator=(RecogniserStream&&) noexcept;
  ~RecogniserStream();

  /// Asks for a move, by its index, from the next frame on; what was seen before does not count. Nothing: asks for
  /// none. Throws BadInput for a move that there is not.
  void Ask(std::optional<int> move);
  /// Takes the next frame. Throws BadInput for places that are not finite.
  Evidence Update(const SensedPose& frame);

 private:
  friend class Recogniser;
  struct Following;
  explicit RecogniserStream(std::unique_ptr<Following> following);
  std::unique_ptr<Following> following_;
};

}  // namespace etude::engine
