#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/fault_limits.h"
#include "engine/motion/ground_faults.h"

namespace etude {
namespace {

/// Returns the number of frames in `seconds`, at least `least`.
int FramesIn(const GroundView& ground, double seconds, int least) {
  return std::max(static_cast<int>(std::lround(seconds * ground.motion().rate_hz)), least);
}

constexpr double kStep_s = 1.0 / 15;  ///< time between the centres of successive windows

/// Returns the velocities along the floor, metres per second, of foot joints that may be in stance: joints near their
/// rest height that do not rise or fall, while the body is on its feet. Uses every n-th frame, n = `every`.
std::vector<glm::dvec2> FootVelocities(const GroundView& ground, const FrameRange& span, int every) {
  constexpr double kLow = 0.04, kLevel = 0.3;
  std::vector<glm::dvec2> velocities;
  for (int f = span.first; f <= span.last; f += every) {
    if (!ground.IsOnFeet(f)) continue;
    for (const Role joint : kFootJoints) {
      if (ground.Place(f, joint).y - ground.RestHeight(joint) >= kLow) continue;
      const glm::dvec3 velocity = ground.Velocity(f, joint);
      if (std::abs(velocity.y) < kLevel) velocities.emplace_back(velocity.x, velocity.z);
    }
  }
  return velocities;
}

/// The common velocity along the floor of feet in stance, over a window of frames around one frame.
struct Glide {
  int frame = 0;
  glm::dvec2 velocity{0};
};

/// The rule for a glide: the length of its window, and limits for shares of the velocities in this window.
struct GlideRule {
  double half_s = 0;     ///< half the length of the window, seconds
  double min_share = 0;  ///< minimum share of velocities that are alike
  double max_rest = 0;   ///< maximum share of velocities near 0
};
constexpr GlideRule kShort{0.3, 0.45, 0.12}, kLong{0.6, 0.4, 0.06};

/// Returns the most frequent velocity of the feet around a frame if the whole body glides: enough foot joints share the
/// velocity, and few of them rest (GlideRule).
std::optional<Glide> GlideAround(const GroundView& ground, int frame, const GlideRule& rule) {
  constexpr double kEvery_s = 1.0 / 30, kMinSpeed = 0.11, kRest = 0.35;
  constexpr double kNear = 0.07, kNearShare = 0.12;
  constexpr std::size_t kMinVelocities = 6;
  const int half = FramesIn(ground, rule.half_s, 2), last = ground.frames() - 1;
  const FrameRange window{std::max(frame - half, 0), std::min(frame + half, last)};
  const auto all = FootVelocities(ground, window, FramesIn(ground, kEvery_s, 1));
  if (all.size() < kMinVelocities) return std::nullopt;
  // If too many feet rest, stop: the search below is quadratic and would find nothing.
  const auto still = std::ranges::count_if(all, [](const glm::dvec2& v) { return glm::length(v) < kNear; });
  if (static_cast<double>(still) > rule.max_rest * static_cast<double>(all.size())) return std::nullopt;
  // Find the velocity with the most neighbours, and average its neighbours.
  const auto near = [&](const glm::dvec2& v) {
    const double radius = std::max(kNear, kNearShare * glm::length(v));
    return [v, radius](const glm::dvec2& other) { return glm::distance(v, other) < radius; };
  };
  glm::dvec2 mode{0};
  std::ptrdiff_t most = 0;
  for (const glm::dvec2& v : all) {
    const auto count = std::ranges::count_if(all, near(v));
    if (count <= most) continue;
    most = count;
    mode = v;
  }
  glm::dvec2 mean{0};
  for (const glm::dvec2& v : all) {
    if (near(mode)(v)) mean += v / static_cast<double>(most);
  }
  const double speed = glm::length(mean), rest = std::max(kNear, kRest * speed);
  const auto count = static_cast<double>(all.size());
  const auto resting = std::ranges::count_if(all, [&](const glm::dvec2& v) { return glm::length(v) < rest; });
  if (speed < kMinSpeed || static_cast<double>(most) < rule.min_share * count) return std::nullopt;
  if (static_cast<double>(resting) > rule.max_rest * count) return std::nullopt;
  return Glide{frame, mean};
}

/// Appends a skate from the first to the last of `glides` if it lasts long enough.
void AppendSkate(const GroundView& ground, const std::vector<Glide>& glides, std::vector<MotionFault>& faults) {
  constexpr double kMargin_s = 0.15, kMinShare = 0.25, kShare = 0.1;
  // Each glide's window extends beyond its frame, so extend the skate at both ends by a part of the window.
  const int margin = FramesIn(ground, kMargin_s, 0), step = FramesIn(ground, kStep_s, 1), end = ground.frames() - 1;
  const int first = glides.front().frame <= step ? 0 : std::max(glides.front().frame - margin, 0);
  const int last = glides.back().frame >= end - step ? end : std::min(glides.back().frame + margin, end);
  if ((last - first) / ground.motion().rate_hz < fault_limits::kGlide_s) return;
  // Start from the median glide, and refine it to the feet's most frequent velocity (mean shift).
  std::vector<double> x, z;
  for (const Glide& glide : glides) {
    x.push_back(glide.velocity.x);
    z.push_back(glide.velocity.y);
  }
  glm::dvec2 velocity(Median(x), Median(z));
  const std::vector<glm::dvec2> all = FootVelocities(ground, {first, last}, 1);
  double share = 0;
  for (const double width : {0.2, 0.12, 0.08, 0.08, 0.08}) {
    const double radius = std::max(width, kShare * glm::length(velocity));
    glm::dvec2 sum{0};
    int count = 0;
    for (const glm::dvec2& v : all) {
      if (glm::distance(v, velocity) >= radius) continue;
      sum += v;
      ++count;
    }
    constexpr int kMinCount = 3;
    if (count < kMinCount) break;
    share = count / static_cast<double>(all.size());
    velocity = sum / static_cast<double>(count);
  }
  if (glm::length(velocity) < fault_limits::kGlide_m_s || share < kMinShare) return;
  faults.push_back(ground.FaultOf(FaultKind::kSkates, {first, last}, glm::length(velocity)));
}

/// Returns true if more of the foot joints that may be in stance move at about `velocity` than are at rest.
bool Carries(const GroundView& ground, const FrameRange& span, const glm::dvec2& velocity) {
  constexpr double kNear = 0.07, kNearShare = 0.3, kRest = 0.5;
  const double near = std::max(kNear, kNearShare * glm::length(velocity));
  const double rest = std::max(kNear, kRest * glm::length(velocity));
  int carried = 0, resting = 0;
  for (const glm::dvec2& v : FootVelocities(ground, span, 1)) {
    carried += glm::distance(v, velocity) < near ? 1 : 0;
    resting += glm::length(v) < rest ? 1 : 0;
  }
  return carried > resting;
}

/// Appends the skates that begin with a step of the body's velocity and end with the opposite step. Returns the frames
/// within these skates.
std::vector<bool> FindCarried(const GroundView& ground, std::vector<MotionFault>& faults) {
  constexpr double kAlike = 0.3, kAlike_m_s = 0.03;
  std::vector<bool> is_carried(ground.frames());
  const std::vector<VelocityStep>& steps = ground.velocity_steps();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t k = i + 1; k < steps.size(); ++k) {
      const FrameRange span{steps[i].frame, steps[k].frame};
      const double seconds = ground.Seconds(span), size = glm::length(steps[i].change);
      if (seconds < fault_limits::kMinCarried_s || is_carried[span.first]) continue;
      if (seconds > fault_limits::kMaxCarried_s) break;
      if (glm::distance(steps[i].change, -steps[k].change) > kAlike * size + kAlike_m_s) continue;
      const glm::dvec2 velocity = 0.5 * (steps[i].change - steps[k].change);
      if (glm::length(velocity) < fault_limits::kStep_m_s || !Carries(ground, span, velocity)) continue;
      faults.push_back(ground.FaultOf(FaultKind::kSkates, span, glm::length(velocity)));
      for (int f = span.first; f <= span.last; ++f) is_carried[f] = true;
    }
  }
  return is_carried;
}

/// Appends the stretches in which one foot glides over the floor: its toes and ankle are low and move alike, for a long
/// time or at constant velocity. Stretches within known skates are skipped.
void FindFootSkates(const GroundView& ground, std::span<const JointSet> unseen, std::vector<MotionFault>& faults) {
  constexpr double kLow = 0.04, kLevel = 0.3, kNear = 0.07, kNearShare = 0.2;
  constexpr double kConstant = 0.15;
  const std::size_t known = faults.size();
  const double rate = ground.motion().rate_hz;
  for (const auto& [ankle, toes] :
       {std::pair(Role::kLeftAnkle, Role::kLeftFoot), {Role::kRightAnkle, Role::kRightFoot}}) {
    // Find the frames in which the foot glides, and its velocity in each.
    std::vector<bool> glides(ground.frames());
    std::vector<glm::dvec2> velocities(ground.frames());
    for (int f = 0; f < ground.frames(); ++f) {
      const auto is_low = [&, f](Role joint) { return ground.Place(f, joint).y - ground.RestHeight(joint) < kLow; };
      const bool is_seen = unseen.empty() || !(unseen[f][Index(ankle)] || unseen[f][Index(toes)]);
      if (!is_seen || !is_low(ankle) || !is_low(toes) || !ground.IsOnFeet(f)) continue;
      const glm::dvec3 a = ground.Velocity(f, ankle), b = ground.Velocity(f, toes);
      velocities[f] = 0.5 * glm::dvec2(a.x + b.x, a.z + b.z);
      const double speed = glm::length(velocities[f]), apart = glm::length(glm::dvec2(a.x - b.x, a.z - b.z));
      glides[f] = std::abs(a.y) < kLevel && std::abs(b.y) < kLevel && speed > fault_limits::kFootSkate_m_s &&
                  apart < std::max(kNear, kNearShare * speed);
    }
    for (const FrameRange& span : RangesOf(glides)) {
      const double seconds = ground.Seconds(span);
      std::vector<double> x, z;
      for (int f = span.first; f <= span.last; ++f) {
        x.push_back(velocities[f].x);
        z.push_back(velocities[f].y);
      }
      const glm::dvec2 middle(Median(x), Median(z));
      double farthest = 0;
      for (int f = span.first; f <= span.last; ++f) farthest = std::max(farthest, glm::distance(velocities[f], middle));
      const bool is_constant = farthest < kConstant * glm::length(middle);
      const bool is_known = std::any_of(faults.begin(), faults.begin() + static_cast<std::ptrdiff_t>(known),
                                        [&](const MotionFault& fault) {
                                          return fault.kind == FaultKind::kSkates && fault.from_s * rate <= span.last &&
                                                 fault.to_s * rate >= span.first;
                                        });
      if (is_known || seconds < (is_constant ? fault_limits::kEvenFootSkate_s : fault_limits::kFootSkate_s) ||
          glm::length(middle) < fault_limits::kFootSkate_m_s)
        continue;
      faults.push_back(ground.FaultOf(FaultKind::kSkates, span, glm::length(middle)));
      faults.back().joint = toes;
    }
  }
}

}  // namespace

void FindSkates(const GroundView& ground, std::span<const JointSet> unseen, std::vector<MotionFault>& faults) {
  constexpr double kMaxGap_s = 1, kAlike = 0.1, kAlikeShare = 0.3;
  const int step = FramesIn(ground, kStep_s, 1), near = FramesIn(ground, kLong.half_s, 1);
  const std::vector<bool> is_carried = FindCarried(ground, faults);
  const auto is_near_carried = [&](int frame) {
    const auto from = is_carried.begin() + std::max(frame - near, 0);
    const auto to = is_carried.begin() + std::min(frame + near + 1, ground.frames());
    return std::find(from, to, true) != to;
  };
  // Join consecutive glides of nearly the same velocity; in between, feet may leave the floor.
  std::vector<Glide> glides;
  for (int f = 0; f < ground.frames(); f += step) {
    if (is_near_carried(f)) continue;
    auto glide = GlideAround(ground, f, kShort);
    if (!glide) glide = GlideAround(ground, f, kLong);
    if (!glide) continue;
    const double alike = std::max(kAlike, kAlikeShare * glm::length(glide->velocity));
    const bool goes_on = !glides.empty() && (f - glides.back().frame) / ground.motion().rate_hz < kMaxGap_s &&
                         glm::distance(glides.back().velocity, glide->velocity) < alike;
    if (!goes_on && !glides.empty()) {
      AppendSkate(ground, glides, faults);
      glides.clear();
    }
    glides.push_back(*glide);
  }
  if (!glides.empty()) AppendSkate(ground, glides, faults);
  FindFootSkates(ground, unseen, faults);
}

}  // namespace etude
