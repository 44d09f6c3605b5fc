#include "engine/transitions/fillers/gap_library.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kVelocity_s = 0.1;  // a velocity counts as the distance covered in this time
constexpr double kReach_m = 0.3;     // a rotation counts as the path of a point this far from the axis

/// Appends the features of a pose in the root's frame: the joints' positions, the vertical direction, and the root's
/// height. Vertical direction and height each have the weight of all positions together.
void AppendSeen(const JointTree& tree, const TreePose& pose, std::vector<double>& seen) {
  std::vector<glm::dvec3> points;
  std::vector<glm::dquat> turns;
  AppendGlobals(tree, pose, points, turns);
  const glm::dquat back = glm::conjugate(pose.turns.front());
  const double all = std::sqrt(static_cast<double>(tree.size()));
  for (glm::dvec3& point : points) point = back * (point - pose.root);
  points.front() = all * kReach_m * (back * glm::dvec3(0, 1, 0));
  for (const glm::dvec3& point : points) seen.insert(seen.end(), {point.x, point.y, point.z});
  seen.push_back(all * pose.root.y);
}

/// Returns the rotation about the vertical axis that is nearest to `turn`.
glm::dquat HeadingOf(const glm::dquat& turn) {
  const double length = std::hypot(turn.w, turn.y);
  return length > 0 ? glm::dquat(turn.w / length, 0, turn.y / length, 0) : glm::dquat(1, 0, 0, 0);
}

/// The root's displacement (m) and rotation (times kReach_m) from one frame to another, in the first frame's root
/// frame.
struct RootWay {
  glm::dvec3 way, turn;
  RootWay(const TreePose& from, const TreePose& to)
      : way(glm::conjugate(from.turns.front()) * (to.root - from.root)),
        turn(kReach_m * RotationVector(glm::conjugate(from.turns.front()) * to.turns.front())) {}

  double SquareTo(const RootWay& other) const {
    const glm::dvec3 a = way - other.way, b = turn - other.turn;
    return glm::dot(a, a) + glm::dot(b, b);
  }
};

}  // namespace

void GapLibrary::Add(TreeMotion motion) {
  Entry entry{std::move(motion), {}};
  for (const TreePose& pose : entry.motion.poses) AppendSeen(entry.motion.tree, pose, entry.seen);
  entries_.push_back(std::move(entry));
}

template <typename Visit>
void GapLibrary::ForEachNear(const Gap& gap, double& limit, const Visit& visit) const {
  // Compute the features of the frames around the gap.
  const TreePose &before = gap.past[gap.past.size() - 2], &last = gap.past.back(), &next = gap.future.front();
  std::vector<double> at_before, at_last, at_next;
  AppendSeen(gap.tree, before, at_before);
  AppendSeen(gap.tree, last, at_last);
  AppendSeen(gap.tree, next, at_next);
  const RootWay way(last, next), step(before, last);
  const std::size_t size = at_last.size(), ahead = gap.frames + 1;
  const double joints = static_cast<double>(gap.tree.size()), per_step = kVelocity_s * gap.rate_hz;
  const double velocity_weight = per_step * per_step;

  // Compare with every gap of every motion; stop adding up a distance when it exceeds the limit.
  for (const Entry& entry : entries_) {
    if (!entry.motion.tree.IsLike(gap.tree) || entry.motion.rate_hz != gap.rate_hz) continue;
    const std::vector<TreePose>& poses = entry.motion.poses;
    for (std::size_t f = 1; f + ahead < poses.size(); ++f) {
      const double *seen = &entry.seen[f * size], *seen_before = seen - size, *seen_next = seen + ahead * size;
      const double most = joints * limit;
      double sum = 0;
      for (std::size_t i = 0; i < size && sum < most; ++i) {
        const double first = seen[i] - at_last[i], second = seen_next[i] - at_next[i];
        const double change = (seen[i] - seen_before[i]) - (at_last[i] - at_before[i]);
        sum += first * first + second * second + velocity_weight * change * change;
      }
      if (sum < most) sum += joints * way.SquareTo({poses[f], poses[f + ahead]});
      if (sum < most) sum += joints * velocity_weight * step.SquareTo({poses[f - 1], poses[f]});
      if (sum < most) visit(Near{&entry, f, sum / joints});
    }
  }
}

void GapLibrary::AddMissed(const Gap& gap, const Near& near, Fill fill, double share, std::vector<TreePose>& filled) {
  const std::span<const TreePose> poses = near.entry->motion.poses;
  const std::size_t after = near.frame + gap.frames + 1;
  // Fill the library's gap `near` with `fill`, as if its frames were missing.
  const Gap own{.tree = gap.tree,
                .past = poses.first(near.frame + 1),
                .future = poses.subspan(after, std::min(gap.future.size(), poses.size() - after)),
                .frames = gap.frames,
                .rate_hz = gap.rate_hz};
  const std::vector<TreePose> guess = fill(own);
  // Compute the errors from the true frames. Rotate the errors to this gap's heading, and add them.
  const glm::dquat heading = HeadingOf(gap.past.back().turns[0] * glm::conjugate(poses[near.frame].turns[0]));
  for (std::size_t f = 0; f < filled.size(); ++f) {
    const TreePose& truth = poses[near.frame + 1 + f];
    filled[f].root += share * (heading * (truth.root - guess[f].root));
    for (std::size_t j = 0; j < gap.tree.size(); ++j) {
      const glm::dvec3 missed = RotationVector(glm::conjugate(guess[f].turns[j]) * truth.turns[j]);
      filled[f].turns[j] = filled[f].turns[j] * TurnOf(share * missed);
    }
  }
}

std::vector<TreePose> GapLibrary::FillLikeNearest(const Gap& gap, Fill fill) const {
  double limit = std::numeric_limits<double>::infinity();
  Near nearest;
  ForEachNear(gap, limit, [&](const Near& near) {
    nearest = near;
    limit = near.squared;
  });
  if (nearest.entry == nullptr) return {};
  std::vector<TreePose> filled = fill(gap);
  AddMissed(gap, nearest, fill, 1, filled);
  return filled;
}

std::vector<TreePose> GapLibrary::FillLikeNear(const Gap& gap, Fill fill) const {
  constexpr double kWidth_m = 0.12, kFarthest_m = 3 * kWidth_m, kNothing = 2;
  const std::size_t apart = gap.frames / 2;
  // Of gaps that overlap by more than half, keep only the nearest.
  std::vector<Near> kept;
  double limit = kFarthest_m * kFarthest_m;
  ForEachNear(gap, limit, [&](const Near& near) {
    const bool overlaps = !kept.empty() && kept.back().entry == near.entry && near.frame - kept.back().frame < apart;
    if (!overlaps) return kept.push_back(near);
    if (near.squared < kept.back().squared) kept.back() = near;
  });
  // Average the errors with Gaussian weights, together with an error of zero that has the weight kNothing.
  const auto weight = [](const Near& near) { return std::exp(-near.squared / (2 * kWidth_m * kWidth_m)); };
  double weights = kNothing;
  for (const Near& near : kept) weights += weight(near);
  std::vector<TreePose> filled = fill(gap);
  for (const Near& near : kept) AddMissed(gap, near, fill, weight(near) / weights, filled);
  return filled;
}

}  // namespace etude
