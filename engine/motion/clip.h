#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace [[gnu::visibility("default")]] etude {

/// A joint's pose in its parent's frame: p ↦ translation + rotation · (scale ⊙ p), glTF's TRS. Motion capture has unit
/// scales.
struct LocalTransform {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};

  friend bool operator==(const LocalTransform&, const LocalTransform&) = default;
};

/// One frame: a local transform for every joint of the skeleton.
using LocalPose = std::vector<LocalTransform>;

/// A joint of a clip's own skeleton. Parents come before their children; the parent index of a root is −1.
struct Joint {
  std::string name;
  int parent = -1;
  LocalTransform rest;       ///< local transform in the rest pose, in the file's unit; BVH's OFFSET is its translation
  bool is_end_site = false;  ///< true for an end point without channels of its own (BVH "End Site")
};

struct Skeleton {
  std::vector<Joint> joints;

  /// Returns the index of the joint with this name, or −1.
  int Find(const std::string& name) const;
};

LocalPose RestPose(const Skeleton& skeleton);

/// A motion clip with the whole skeleton of its file, in the file's unit and axes.
struct Clip {
  std::string name;
  Skeleton skeleton;
  double rate_hz = 30;
  std::vector<LocalPose> frames;

  /// Returns the time from the first frame to the last, seconds.
  double DurationSeconds() const { return frames.empty() ? 0 : static_cast<double>(frames.size() - 1) / rate_hz; }
};

/// A joint's pose in the world: p ↦ position + axes · p. `axes` is a rotation unless the joint or one of its ancestors
/// has a scale.
struct GlobalTransform {
  glm::dvec3 position{0};
  glm::dmat3 axes{1};
};

/// Computes the forward kinematics of one frame; `out` gets one entry for each joint.
void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out);

/// Interpolates between two transforms: rotations by slerp along the shorter great arc, translations and scales
/// linearly. `part` is 0 at `from` and 1 at `to`.
LocalTransform Between(const LocalTransform& from, const LocalTransform& to, double part);

/// Returns the pose of a clip at a frame number. The number counts from 0, may be fractional, and is clamped to the
/// clip. Every joint's rotation is interpolated along the shorter great arc (slerp), translations and scales linearly.
/// Interpolating rotations keeps the lengths of limbs; interpolating positions would shorten them. A whole number
/// returns the frame unchanged. The clip must have at least one frame.
LocalPose SampleFrame(const Clip& clip, double frame);

/// Returns a skeleton that names its joints after the twenty roles, in metres, Y up, rooted at the hip centre. Its rest
/// pose is `rest`, with the axes of all joints parallel to the world's. Characters are bound to this skeleton.
Skeleton BodySkeleton(const BodyPose& rest);

/// Converts a motion to a clip whose skeleton is BodySkeleton of the first frame. All rotations are the identity, and
/// every joint has a translation from its parent in every frame. ComputeGlobals therefore returns every position
/// exactly, even if limbs change their lengths. The motion must have at least one frame.
Clip ToClip(const BodyMotion& motion, std::string name);

}  // namespace etude
