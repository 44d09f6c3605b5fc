#include "engine/transitions/fillers/filler.h"

#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/fillers/gap_library.h"
#include "engine/transitions/fillers/planted_gap.h"
#include "engine/transitions/joins/inertialise.h"
#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {
namespace {

glm::dvec3 MeanVelocity(const Ends& ends) { return (ends.end - ends.start) / ends.seconds; }

/// Fills each channel independently. Channels are the root's position, and each joint's rotation vector relative to the
/// joint's last past rotation. A straight line in these vectors is a slerp.
template <typename RootLaw, typename Law>
std::vector<TreePose> FillEach(const Gap& gap, const RootLaw& root_law, const Law& law) {
  const TreePose &before = gap.past[gap.past.size() - 2], &last = gap.past.back(), &next = gap.future.front();
  const bool knows_velocity = gap.future.size() > 1;
  std::vector<TreePose> filled(gap.frames, {glm::dvec3(0), std::vector<glm::dquat>(gap.tree.size())});
  Ends ends{.seconds = gap.Seconds()};
  const auto at = [&](const auto& any, std::size_t f) { return any(ends, static_cast<double>(f + 1) / gap.rate_hz); };
  // Fill the root's position.
  ends.start = last.root;
  ends.start_velocity = (last.root - before.root) * gap.rate_hz;
  ends.end = next.root;
  if (knows_velocity) ends.end_velocity = (gap.future[1].root - next.root) * gap.rate_hz;
  for (std::size_t f = 0; f < gap.frames; ++f) filled[f].root = at(root_law, f);
  // Fill the joints' rotations.
  ends.start = glm::dvec3(0);
  for (std::size_t j = 0; j < gap.tree.size(); ++j) {
    const glm::dquat back = glm::conjugate(last.turns[j]);
    ends.start_velocity = -gap.rate_hz * RotationVector(back * before.turns[j]);
    ends.end = RotationVector(back * next.turns[j]);
    if (knows_velocity) {
      glm::dvec3 after = RotationVector(back * gap.future[1].turns[j]);
      // RotationVector is at most π long, so it flips beyond half a turn. Undo the flip: take the equivalent vector on
      // the side of `ends.end`.
      if (glm::dot(after, ends.end) < 0 && glm::length(after) > kPi / 2) after -= 2 * kPi * glm::normalize(after);
      ends.end_velocity = (after - ends.end) * gap.rate_hz;
    }
    for (std::size_t f = 0; f < gap.frames; ++f) filled[f].turns[j] = last.turns[j] * TurnOf(at(law, f));
  }
  return filled;
}

/// Interpolates between two quaternions as LAFAN1's code does (`quat_slerp`, then `quat_normalize`): linearly between
/// near quaternions, otherwise by slerp.
glm::dquat Lafan1Between(const glm::dquat& from, glm::dquat to, double share) {
  double cosine = glm::dot(from, to);
  if (cosine < 0) {
    to = -to;
    cosine = -cosine;
  }
  constexpr double kNear = 0.01;
  if (1 - cosine < kNear) return glm::normalize((1 - share) * from + share * to);
  const double angle = std::acos(cosine), sine = std::sin(angle);
  return glm::normalize(std::sin((1 - share) * angle) / sine * from + std::sin(share * angle) / sine * to);
}

std::vector<TreePose> Interpolate(const Gap& gap, std::span<const double> /*values*/) {
  const TreePose &last = gap.past.back(), &next = gap.future.front();
  std::vector<TreePose> filled;
  for (std::size_t f = 0; f < gap.frames; ++f) {
    const double share = static_cast<double>(f + 1) / static_cast<double>(gap.frames + 1);
    TreePose& pose = filled.emplace_back(TreePose{last.root + share * (next.root - last.root), {}});
    for (std::size_t j = 0; j < gap.tree.size(); ++j) {
      pose.turns.push_back(Lafan1Between(last.turns[j], next.turns[j], share));
    }
  }
  return filled;
}

/// Fills each channel by a law that has the setting `half_life_s`.
template <auto Law, double kFallback>
std::vector<TreePose> FillByHalfLife(const Gap& gap, std::span<const double> values) {
  const double half_life_s = values.empty() ? kFallback : values[0];
  const auto law = [&](const Ends& ends, double t) { return Law(ends, t, half_life_s); };
  return FillEach(gap, law, law);
}

constexpr double kSpring_s = SpringOptions().half_life_s, kDead_s = DeadOptions().half_life_s;

/// Fills by dead blending. The root's horizontal velocity halves in 0.2 s. Its vertical velocity and the joints'
/// angular velocities halve in 0.06 s, because these movements soon reverse.
std::vector<TreePose> DeadBlend(const Gap& gap) {
  constexpr double kSwinging_s = 0.06;
  const auto swinging = [](const Ends& ends, double t) { return DeadBlendedAt(ends, t, kSwinging_s); };
  const auto root = [&](const Ends& ends, double t) {
    const glm::dvec3 over_floor = DeadBlendedAt(ends, t, kDead_s);
    return glm::dvec3(over_floor.x, swinging(ends, t).y, over_floor.z);
  };
  return FillEach(gap, root, swinging);
}

std::vector<TreePose> FillLikeNear(const Gap& gap, std::span<const double> /*values*/) {
  return gap.library ? gap.library->FillLikeNear(gap, DeadBlend) : DeadBlend(gap);
}

std::vector<TreePose> FillWithPlantedFeet(const Gap& gap, std::span<const double> values) {
  std::vector<TreePose> filled = FillLikeNear(gap, values);
  PlantGap(gap, filled);
  return filled;
}

NumberSetting HalfLife(double fallback, const char* meaning) {
  return {"half_life_s", fallback, 0.01, 10, false, meaning};
}

}  // namespace

glm::dvec3 InertialisedAt(const Ends& ends, double seconds, double half_life_s) {
  const glm::dvec3 mean = MeanVelocity(ends);
  const auto rest = [&](const glm::dvec3& velocity, double since) {
    return (1 - Smoothstep(0, ends.seconds, since)) *
           SpringDecay({glm::dvec3(0), velocity}, since, {.half_life_s = half_life_s});
  };
  const double left = ends.seconds - seconds;
  return ends.start + mean * seconds + rest(ends.start_velocity - mean, seconds) +
         rest(mean - ends.end_velocity.value_or(mean), left);
}

glm::dvec3 DeadBlendedAt(const Ends& ends, double seconds, double half_life_s) {
  const double left = ends.seconds - seconds;
  const glm::dvec3 from = ends.start + DecayingWay(ends.start_velocity, seconds, half_life_s);
  const glm::dvec3 to = ends.end - DecayingWay(ends.end_velocity.value_or(MeanVelocity(ends)), left, half_life_s);
  return from + Smoothstep(0, ends.seconds, seconds) * (to - from);
}

glm::dvec3 LeastJerkAt(const Ends& ends, double seconds) {
  if (ends.end_velocity) {
    return ends.end +
           MinimumJerkAt({ends.start - ends.end, ends.start_velocity, *ends.end_velocity}, seconds, ends.seconds);
  }
  // With free end velocity, the optimal jerk is proportional to (1 − s)², s = t / T. `shape` is its third integral,
  // scaled to 1 at s = 1.
  const double s = seconds / ends.seconds, left = 1 - s;
  const double shape = s * s * 5 / 3 - s * 5 / 6 + (1 - left * left * left * left * left) / 6;
  const glm::dvec3 missing = ends.end - ends.start - ends.start_velocity * ends.seconds;
  return ends.start + ends.start_velocity * seconds + shape * missing;
}

std::span<const Filler> AllFillers() {
  using Values = std::span<const double>;
  static const std::vector<Filler> fillers = {
      // Fillers that need no library.
      {.name = "zero-velocity",
       .description = "holds the last pose",
       .fill = [](const Gap& gap, Values) { return std::vector<TreePose>(gap.frames, gap.past.back()); }},
      {.name = "interpolation",
       .description = "interpolates along straight lines and great arcs (lerp, slerp)",
       .fill = Interpolate},
      {.name = "inertialised",
       .description = "interpolates, and adds the velocity difference at each end, which decays like a spring",
       .settings = {HalfLife(kSpring_s, "Time in which a difference decays to one half.")},
       .fill = FillByHalfLife<InertialisedAt, kSpring_s>},
      {.name = "dead-blending",
       .description = "continues both ends with decaying velocities, and fades from one end to the other",
       .settings = {HalfLife(kDead_s, "Time in which a velocity decays to one half.")},
       .fill = FillByHalfLife<DeadBlendedAt, kDead_s>},
      {.name = "minimum-jerk",
       .description = "moves each joint with minimum jerk",
       .fill = [](const Gap& gap, Values) { return FillEach(gap, LeastJerkAt, LeastJerkAt); }},
      // Fillers that learn from the training clips.
      {.name = "nearest-gap",
       .description =
           "dead blending, corrected by the error of dead blending in the training gap with the most similar ends",
       .uses_library = true,
       .fill =
           [](const Gap& gap, Values) {
             return gap.library ? gap.library->FillLikeNearest(gap, DeadBlend) : std::vector<TreePose>();
           }},
      {.name = "near-gaps",
       .description =
           "dead blending, corrected by the mean error of dead blending in similar gaps of the training clips",
       .uses_library = true,
       .fill = FillLikeNear},
      {.name = "planted-feet",
       .description = "like near-gaps, but feet that bear the body's weight stay in place while the other feet step",
       .uses_library = true,
       .fill = FillWithPlantedFeet}};
  return fillers;
}

}  // namespace etude
