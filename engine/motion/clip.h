#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A joint's place in its parent's frame: p ↦ translation + rotation · (scale ⊙ p), glTF's TRS. Motion
/// capture has unit scales.
struct LocalTransform {
  glm::dvec3 translation{0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1};

  friend bool operator==(const LocalTransform&, const LocalTransform&) = default;
};

/// One frame: a local transform for every joint of the skeleton.
using LocalPose = std::vector<LocalTransform>;

/// A joint of a clip's own skeleton. Joints stand parents first; a root's parent is −1.
struct Joint {
  std::string name;
  int parent = -1;
  LocalTransform rest;       ///< in the rest pose, in the file's unit; BVH's OFFSET is its translation
  bool is_end_site = false;  ///< an end point without channels of its own (BVH "End Site")
};

struct Skeleton {
  std::vector<Joint> joints;

  /// The index of the joint of that name, or −1.
  int Find(const std::string& name) const;
};

LocalPose RestPose(const Skeleton& skeleton);

/// A motion clip with its own full skeleton, in its file's own unit and axes.
struct Clip {
  std::string name;
  Skeleton skeleton;
  double rate_hz = 30;
  std::vector<LocalPose> frames;

  /// Returns the time from the first frame to the last, seconds.
  double DurationSeconds() const { return frames.empty() ? 0 : static_cast<double>(frames.size() - 1) / rate_hz; }
};

/// A joint's place in the world: p ↦ position + axes · p. The axes are a rotation, unless some joint above scales.
struct GlobalTransform {
  glm::dvec3 position{0};
  glm::dmat3 axes{1};
};

/// Computes the forward kinematics of one frame: `out` gets one entry per joint.
void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out);

/// Returns the transform `part` of the way from one to the other: the rotation along the shorter great arc (slerp), the
/// translation and the scale straight.
LocalTransform Between(const LocalTransform& from, const LocalTransform& to, double part);

/// Returns the pose of a clip at `frame` counted from 0, also between frames, clamped to the clip: every joint's
/// rotation along the shorter great arc between the two frames around (slerp), translations and scales straight. Joints
/// turn, so a limb keeps its length in between; interpolated positions would shorten it. A whole number gives the frame
/// as it is. Needs at least one frame.
LocalPose SampleFrame(const Clip& clip, double frame);

/// A skeleton of the twenty roles by name, metres, Y up, rooted at the hip centre, whose rest pose is `rest` with all
/// axes along the world's: what characters are bound to.
Skeleton BodySkeleton(const BodyPose& rest);

/// A motion as a clip of BodySkeleton(its first frame). Nothing turns: every joint has its own translation from its
/// parent, so that ComputeGlobals gives back every position exactly, also of a performer whose limbs stretch. Needs at
/// least one frame.
Clip ToClip(const BodyMotion& motion, std::string name);

}  // namespace etude
