#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/motion/body.h"
#include "engine/transitions/library/bridge_frames.h"

namespace etude {

/// The speed limits of a tween. Ours: paper A draws its in-between and says nothing of its speed.
struct TweenRules {
  double turn_speed = Radians(360);   ///< radians per second, > 0: the fastest that any limb turns, at mid-way
  double shortest_s = 0.3;            ///< a tween takes at least this, however little there is to do
  double widest_turn = Radians(120);  ///< radians: a pair of keys with a wider turn is joined by way of the hub
};

/// The most that one tween can take: its limbs turn by half a turn at most.
double LongestTween(const TweenRules& rules);

/// The motion between two poses of one body. Limbs turn and keep their lengths, arms and head in the frame of the
/// trunk; the foot that bears the weight stays where it is, and the lowest joint is as far above the floor as the two
/// poses', in proportion. It begins where `from` stands; `to` is turned and moved on the floor to fit.
class Tween {
 public:
  Tween(const BodyPose& from, const BodyPose& to);

  /// The largest angle by which a limb turns, radians, at most π.
  double WidestTurn() const;
  /// Returns the pose at `part` of the way, 0 … 1: at 0 `from`, at 1 `to` on its new place.
  BodyPose At(double part) const;

 private:
  struct Turn {
    glm::dvec3 start{0}, axis{0};  ///< unit, in the trunk's frame for arms and head, else in the world
    double angle = 0;
    glm::dvec3 At(double part) const;
  };
  static Turn MakeTurn(const glm::dvec3& from, const glm::dvec3& to);

  BodyPose from_;
  double low_from_ = 0, low_to_ = 0;  ///< heights of the lowest joints
  Role planted_ = Role::kLeftAnkle;
  glm::dquat trunk_from_{1, 0, 0, 0}, trunk_to_{1, 0, 0, 0};
  std::array<Turn, kRoleCount> turns_;  ///< of the limb to this joint
  std::array<double, kRoleCount> lengths_from_{}, lengths_to_{};
};

/// Samples a tween: the first is `from`, the last is `to` on its new place, and speed and acceleration are zero at
/// both. As many as the rules' speed asks for.
std::vector<BodyPose> SampleTween(const Tween& tween, double rate_hz, const TweenRules& rules);

/// Appends a tween from the last of `frames`, of which there must be one, to `to` on its new place.
void AppendTween(const BodyPose& to, double rate_hz, const TweenRules& rules, std::vector<BodyPose>& frames);

/// The rules by which the keys of in-betweens are chosen. Ours, as paper A draws its in-between by hand.
struct InBetweenRules {
  FeatureWeights weights = PaperWeights();
  double threshold = kPaperThreshold;  ///< every bridge frame has a key nearer than this
  TweenRules tween;
};

/// Paper A's in-between motion (補間動作, section 3.5, figures 13 and 14): made of bridge frames, so that it can be
/// joined to any two clips. Ours is a star: key poses all over the library, and the tweening from any of them to any
/// other, directly or by way of the hub.
struct InBetweenNet {
  /// A bridge frame that in-betweens are built of.
  struct Key {
    int clip = 0;
    int frame = 0;
  };
  std::vector<Key> keys;  ///< the first is the hub: the most typical frame of the most frequent pose
  TweenRules tween;
};

/// Chooses the keys of a library's in-betweens: going from the most frequent poses to the rarest, and in each from the
/// most typical frame on, every bridge frame becomes a key that has none within the threshold. A library without bridge
/// frames gets its keys of all frames. Needs a frame.
InBetweenNet BuildInBetweens(std::span<const TaggedClip> tagged, const InBetweenRules& rules = {});

/// The longest that any in-between takes, seconds: two tweens, in whole frames.
double LongestInBetween(const TweenRules& rules, double rate_hz);

}  // namespace etude
