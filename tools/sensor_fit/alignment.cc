#include "tools/sensor_fit/alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/nearest_rotation.h"

namespace etude {
namespace {

struct Pair {
  std::size_t joint;
  glm::dvec3 sensed;
  Carrier carrier;
};

std::optional<Carrier> Between(const std::optional<Carrier>& a, const std::optional<Carrier>& b, double share) {
  if (share == 0) return a;
  if (!a || !b) return std::nullopt;
  return Carrier{glm::mix(a->position, b->position, share), glm::slerp(a->rotation, b->rotation, share)};
}

/// Returns the twin's carriers (Carrier in recording.h) at a time on the twin's clock; all are absent before the twin's
/// start and after its end.
std::array<std::optional<Carrier>, kRoleCount> CarriersAt(const TwinMotion& twin, double time_s) {
  const double frame = time_s * twin.rate_hz;
  if (frame < 0 || frame > static_cast<double>(twin.frames.size()) - 1) return {};
  const auto before = static_cast<std::size_t>(frame);
  const std::size_t after = std::min(before + 1, twin.frames.size() - 1);
  std::array<std::optional<Carrier>, kRoleCount> carriers;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    carriers[j] = Between(twin.frames[before][j], twin.frames[after][j], frame - static_cast<double>(before));
  }
  return carriers;
}

/// Returns, for every `stride`-th frame, all pairs of a recorded joint and the joint's carrier.
std::vector<Pair> PairsAt(const JointRecording& recording, const TwinMotion& twin, double shift_s, std::size_t stride) {
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < recording.frames.size(); t += stride) {
    const auto carriers = CarriersAt(twin, recording.TimeOf(t) + shift_s);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      if (recording.frames[t][j] && carriers[j]) pairs.push_back({j, *recording.frames[t][j], *carriers[j]});
    }
  }
  return pairs;
}

/// Finds the rotation and translation that map `from` closest to `to` (Kabsch 1976).
void FitRigid(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to, TwinAlignment& alignment) {
  glm::dvec3 mean_from(0), mean_to(0);
  const auto count = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    mean_from += from[i] / count;
    mean_to += to[i] / count;
  }
  glm::dmat3 sum(0);
  for (std::size_t i = 0; i < from.size(); ++i) sum += glm::outerProduct(to[i] - mean_to, from[i] - mean_from);
  alignment.R_ST = NearestRotationTo(sum).rotation;
  alignment.p_ST = mean_to - alignment.R_ST * mean_from;
}

/// Sets the offset of each joint: the joint's mean position in the frame of the rigid body that carries the joint
/// (Carrier).
void FitOffsets(const std::vector<Pair>& pairs, TwinAlignment& alignment) {
  std::array<glm::dvec3, kRoleCount> sums{};
  std::array<double, kRoleCount> counts{};
  const glm::dmat3 R_TS = glm::transpose(alignment.R_ST);
  for (const Pair& pair : pairs) {
    const glm::dvec3 in_twin = R_TS * (pair.sensed - alignment.p_ST);
    sums[pair.joint] += glm::conjugate(pair.carrier.rotation) * (in_twin - pair.carrier.position);
    ++counts[pair.joint];
  }
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    alignment.offsets[j] = counts[j] > 0 ? std::optional(sums[j] / counts[j]) : std::nullopt;
  }
}

double RootMeanSquare(const std::vector<Pair>& pairs, const TwinAlignment& alignment) {
  double sum = 0;
  for (const Pair& pair : pairs) {
    const glm::dvec3 off = pair.sensed - *alignment.JointAt(pair.carrier, AllRoles()[pair.joint]);
    sum += glm::dot(off, off);
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

/// Fits the rigid motion and the offsets alternately until the residual converges. `alignment` holds the initial
/// values.
void FitAlternately(const std::vector<Pair>& pairs, int max_iterations, TwinAlignment& alignment) {
  constexpr double kSettled = 1e-6;  // metres; smaller changes of the residual end the iteration
  std::vector<glm::dvec3> from(pairs.size()), to(pairs.size());
  alignment.rms_m = 1e300;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const glm::dvec3 offset = alignment.offsets[pairs[i].joint].value_or(glm::dvec3(0));
      from[i] = pairs[i].carrier.position + pairs[i].carrier.rotation * offset;
      to[i] = pairs[i].sensed;
    }
    FitRigid(from, to, alignment);
    FitOffsets(pairs, alignment);
    const double left = RootMeanSquare(pairs, alignment), gain = alignment.rms_m - left;
    alignment.rms_m = left;
    if (std::abs(gain) < kSettled) return;
  }
}

/// Computes the mean joint speed of each frame, over the joints that were seen in this frame and in the frame before.
std::vector<std::optional<double>> Speeds(const JointRecording& recording) {
  std::vector<std::optional<double>> speeds(recording.frames.size());
  for (std::size_t t = 1; t < speeds.size(); ++t) {
    double sum = 0, count = 0;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const auto &a = recording.frames[t - 1][j], &b = recording.frames[t][j];
      if (!a || !b) continue;
      // Limit the influence of a jump: no joint counts as faster than 3 m/s.
      sum += std::min(glm::distance(*a, *b) * recording.rate_hz, 3.0);
      ++count;
    }
    if (count > 0) speeds[t] = sum / count;
  }
  return speeds;
}

/// Returns the twin's carrier positions as a recording at `rate_hz`, for Speeds.
JointRecording AtRate(const TwinMotion& twin, double rate_hz) {
  JointRecording recording{.rate_hz = rate_hz, .frames = {}, .sensor_at = {}};
  const auto frames = static_cast<std::size_t>(twin.DurationSeconds() * rate_hz);
  for (std::size_t t = 0; t < frames; ++t) {
    const auto carriers = CarriersAt(twin, static_cast<double>(t) / rate_hz);
    RolePositions& places = recording.frames.emplace_back();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      if (carriers[j]) places[j] = carriers[j]->position;
    }
  }
  return recording;
}

/// Pearson's correlation of two series over the `n` frames in which both have a value.
struct Correlation {
  double r = 0, n = 0;
};

/// Returns the correlation of a[t] and b[t + lag]; nullopt if the two series overlap for less than a second.
std::optional<Correlation> CorrelationAt(const std::vector<std::optional<double>>& a,
                                         const std::vector<std::optional<double>>& b, long lag, double rate_hz) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (long t = std::max(0L, -lag); t < static_cast<long>(a.size()) && t + lag < static_cast<long>(b.size()); ++t) {
    const auto &x = a[static_cast<std::size_t>(t)], &y = b[static_cast<std::size_t>(t + lag)];
    if (!x || !y) continue;
    ++n;
    sa += *x;
    sb += *y;
    saa += *x * *x;
    sbb += *y * *y;
    sab += *x * *y;
  }
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  if (n < rate_hz || va <= 0 || vb <= 0) return std::nullopt;
  return Correlation{(sab - sa * sb / n) / std::sqrt(va * vb), n};
}

/// Returns two shifts: the one at which speeds have the largest r √n (their correlation r, in its standard deviations
/// by chance), and the one with the largest r. In a short overlap, chance gives a high r; in a long overlap, a motion
/// that repeats gives a high r √n. So either may be wrong. At least half of the shorter recording must overlap.
std::array<double, 2> ShiftsBySpeeds(const JointRecording& recording, const TwinMotion& twin) {
  const auto a = Speeds(recording), b = Speeds(AtRate(twin, recording.rate_hz));
  const long na = static_cast<long>(a.size()), nb = static_cast<long>(b.size()), min_overlap = std::min(na, nb) / 2;
  std::array<double, 2> best;
  best.fill(-std::numeric_limits<double>::infinity());
  std::array<double, 2> shifts{};
  for (long lag = min_overlap - na; lag <= nb - min_overlap; ++lag) {
    const auto found = CorrelationAt(a, b, lag, recording.rate_hz);
    for (std::size_t i = 0; found && i < best.size(); ++i) {
      const double score = i == 0 ? found->r * std::sqrt(found->n) : found->r;
      if (score <= best[i]) continue;
      best[i] = score;
      shifts[i] = static_cast<double>(lag) / recording.rate_hz;
    }
  }
  return shifts;
}

bool IsEnough(const std::vector<Pair>& pairs, const JointRecording& recording, std::size_t stride) {
  std::array<bool, kRoleCount> seen{};
  for (const Pair& pair : pairs) seen[pair.joint] = true;
  const auto joints = std::count(seen.begin(), seen.end(), true);
  return joints >= 3 && static_cast<double>(pairs.size() * stride) >= recording.rate_hz * static_cast<double>(joints);
}

constexpr int kSearchIterations = 8, kFinalIterations = 200;

/// Returns the best alignment for time shifts from `start.shift_s − reach_s` to `start.shift_s + reach_s`.
std::optional<TwinAlignment> BestShift(const JointRecording& recording, const TwinMotion& twin,
                                       const TwinAlignment& start, double reach_s, double step_s) {
  constexpr std::size_t kSearchFrames = 150;
  const std::size_t stride = std::max<std::size_t>(1, recording.frames.size() / kSearchFrames);
  std::optional<TwinAlignment> best;
  const long steps = std::lround(reach_s / step_s);
  for (long i = -steps; i <= steps; ++i) {
    TwinAlignment tried = start;
    tried.shift_s = start.shift_s + static_cast<double>(i) * step_s;
    const auto pairs = PairsAt(recording, twin, tried.shift_s, stride);
    if (!IsEnough(pairs, recording, stride)) continue;
    FitAlternately(pairs, kSearchIterations, tried);
    if (!best || tried.rms_m < best->rms_m) best = tried;
  }
  return best;
}

std::optional<TwinMatch> Finish(const JointRecording& recording, const TwinMotion& twin, TwinAlignment alignment) {
  const auto pairs = PairsAt(recording, twin, alignment.shift_s, 1);
  if (!IsEnough(pairs, recording, 1)) return std::nullopt;
  FitAlternately(pairs, kFinalIterations, alignment);
  TwinMatch match{.alignment = alignment, .truth = {}};
  for (std::size_t t = 0; t < recording.frames.size(); ++t) {
    const auto carriers = CarriersAt(twin, recording.TimeOf(t) + alignment.shift_s);
    RolePositions& places = match.truth.emplace_back();
    for (const Role role : AllRoles()) places[Index(role)] = alignment.JointAt(carriers[Index(role)], role);
  }
  return match;
}

}  // namespace

std::optional<glm::dvec3> TwinAlignment::JointAt(const std::optional<Carrier>& carrier, Role role) const {
  const auto& offset = offsets[Index(role)];
  if (!carrier || !offset) return std::nullopt;
  return R_ST * (carrier->position + carrier->rotation * *offset) + p_ST;
}

std::optional<TwinMatch> AlignTwin(const JointRecording& recording, const TwinMotion& twin) {
  if (recording.frames.empty() || twin.frames.empty()) return std::nullopt;
  // The second shift must fit far better to replace the first.
  constexpr double kFarBetter = 0.7;
  const double frame_s = 1 / recording.rate_hz;
  std::optional<TwinAlignment> coarse;
  for (const double shift_s : ShiftsBySpeeds(recording, twin)) {
    if (coarse && std::abs(coarse->shift_s - shift_s) <= 6 * frame_s) continue;
    TwinAlignment start;
    start.shift_s = shift_s;
    const auto found = BestShift(recording, twin, start, 6 * frame_s, frame_s);
    if (found && (!coarse || found->rms_m < kFarBetter * coarse->rms_m)) coarse = found;
  }
  if (!coarse) return std::nullopt;
  return RealignTwin(recording, twin, *coarse, 1.5 * frame_s);
}

std::optional<double> ChanceRms(const JointRecording& recording, const TwinMotion& twin, const TwinMatch& match) {
  constexpr int kShifts = 16;
  constexpr double kApart_s = 1;
  constexpr std::size_t kMinShifts = 3;
  const double own = static_cast<double>(recording.frames.size()) / recording.rate_hz;
  const double overlap = std::min(own, twin.DurationSeconds()) / 2;
  std::vector<double> rms;
  for (int i = 0; i < kShifts; ++i) {
    TwinAlignment tried = match.alignment;
    tried.shift_s = std::lerp(overlap - own, twin.DurationSeconds() - overlap, (i + 0.5) / kShifts);
    if (std::abs(tried.shift_s - match.alignment.shift_s) < kApart_s) continue;
    if (const auto other = BestShift(recording, twin, tried, 0, 1)) rms.push_back(other->rms_m);
  }
  if (rms.size() < kMinShifts) return std::nullopt;
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::ranges::nth_element(rms, middle);
  return *middle;
}

std::optional<TwinMatch> RealignTwin(const JointRecording& recording, const TwinMotion& twin,
                                     const TwinAlignment& start, double max_shift_s) {
  const double frame_s = 1 / recording.rate_hz;
  const auto near = BestShift(recording, twin, start, max_shift_s, 0.5 * frame_s);
  if (!near) return std::nullopt;
  const auto fine = BestShift(recording, twin, *near, 0.4 * frame_s, 0.1 * frame_s);
  return Finish(recording, twin, fine.value_or(*near));
}

}  // namespace etude
