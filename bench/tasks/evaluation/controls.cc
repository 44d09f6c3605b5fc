#include "bench/tasks/evaluation/controls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bench/metrics/beat_alignment.h"

namespace etude {

std::vector<bool> ContactsByMotion(const RawMotion& motion) {
  constexpr double kAnkle_m = 0.12, kToes_m = 0.05, kSlow_m_s = 0.2, kHalfWindow_s = 1.0 / 15;
  constexpr std::array<Role, kFootContacts> kFeet = {Role::kLeftAnkle, Role::kLeftFoot, Role::kRightAnkle,
                                                     Role::kRightFoot};
  const std::size_t frames = motion.FrameCount();
  const auto reach = static_cast<std::size_t>(std::max(1L, std::lround(kHalfWindow_s * motion.rate_hz)));
  std::vector<bool> contacts(frames * kFootContacts);
  for (std::size_t k = 0; k < kFootContacts; ++k) {
    const int joint = motion.roles[Index(kFeet[k])];
    if (joint < 0) return {};
    for (std::size_t f = 0; f < frames; ++f) {
      const std::size_t from = f < reach ? 0 : f - reach, to = std::min(f + reach, frames - 1);
      const glm::dvec3 way =
          motion.At(to, static_cast<std::size_t>(joint)) - motion.At(from, static_cast<std::size_t>(joint));
      const double seconds = static_cast<double>(to - from) / motion.rate_hz;
      const bool is_slow = glm::length(glm::dvec2(way.x, way.z)) < kSlow_m_s * seconds;  // false for NaN
      const bool is_low = motion.At(f, static_cast<std::size_t>(joint)).y < (k % 2 == 0 ? kAnkle_m : kToes_m);
      contacts[f * kFootContacts + k] = is_slow && is_low;
    }
  }
  return contacts;
}

EvaluationSideData SideDataOf(const MatchedMotions& matched, EvaluationSideData given) {
  const PointTracks& truth = matched.pair.truth;
  if (!given.music_beats_s) given.music_beats_s = MotionBeats(truth, matched.pair.rate_hz);
  if (given.statistics) return given;
  constexpr double kLeast_m = 0.01;
  StatisticsByJoint& statistics = given.statistics.emplace();
  for (std::size_t j = 0; j < truth.points; ++j) {
    glm::dvec3 sum(0), squares(0);
    double count = 0;
    for (std::size_t f = 0; f < truth.FrameCount(); ++f) {
      const glm::dvec3& p = truth.Frame(f)[j];
      if (!IsSeen(p)) continue;
      sum += p;
      squares += p * p;
      ++count;
    }
    if (count == 0) continue;
    const glm::dvec3 mean = sum / count, variance = glm::max(squares / count - mean * mean, glm::dvec3(0));
    statistics[matched.joints[j]] = {mean, glm::max(glm::sqrt(variance), glm::dvec3(kLeast_m))};
  }
  return given;
}

void HideWorst(RawMotion& answer, const RawMotion& truth, double percent) {
  if (percent <= 0) return;
  std::vector<std::size_t> order(answer.positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> errors;
  for (const std::size_t i : order) {
    const double error = glm::distance(answer.positions[i], truth.positions[i]);
    errors.push_back(std::isnan(error) ? -1 : error);
  }
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
  order.resize(static_cast<std::size_t>(percent / 100 * static_cast<double>(order.size())));
  for (const std::size_t i : order) answer.positions[i] = NotSeen();
}

}  // namespace etude
