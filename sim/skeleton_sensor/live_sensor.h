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
  JointSpeeds speeds{};                    ///< over the two frames before and after
  std::array<double, kRoleCount> moves{};  ///< 0 for a foot that rests on the floor, 1 in motion and for other joints
};

/// The motion around each frame of a stream. A foot counts as moving shortly before it leaves and after it lands, so
/// a frame's motion is known kAhead frames later.
class MotionWindow {
 public:
  static constexpr std::size_t kAhead = 7;

  /// `rate_hz` > 0.
  explicit MotionWindow(double rate_hz) : rate_hz_(rate_hz) {}

  /// Adds the next frame of the stream.
  void Push(const BodyPose& pose);
  /// Ends the stream: the motion of the last frames is computed from the frames that there are.
  void End() { ended_ = true; }
  /// The pose and the motion of the next frame whose motion is known.
  struct Known {
    const BodyPose& pose;  ///< valid until the next Push
    FrameMotion motion;
  };
  std::optional<Known> Next();

 private:
  static constexpr std::size_t kKept = 16;  // frames: a power of two, above twice kAhead

  const BodyPose& PoseAt(std::size_t frame) const { return poses_[frame % kKept]; }
  void NoteSpeeds();

  double rate_hz_;
  bool ended_ = false;
  std::size_t count_ = 0;   ///< poses pushed
  std::size_t speeds_ = 0;  ///< frames whose speeds are noted
  std::size_t next_ = 0;    ///< the frame to be told next
  std::array<BodyPose, kKept> poses_{};
  std::array<JointSpeeds, kKept> noted_{};
};

/// The interface of a sensor that watches a body while it moves, for closed loops.
class LiveSensor {
 public:
  /// The number of frames that a body must have planned ahead: sensors err by how it is about to move, cameras look
  /// between frames. What is reported of a frame depends on later pictures or reports in no case.
  static constexpr std::size_t kAhead = MotionWindow::kAhead;

  virtual ~LiveSensor() = default;

  /// Takes the body's next pose and returns the report of the frame `kAhead` before it; nothing in the first `kAhead`
  /// frames.
  virtual std::optional<SensedFrame> Update(const BodyPose& pose) = 0;
};

}  // namespace etude
