#include "bench/tasks/evaluation/spoil.h"

#include <algorithm>
#include <cmath>

#include "sim/random/stream.h"

namespace etude {
namespace {

/// Replaces each position by the result of `change(frame, joint, position)`.
template <typename Change>
void ChangeEach(RawMotion& motion, Change change) {
  const std::size_t joints = motion.joints.size();
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    motion.positions[i] = change(i / joints, i % joints, motion.positions[i]);
  }
}

/// Returns the mean position of a joint over the frames [begin, end). Frames in which the joint is not seen are left
/// out.
glm::dvec3 MeanOf(const RawMotion& motion, std::size_t joint, std::size_t begin, std::size_t end) {
  glm::dvec3 sum(0);
  double count = 0;
  for (std::size_t f = begin; f < end; ++f) {
    if (!IsSeen(motion.At(f, joint))) continue;
    sum += motion.At(f, joint);
    ++count;
  }
  return sum / count;
}

void AddNoise(RawMotion& motion, double noisy_mm, const std::string& seed_name) {
  RandomStream dice({.suite_seed = 1, .scenario = seed_name, .trial = 0}, "noise of a control");
  ChangeEach(motion,
             [&](std::size_t, std::size_t, const glm::dvec3& p) { return p + noisy_mm / 1000 * dice.Normal3(); });
  // The noise moves both ends of a limb, so the limb turns by √2 · noise / length; the length is kSegment_m.
  constexpr double kSegment_m = 0.42;
  RandomStream turns({.suite_seed = 1, .scenario = seed_name, .trial = 0}, "turns of a control");
  for (glm::dquat& rotation : motion.rotations) {
    const glm::dvec3 turn = std::sqrt(2.0) * noisy_mm / 1000 / kSegment_m * turns.Normal3();
    rotation = glm::normalize(glm::dquat(1, 0.5 * turn) * rotation);
  }
}

/// Returns the mean of a joint's rotations over the frames [begin, end). Each quaternion gets the sign that is nearer
/// to `near`.
glm::dquat MeanTurn(const RawMotion& motion, std::size_t joint, std::size_t begin, std::size_t end,
                    const glm::dquat& near) {
  glm::dquat sum(0, 0, 0, 0);
  for (std::size_t f = begin; f < end; ++f) {
    const glm::dquat& rotation = motion.rotations[f * motion.joints.size() + joint];
    sum += glm::dot(rotation, near) < 0 ? -rotation : rotation;
  }
  return glm::dot(sum, sum) > 0 ? glm::normalize(sum) : near;
}

/// Replaces each rotation by the result of `change(frame, joint, rotation)`.
template <typename Change>
void TurnEach(RawMotion& motion, Change change) {
  const std::size_t joints = motion.joints.size();
  for (std::size_t i = 0; i < motion.rotations.size(); ++i) {
    motion.rotations[i] = change(i / joints, i % joints, motion.rotations[i]);
  }
}

void Smooth(RawMotion& motion, double smoothed_ms) {
  const RawMotion before = motion;
  const auto reach = static_cast<std::size_t>(std::lround(smoothed_ms / 2000 * motion.rate_hz));
  ChangeEach(motion, [&](std::size_t f, std::size_t j, const glm::dvec3& p) {
    // The window shrinks towards the ends of the take, so that it stays centred.
    const std::size_t half = std::min({reach, f, before.FrameCount() - 1 - f});
    return IsSeen(p) ? MeanOf(before, j, f - half, f + half + 1) : p;
  });
  TurnEach(motion, [&](std::size_t f, std::size_t j, const glm::dquat& rotation) {
    const std::size_t half = std::min({reach, f, before.FrameCount() - 1 - f});
    return MeanTurn(before, j, f - half, f + half + 1, rotation);
  });
}

void Fade(RawMotion& motion, double faded_percent) {
  std::vector<glm::dvec3> means;
  for (std::size_t j = 0; j < motion.joints.size(); ++j) means.push_back(MeanOf(motion, j, 0, motion.FrameCount()));
  ChangeEach(motion,
             [&](std::size_t, std::size_t j, const glm::dvec3& p) { return p + faded_percent / 100 * (means[j] - p); });
  if (motion.rotations.empty()) return;
  std::vector<glm::dquat> turns;
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    turns.push_back(MeanTurn(motion, j, 0, motion.FrameCount(), motion.rotations[j]));
  }
  TurnEach(motion, [&](std::size_t, std::size_t j, const glm::dquat& rotation) {
    return glm::slerp(rotation, turns[j], faded_percent / 100);
  });
}

/// Holds the ankle and the toes of each foot at rest as long as the toes are low.
void LockFeet(RawMotion& motion, double low_m) {
  for (const auto& [ankle, toes] :
       {std::pair(Role::kLeftAnkle, Role::kLeftFoot), {Role::kRightAnkle, Role::kRightFoot}}) {
    const int a = motion.roles[Index(ankle)], t = motion.roles[Index(toes)];
    if (a < 0 || t < 0) continue;
    const std::size_t joints = motion.joints.size();
    bool was_low = false;
    for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
      const bool is_low = motion.At(f, static_cast<std::size_t>(t)).y < low_m;
      for (const int j : {a, t}) {
        const std::size_t i = f * joints + static_cast<std::size_t>(j);
        if (!is_low || !was_low) continue;
        motion.positions[i] = motion.positions[i - joints];
        if (!motion.rotations.empty()) motion.rotations[i] = motion.rotations[i - joints];
      }
      was_low = is_low;
    }
  }
}

/// Mirrors the frames from `begin` on about a plane of constant X. Each joint gets the motion of the joint on the other
/// side.
void Mirror(RawMotion& motion, std::size_t begin) {
  const RawMotion before = motion;
  std::vector<std::size_t> other(motion.joints.size());
  for (std::size_t j = 0; j < other.size(); ++j) other[j] = j;
  for (const Role role : AllRoles()) {
    const int j = motion.roles[Index(role)], k = motion.roles[Index(Mirrored(role))];
    if (j >= 0 && k >= 0) other[static_cast<std::size_t>(j)] = static_cast<std::size_t>(k);
  }
  const int root = std::max(0, motion.roles[Index(Role::kHipCentre)]);
  const double middle = MeanOf(motion, static_cast<std::size_t>(root), 0, motion.FrameCount()).x;
  ChangeEach(motion, [&](std::size_t f, std::size_t j, const glm::dvec3& p) {
    const glm::dvec3& q = before.At(f, other[j]);
    return f < begin ? p : glm::dvec3(2 * middle - q.x, q.y, q.z);
  });
  // Joint k, on the other side, has turned from its rest rotation by `from_rest`. Mirror this turn, and turn joint j
  // from its own rest rotation by the result.
  TurnEach(motion, [&](std::size_t f, std::size_t j, const glm::dquat& rotation) {
    if (f < begin) return rotation;
    const std::size_t k = other[j];
    const glm::dquat from_rest =
        before.rotations[f * before.joints.size() + k] * glm::conjugate(before.rest_rotations[k]);
    return glm::dquat(from_rest.w, from_rest.x, -from_rest.y, -from_rest.z) * before.rest_rotations[j];
  });
}

/// A time between two frames: `part` is the fraction of the way from frame `from` to frame `to`.
struct Moment {
  std::size_t from = 0, to = 0;
  double part = 0;
};

/// Replaces each frame f by the motion at `moment_of(f)`.
template <typename MomentOf>
void Retime(RawMotion& motion, MomentOf moment_of) {
  const RawMotion before = motion;
  const std::size_t joints = motion.joints.size();
  for (std::size_t f = 0; f < before.FrameCount(); ++f) {
    const Moment at = moment_of(f);
    for (std::size_t j = 0; j < joints; ++j) {
      const glm::dvec3 &a = before.At(at.from, j), &b = before.At(at.to, j);
      motion.positions[f * joints + j] = a + at.part * (b - a);
      if (motion.rotations.empty()) continue;
      motion.rotations[f * joints + j] =
          glm::slerp(before.rotations[at.from * joints + j], before.rotations[at.to * joints + j], at.part);
    }
  }
}

}  // namespace

RawMotion Spoilt(const RawMotion& truth, const Spoiler& spoiler, const std::string& seed_name) {
  constexpr double kPerCent = 100, kCmPerMetre = 100, kMsPerSecond = 1000;
  RawMotion motion = truth;
  // Change the positions of the joints.
  if (spoiler.noisy_mm > 0) AddNoise(motion, spoiler.noisy_mm, seed_name);
  if (spoiler.smoothed_ms > 0) Smooth(motion, spoiler.smoothed_ms);
  if (spoiler.faded_percent > 0) Fade(motion, spoiler.faded_percent);
  const double scale = 1 + spoiler.scaled_percent / kPerCent;
  const double step_m = spoiler.gliding_cm_s / kCmPerMetre / truth.rate_hz;
  ChangeEach(motion, [&](std::size_t f, std::size_t, const glm::dvec3& p) {
    return scale * p + glm::dvec3(spoiler.moved_cm / kCmPerMetre + step_m * static_cast<double>(f),
                                  spoiler.lifted_cm / kCmPerMetre, 0);
  });
  if (spoiler.feet_locked_cm > 0) LockFeet(motion, spoiler.feet_locked_cm / kCmPerMetre);
  // Exchange left and right, and change the times at which the joints have these positions.
  const auto begin_of = [&](double share) {
    return static_cast<std::size_t>(static_cast<double>(truth.FrameCount()) * (1 - share));
  };
  if (spoiler.mirrored_share > 0) Mirror(motion, begin_of(spoiler.mirrored_share));
  const std::size_t last = truth.FrameCount() - 1;
  if (spoiler.kept_frames > 1) {
    const auto step = static_cast<std::size_t>(spoiler.kept_frames);
    Retime(motion, [&](std::size_t f) {
      const std::size_t from = f / step * step, to = std::min(from + step, last);
      return Moment{from, to, to > from ? static_cast<double>(f - from) / static_cast<double>(to - from) : 0};
    });
  }
  if (spoiler.late_ms > 0) {
    const double late = spoiler.late_ms / kMsPerSecond * truth.rate_hz;
    Retime(motion, [&](std::size_t f) {
      const double at = std::max(0.0, static_cast<double>(f) - late);
      const auto from = static_cast<std::size_t>(at);
      return Moment{from, std::min(from + 1, last), at - static_cast<double>(from)};
    });
  }
  if (spoiler.frozen_share > 0) {
    const std::size_t still = std::min(begin_of(spoiler.frozen_share), last);
    Retime(motion, [&](std::size_t f) { return Moment{std::min(f, still), std::min(f, still), 0}; });
  }
  return motion;
}

}  // namespace etude
