#include "sim/skeleton_sensor/live_sensor.h"

#include <algorithm>
#include <cassert>
#include <glm/glm.hpp>

#include "engine/base/smoothstep.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {
namespace {

constexpr std::size_t kSpeedReach = 2;           // frames on either side of a frame over which a speed is measured
constexpr std::size_t kFootReach = 5;            // frames on either side over which a foot's largest speed is taken
constexpr double kResting = 0.1, kMoving = 0.6;  // m/s; a foot is at rest below kResting and in motion above kMoving
static_assert(kSpeedReach + kFootReach == MotionWindow::kAhead);

std::size_t Before(std::size_t frame, std::size_t by) { return frame - std::min(frame, by); }

}  // namespace

void MotionWindow::Push(const BodyPose& pose) {
  assert(!ended_ && count_ - next_ <= kAhead);  // the caller must take every known frame before the next Push
  poses_[count_++ % kKept] = pose;
  ComputeSpeeds();
}

void MotionWindow::ComputeSpeeds() {
  for (; speeds_ + (ended_ ? 0 : kSpeedReach) < count_; ++speeds_) {
    const std::size_t before = Before(speeds_, kSpeedReach), after = std::min(speeds_ + kSpeedReach, count_ - 1);
    const double seconds = static_cast<double>(after - before) / rate_hz_;
    JointSpeeds& speeds = frame_speeds_[speeds_ % kKept];
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const double distance = glm::distance(PoseAt(after).joints[j], PoseAt(before).joints[j]);
      speeds[j] = after == before ? 0 : distance / seconds;
    }
  }
}

std::optional<MotionWindow::Known> MotionWindow::Next() {
  if (ended_) ComputeSpeeds();
  if (next_ + (ended_ ? 0 : kAhead) >= count_) return std::nullopt;
  const std::size_t frame = next_++;
  Known known{PoseAt(frame), {.speeds = frame_speeds_[frame % kKept], .moves = {}}};
  known.motion.moves.fill(1);
  const std::size_t last = std::min(frame + kFootReach, count_ - 1);
  // Rate each foot by the foot's largest speed within kFootReach frames: 0 at rest, 1 in motion.
  for (const Role role : AllRoles()) {
    if (GroupOf(role) != JointGroup::kFeet) continue;
    double fastest = 0;
    for (std::size_t t = Before(frame, kFootReach); t <= last; ++t) {
      fastest = std::max(fastest, frame_speeds_[t % kKept][Index(role)]);
    }
    known.motion.moves[Index(role)] = Smoothstep(kResting, kMoving, fastest);
  }
  return known;
}

}  // namespace etude
