#include "engine/transitions/fillers/gap_library.h"

#include <cmath>
#include <limits>

#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {
namespace {

constexpr double kVelocity_s = 0.1;  // a velocity counts like the way that it leads in this time
constexpr double kReach_m = 0.3;     // a rotation counts like the way of a point this far from its axis

/// Appends the features of a pose, in the root's frame: the joints' positions, the vertical direction, and the root's
/// height. Direction and height weigh as much as one position of every joint.
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

/// Returns the rotation about the vertical axis that comes nearest to a turn.
glm::dquat HeadingOf(const glm::dquat& turn) {
  const double length = std::hypot(turn.w, turn.y);
  return length > 0 ? glm::dquat(turn.w / length, 0, turn.y / length, 0) : glm::dquat(1, 0, 0, 0);
}

/// The root's displacement (m) and rotation (times kReach_m) from one frame to another, in the first one's root frame.
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

const GapLibrary::Entry* GapLibrary::FindNearest(const Gap& gap, std::size_t& frame) const {
  const TreePose &before = gap.past[gap.past.size() - 2], &last = gap.past.back(), &next = gap.future.front();
  std::vector<double> at_before, at_last, at_next;
  AppendSeen(gap.tree, before, at_before);
  AppendSeen(gap.tree, last, at_last);
  AppendSeen(gap.tree, next, at_next);
  const RootWay way(last, next), step(before, last);
  const std::size_t size = at_last.size(), ahead = gap.frames + 1;
  const double joints = static_cast<double>(gap.tree.size()), per_step = kVelocity_s * gap.rate_hz;
  const double velocity_weight = per_step * per_step;

  // Compare with every gap of every motion; a sum that exceeds the least is abandoned.
  const Entry* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Entry& entry : entries_) {
    if (!entry.motion.tree.IsLike(gap.tree) || entry.motion.rate_hz != gap.rate_hz) continue;
    const std::vector<TreePose>& poses = entry.motion.poses;
    for (std::size_t f = 1; f + ahead < poses.size(); ++f) {
      const double *seen = &entry.seen[f * size], *seen_before = seen - size, *seen_next = seen + ahead * size;
      double sum = 0;
      for (std::size_t i = 0; i < size && sum < least; ++i) {
        const double first = seen[i] - at_last[i], second = seen_next[i] - at_next[i];
        const double change = (seen[i] - seen_before[i]) - (at_last[i] - at_before[i]);
        sum += first * first + second * second + velocity_weight * change * change;
      }
      if (sum < least) sum += joints * way.SquareTo({poses[f], poses[f + ahead]});
      if (sum < least) sum += joints * velocity_weight * step.SquareTo({poses[f - 1], poses[f]});
      if (sum >= least) continue;
      least = sum;
      nearest = &entry;
      frame = f;
    }
  }
  return nearest;
}

std::vector<TreePose> GapLibrary::Fill(const Gap& gap) const {
  std::size_t first = 0;
  const Entry* nearest = FindNearest(gap, first);
  if (nearest == nullptr) return {};
  // Move the library's frames, from the one before the gap to the one after it, to the gap's position and heading.
  const std::vector<TreePose>& poses = nearest->motion.poses;
  const TreePose &last = gap.past.back(), &before = gap.past[gap.past.size() - 2], &next = gap.future.front();
  const glm::dquat heading = HeadingOf(last.turns[0] * glm::conjugate(poses[first].turns[0]));
  const auto placed = [&](std::size_t f) {
    TreePose pose = poses[f];
    pose.root = last.root + heading * (pose.root - poses[first].root);
    pose.turns[0] = heading * pose.turns[0];
    return pose;
  };
  const TreePose own_before = placed(first - 1), own_last = placed(first), own_next = placed(first + gap.frames + 1);
  const double seconds = gap.Seconds();
  std::vector<TreePose> filled;
  for (std::size_t f = 1; f <= gap.frames; ++f) filled.push_back(placed(first + f));

  // Spread the differences at both ends, channel by channel. At the second end the library's velocity is kept.
  const auto spread = [&](const glm::dvec3& at_before, const glm::dvec3& at_last, const glm::dvec3& at_next,
                          const auto& correct) {
    const Movement movement{at_last - at_next, (at_last - at_before) * gap.rate_hz, glm::dvec3(0)};
    for (std::size_t f = 0; f < gap.frames; ++f) {
      const double t = static_cast<double>(f + 1) / gap.rate_hz;
      correct(filled[f], at_next + MinimumJerkAt(movement, t, seconds));
    }
  };
  spread(before.root - own_before.root, last.root - own_last.root, next.root - own_next.root,
         [](TreePose& pose, const glm::dvec3& off) { pose.root += off; });
  for (std::size_t j = 0; j < gap.tree.size(); ++j) {
    const auto off = [&](const TreePose& wanted, const TreePose& own) {
      return RotationVector(glm::conjugate(own.turns[j]) * wanted.turns[j]);
    };
    spread(off(before, own_before), off(last, own_last), off(next, own_next),
           [&](TreePose& pose, const glm::dvec3& turn) { pose.turns[j] = pose.turns[j] * TurnOf(turn); });
  }
  return filled;
}

}  // namespace etude
