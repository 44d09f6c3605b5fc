#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The speeds of the joints, metres per second, by role.
using JointSpeeds = std::array<double, kRoleCount>;

/// The motion of a body in one frame.
struct FrameMotion {
  JointSpeeds speeds{};                    ///< central differences from two frames before to two frames after
  std::array<double, kRoleCount> moves{};  ///< 0 for a foot at rest on the floor; 1 for a moving foot and other joints
};

/// Computes the motion around each frame of a stream. A foot counts as moving from shortly before it leaves the floor
/// until shortly after it lands. A frame's motion is therefore known only kAhead frames later.
class MotionWindow {
 public:
  static constexpr std::size_t kAhead = 7;

  /// `rate_hz` must be positive.
  explicit MotionWindow(double rate_hz) : rate_hz_(rate_hz) {}

  /// Adds the next frame of the stream.
  void Push(const BodyPose& pose);
  /// Ends the stream: the motion of the last frames is then computed without frames after them.
  void End() { ended_ = true; }
  /// A pose with its motion.
  struct Known {
    const BodyPose& pose;  ///< valid until the next Push
    FrameMotion motion;
  };
  /// Returns the next frame whose motion is known, and advances to the frame after it; returns nullopt if more poses
  /// must be pushed first.
  std::optional<Known> Next();

 private:
  static constexpr std::size_t kKept = 16;  // number of frames: a power of two, larger than twice kAhead

  const BodyPose& PoseAt(std::size_t frame) const { return poses_[frame % kKept]; }
  /// Computes the speeds of all frames whose neighbouring frames are known.
  void ComputeSpeeds();

  double rate_hz_;
  bool ended_ = false;
  std::size_t count_ = 0;   ///< number of poses pushed
  std::size_t speeds_ = 0;  ///< number of frames with known speeds
  std::size_t next_ = 0;    ///< the frame to be returned next
  std::array<BodyPose, kKept> poses_{};
  std::array<JointSpeeds, kKept> frame_speeds_{};
};

/// A sensor that observes a body while it moves, for closed loops such as a coach and a learner.
class LiveSensor {
 public:
  /// The number of frames by which the body must plan ahead. A skeleton sensor's errors depend on the body's motion
  /// shortly after the frame, and cameras expose between frames. A frame's report never depends on later pictures or
  /// reports.
  static constexpr std::size_t kAhead = MotionWindow::kAhead;

  virtual ~LiveSensor() = default;

  /// Takes the body's next pose and returns the report of the frame `kAhead` frames earlier. Returns nullopt in the
  /// first `kAhead` frames.
  virtual std::optional<SensedFrame> Update(const BodyPose& pose) = 0;
};

}  // namespace etude
