#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/motion/body.h"
#include "engine/transitions/library/bridge_frames.h"

namespace etude {

/// The speed limits of a tween. Paper A does not specify the speed of its in-between, so these limits are ours.
struct TweenRules {
  /// The maximum angular velocity of any limb (reached half-way), radians per second, > 0.
  double turn_speed = Radians(360);
  double shortest_s = 0.3;  ///< minimum duration of a tween, seconds
  /// If a limb rotates by more than this angle (radians) between two keys, the keys are connected through the hub.
  double widest_turn = Radians(120);
};

/// Returns the longest duration of a tween in seconds: a limb then rotates by half a turn, the maximum.
double LongestTween(const TweenRules& rules);

/// The motion between two poses of one body. Limbs rotate and keep their lengths; the directions of arms and head are
/// interpolated in the trunk's frame. The foot that bears the weight stays in place, and the height of the lowest joint
/// is interpolated. The motion begins at `from`; `to` is rotated and moved on the floor to fit `from`.
class Tween {
 public:
  Tween(const BodyPose& from, const BodyPose& to);

  /// Returns the largest angle by which a limb rotates, in radians, at most π.
  double WidestTurn() const;
  /// Returns the pose at the fraction `part` of the way, in [0, 1]: `from` at 0, the aligned `to` at 1.
  BodyPose At(double part) const;

 private:
  struct Turn {
    /// Unit vectors: the limb's first direction and its rotation axis, in the trunk's frame for arms and head, in the
    /// world for the other limbs.
    glm::dvec3 start{0}, axis{0};
    double angle = 0;
    glm::dvec3 At(double part) const;
  };
  static Turn MakeTurn(const glm::dvec3& from, const glm::dvec3& to);

  BodyPose from_;
  double low_from_ = 0, low_to_ = 0;  ///< heights of the lowest joints of both poses
  Role planted_ = Role::kLeftAnkle;
  glm::dquat trunk_from_{1, 0, 0, 0}, trunk_to_{1, 0, 0, 0};
  std::array<Turn, kRoleCount> turns_;  ///< indexed by the limb's child joint
  std::array<double, kRoleCount> lengths_from_{}, lengths_to_{};
};

/// Returns samples of a tween, from `from` to the aligned `to`, with zero velocity and acceleration at both ends. The
/// number of samples follows from the speed limits of `rules`.
std::vector<BodyPose> SampleTween(const Tween& tween, double rate_hz, const TweenRules& rules);

/// Appends a tween from the last of `frames` (at least one) to the aligned `to`.
void AppendTween(const BodyPose& to, double rate_hz, const TweenRules& rules, std::vector<BodyPose>& frames);

/// The rules that choose the keys of in-betweens. Paper A draws its in-between by hand, so these rules are ours.
struct InBetweenRules {
  FeatureWeights weights = PaperWeights();
  double threshold = kPaperThreshold;  ///< every bridge frame is nearer than this to some key
  TweenRules tween;
};

/// Paper A's in-between motion (補間動作, section 3.5, figures 13 and 14). Such a motion consists of bridge frames and can
/// therefore be joined to any two clips. Our net consists of key poses from all clips of the library. A tween leads
/// from any key to any other, directly if they are near enough, otherwise through the hub.
struct InBetweenNet {
  /// A bridge frame from which in-betweens are built.
  struct Key {
    int clip = 0;
    int frame = 0;
  };
  std::vector<Key> keys;  ///< the first is the hub: the most typical frame of the most frequent pose
  TweenRules tween;
};

/// Chooses the keys of a library's in-betweens. Candidates are the bridge frames, from the most frequent pose to the
/// rarest; frames of one pose come in order from the most typical frame on. A frame becomes a key if no key is within
/// the threshold. In a library without bridge frames all frames are candidates. The library must have at least one
/// frame.
InBetweenNet BuildInBetweens(std::span<const TaggedClip> tagged, const InBetweenRules& rules = {});

/// Returns the longest duration of an in-between in seconds: two tweens, each rounded up to whole frames.
double LongestInBetween(const TweenRules& rules, double rate_hz);

}  // namespace etude
