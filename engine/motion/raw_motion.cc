#include "engine/motion/raw_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/text.h"

namespace etude {
namespace {

constexpr double kSameFrame = 1e-6;  // in frames; a tolerance for rounding errors if both rates are equal

/// Returns the position of a joint at the fraction `u` of the way from the frame `from` to the next
/// (Inbetween::kCubic).
glm::dvec3 CubicAt(const RawMotion& motion, std::size_t from, double u, std::size_t joint) {
  const glm::dvec3 &b = motion.At(from, joint), &c = motion.At(from + 1, joint);
  glm::dvec3 a = from > 0 ? motion.At(from - 1, joint) : NotSeen();
  glm::dvec3 d = from + 2 < motion.FrameCount() ? motion.At(from + 2, joint) : NotSeen();
  if (!IsSeen(a) && !IsSeen(d)) return b + u * (c - b);
  if (!IsSeen(a)) a = 3.0 * (b - c) + d;
  if (!IsSeen(d)) d = 3.0 * (c - b) + a;
  return b + 0.5 * u * (c - a + u * (2.0 * a - 5.0 * b + 4.0 * c - d + u * (3.0 * (b - c) + d - a)));
}

}  // namespace

void RawMotion::Doubt(const std::string& text) {
  if (text.empty() || std::ranges::find(doubts, text) != doubts.end()) return;
  doubts.push_back(text);
  if (std::ranges::find(notes, text) == notes.end()) notes.push_back(text);
}

int RawMotion::Find(std::string_view joint) const {
  if (const auto role = FindRole(joint)) return roles[Index(*role)];
  const auto found =
      std::ranges::find_if(joints, [&](const std::string& other) { return EqualsIgnoringCase(other, joint); });
  return found == joints.end() ? -1 : static_cast<int>(found - joints.begin());
}

void AddMidwayHips(RawMotion& raw) {
  const int left = raw.roles[Index(Role::kLeftHip)], right = raw.roles[Index(Role::kRightHip)];
  if (left < 0 || right < 0) return;
  const std::size_t joints = raw.joints.size(), frames = raw.FrameCount();
  // Copy each frame and add the new joint.
  std::vector<glm::dvec3> positions;
  positions.reserve(frames * (joints + 1));
  std::vector<glm::dquat> rotations;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) positions.push_back(raw.At(f, j));
    positions.push_back(0.5 * (raw.At(f, left) + raw.At(f, right)));
    if (raw.rotations.empty()) continue;
    rotations.insert(rotations.end(), raw.rotations.begin() + static_cast<std::ptrdiff_t>(f * joints),
                     raw.rotations.begin() + static_cast<std::ptrdiff_t>((f + 1) * joints));
    const int carrier = raw.parents[left];
    rotations.push_back(carrier < 0 ? glm::dquat(1, 0, 0, 0) : raw.rotations[f * joints + carrier]);
  }
  raw.positions = std::move(positions);
  raw.rotations = std::move(rotations);
  raw.roles[Index(Role::kHipCentre)] = static_cast<int>(joints);
  raw.added.push_back(static_cast<int>(joints));
  raw.joints.emplace_back(kMidwayHips);
  if (raw.parents.empty()) return;
  const int carrier = raw.parents[left];
  raw.parents.push_back(carrier);
  if (raw.rotations.empty()) return;
  raw.rest_positions.push_back(0.5 * (raw.rest_positions[left] + raw.rest_positions[right]));
  raw.rest_rotations.push_back(carrier < 0 ? glm::dquat(1, 0, 0, 0) : raw.rest_rotations[carrier]);
}

bool HasOwnRoot(const RawMotion& motion) {
  const int root = motion.roles[Index(Role::kHipCentre)];
  return root >= 0 && std::ranges::find(motion.added, root) == motion.added.end();
}

glm::dvec3 NotSeen() { return glm::dvec3(std::numeric_limits<double>::quiet_NaN()); }

RawMotion AtFrames(const RawMotion& motion, std::span<const double> times, double rate_hz, Inbetween inbetween) {
  RawMotion sampled = motion;
  const std::size_t joints = motion.joints.size(), frames = motion.FrameCount(), count = times.size();
  sampled.rate_hz = rate_hz;
  sampled.positions.assign(count * joints, NotSeen());
  if (!motion.rotations.empty()) sampled.rotations.assign(count * joints, glm::dquat(1, 0, 0, 0));
  if (!motion.contacts.empty()) sampled.contacts.assign(count * kFootContacts, false);
  for (std::size_t i = 0; i < count; ++i) {
    // Find the two frames around this time.
    double at = times[i];
    if (std::abs(at - std::round(at)) < kSameFrame) at = std::round(at);
    if (at < 0 || at > static_cast<double>(frames) - 1) continue;
    const auto from = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(from);
    const std::size_t to = part > 0 ? from + 1 : from, near = part > 0.5 ? to : from;
    for (std::size_t k = 0; k < kFootContacts && !motion.contacts.empty(); ++k) {
      sampled.contacts[i * kFootContacts + k] = motion.contacts[near * kFootContacts + k];
    }
    for (std::size_t j = 0; j < joints; ++j) {
      const glm::dvec3 &a = motion.At(from, j), &b = motion.At(to, j);
      const bool is_cubic = part > 0 && inbetween == Inbetween::kCubic;
      sampled.positions[i * joints + j] = is_cubic ? CubicAt(motion, from, part, j) : part > 0 ? a + part * (b - a) : a;
      if (motion.rotations.empty()) continue;
      const glm::dquat &p = motion.rotations[from * joints + j], &q = motion.rotations[to * joints + j];
      sampled.rotations[i * joints + j] = part > 0 ? glm::slerp(p, q, part) : p;
    }
  }
  return sampled;
}

RawMotion Sampled(const RawMotion& motion, double rate_hz, double start_s, std::size_t count) {
  std::vector<double> frames;
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back((start_s + static_cast<double>(i) / rate_hz) * motion.rate_hz);
  }
  return AtFrames(motion, frames, rate_hz, Inbetween::kLine);
}

}  // namespace etude
