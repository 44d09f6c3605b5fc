#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <string_view>

#include "engine/motion/body.h"

namespace etude {

/// How far a performance strays from what the person meant: from the same person's own performance of the move asked
/// for, with the same habits and the same luck, but without a fault. No other person's motion, no taught clip and no
/// recogniser has a part in it.
struct Stray {
  /// The worst limb's: the angle between its direction as danced and as meant, root mean square over the performance,
  /// degrees. Compared at equal shares of the performance, whatever the clock says.
  double limb_deg = 0;
  /// How far ahead of its clock, or behind it, the performance is: root mean square over its time, beats.
  double timing_beats = 0;
};

/// What a performance truly is.
enum class Truth {
  kRight,
  kGrey,  ///< neither: reported apart, no method gains or loses by it
  kWrong,
};
/// "right", "grey", "wrong".
std::string_view TruthName(Truth truth);

/// Where right ends and wrong begins (ours).
struct StrayLimits {
  Stray right{.limb_deg = 12, .timing_beats = 0.25};
  Stray wrong{.limb_deg = 25, .timing_beats = 0.5};
};

/// Right: both measures within the first limits. Wrong: one of them beyond the second. Else grey.
Truth TruthOf(const Stray& stray, const StrayLimits& limits = {});

/// The limbs that strays are measured by: trunk, line of the shoulders, and both upper arms, forearms, thighs, shanks.
constexpr std::size_t kStrayLimbs = 10;
/// Their unit directions, as the person stands: `pose` faces +Z when they face the coach. A limb without length has
/// none (zero), which differs from nothing.
std::array<glm::dvec3, kStrayLimbs> LimbDirections(const BodyPose& pose);

/// `limb_deg` of a performance given by its pose at any share of it, as meant and as danced; from 32 shares.
double LimbStrayDeg(const std::function<BodyPose(double share)>& meant,
                    const std::function<BodyPose(double share)>& danced);
/// `timing_beats` of a performance of so many beats: the shares that are meant and danced when the clock is due at 0…1,
/// clamped to the performance; from 64 moments.
double TimingStrayBeats(const std::function<double(double due)>& meant, const std::function<double(double due)>& danced,
                        double beats);

}  // namespace etude
