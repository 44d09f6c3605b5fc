#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/support.h"
#include "engine/transitions/choices/rehearsal.h"
#include "engine/transitions/joins/minimum_jerk.h"
#include "engine/transitions/joins/planted_feet.h"

namespace etude {

constexpr std::array kWays = {JoinStyle::kDirect, JoinStyle::kFades};
constexpr std::array kLengths_s = {0.3, 0.4, 0.5, 0.65, 0.8, 1.0, 1.2};

/// For each frame of the window and each joint: the length of the second difference of the joint's position, metres.
/// The larger value of the two motions is taken; a motion that has ended counts as 0.
using OwnAccelerations = std::vector<std::array<double, kRoleCount>>;

/// Sums up the cost of a join, whose frames are added in order from the transition point on.
class CostMeter {
 public:
  /// `usual` is the calmer clip's entry of MotionLibrary::usual_accelerations, but at least 9 m/s² (as metres per
  /// frame²). All arguments must outlive this object.
  CostMeter(const JoinWindow& window, const OwnAccelerations& own, double usual, const PlayedRates& rates)
      : window_(window), own_(own), usual_(usual), rates_(rates), before_(window.shown.before) {}

  void Add(const BodyPose& shown);
  /// Returns the cost in seconds of the frames added so far; it never decreases.
  double Seconds() const;

 private:
  const JoinWindow& window_;
  const OwnAccelerations& own_;
  const double usual_;
  const PlayedRates& rates_;
  BodyPose before_, here_;
  std::size_t count_ = 0;
  double worst_excess_ = 0;  // the largest excess of a joint's second difference over both `own_` and `usual_`, metres
  double off_ = 0;           // distance from the nearer clip's pose, metres, summed over the frames
};

/// Returns the distance that the feet slide along the floor in a join, metres. The displacement of a foot is multiplied
/// by a weight that decreases with the foot's height and is 0 from 2.5 cm on (Zhang, Starke, Komura and Saito 2018).
double SlideOf(std::span<const BodyPose> played);

/// Measures of how badly the floor supports the body in a join.
struct Burden {
  int unsupported = 0;  ///< length in frames of the longest run in which FindSupport finds no support
  /// Distance of the zero-moment point from the supports, integrated over time, m·s. Only the part above 10 cm and
  /// above the distance in the clips themselves counts.
  double beside = 0;
  double glide = 0;  ///< distance by which the slowest support glides farther than the same joint of a clip, metres
  double turn = 0;   ///< largest turn of the hips against a resting foot minus the clips' own turn, radians
};

/// The data that all joins at one pair of frames have in common.
class PairStage {
 public:
  /// `last` is the last frame of the wanted clip that is used; `frames` is the length of the longest join.
  PairStage(const MotionLibrary& library, const TransitionRequest& request, const FramePair& pair, int last,
            int frames);
  PairStage(const PairStage&) = delete;
  PairStage& operator=(const PairStage&) = delete;

  /// Returns the shift by which CarriedShift places the wanted clip in a join of `frames` frames.
  glm::dvec3 ShiftFor(int frames) const;
  /// Returns the window of a join of `frames` frames; the wanted clip is moved by `shift`.
  JoinWindow WindowFor(int frames, const glm::dvec3& shift) const;
  /// Returns one frame of a join of length kLengths_s[length] (`frames` frames), without planted feet and without
  /// shift.
  const BodyPose& LimbsAt(std::size_t length, int frames, JoinStyle way, int frame);
  /// Returns the steps that PlanSteps plans for a window that WindowFor returned for kLengths_s[length]. `carried`
  /// states whether the window's wanted clip was moved by the shift of ShiftFor. Joins of every style in kWays have
  /// the same steps, so the steps are planned once.
  const FootPlan& StepsIn(const JoinWindow& window, std::size_t length, bool carried);
  /// Rates a motion: the frames `played` of a join, and after them the wanted clip, moved by `shift`.
  Burden Rate(std::span<const BodyPose> played, const glm::dvec3& shift) const;

  const OwnAccelerations& own() const { return own_; }

 private:
  struct Limbs {
    std::optional<MinimumJerkPlay> play;
    std::vector<BodyPose> poses = {};
  };

  PairStage(const MotionLibrary& library, const TransitionRequest& request, const FramePair& pair,
            const FloorMove& floor_move, int last, int frames);
  double OwnBeside(int frame) const;
  double GlideAt(std::span<const BodyPose> shown, int frame, JointSet supports) const;
  double LargestTurn(std::span<const BodyPose> shown, std::span<const Support> supports) const;

  const JoinWindow window_;  // window of the longest join
  const OwnAccelerations own_;
  WindowTurns turns_;
  std::array<std::array<Limbs, kWays.size()>, kLengths_s.size()> limbs_;
  std::array<std::array<std::optional<FootPlan>, 2>, kLengths_s.size()> steps_;  // by [length][CarriedShift? 1 : 0]
  const FramePair pair_;
  std::span<const double> playing_beside_, wanted_beside_;  // MotionLibrary::beside_feet of both clips
  const int before_;                                        // number of frames of `playing_` before the pair's frame
  std::span<const BodyPose> playing_;                       // the playing clip around the join
  std::vector<BodyPose> wanted_;                            // the wanted clip from the pair on, aligned on the floor
  std::optional<SupportFinder> support_finder_;             // finds supports in both clips
};

/// Moves all joints of a pose by the same vector.
inline void Shift(const glm::dvec3& by, BodyPose& pose) {
  for (glm::dvec3& joint : pose.joints) joint += by;
}

}  // namespace etude
