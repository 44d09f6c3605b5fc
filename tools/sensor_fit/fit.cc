#include "tools/sensor_fit/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "engine/base/angles.h"
#include "engine/document/fields.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {
namespace {

/// Returns the motion of the twin (the optical recording of the same motion), with a position for every joint in every
/// frame. A joint that the twin does not show in a frame keeps its last position; before its first position, the joint
/// is at its first position.
BodyMotion WholeMotion(const RealRecording& real) {
  BodyMotion motion{.rate_hz = real.recording.rate_hz, .poses = std::vector<BodyPose>(real.match.truth.size())};
  for (const Role role : AllRoles()) {
    const std::size_t j = Index(role);
    std::optional<glm::dvec3> last;
    for (std::size_t t = 0; t < motion.poses.size() && !last; ++t) last = real.match.truth[t][j];
    const auto parent = ParentOf(role);
    for (std::size_t t = 0; t < motion.poses.size(); ++t) {
      if (real.match.truth[t][j]) last = real.match.truth[t][j];
      // A joint that the twin never shows is not compared; put this joint where it cannot occlude other joints.
      motion.poses[t].joints[j] = last ? *last : parent ? motion.poses[t][*parent] : glm::dvec3(0, 0, 1);
    }
  }
  return motion;
}

/// Low-pass filters the twin's motion at 6 Hz (−3 dB, Gaussian), as is usual in biomechanics for optical recordings.
/// Faster components are the twin's own noise; without the filter, the simulated sensor would reproduce this noise as
/// motion.
BodyMotion WithoutShiver(const BodyMotion& motion) {
  constexpr double kPassHz = 6;
  const double deviation_s = std::sqrt(std::log(2.0)) / (2 * kPi * kPassHz);
  constexpr long kReach = 4;
  BodyMotion smooth = motion;
  const long count = static_cast<long>(motion.poses.size());
  for (long t = 0; t < count; ++t) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      glm::dvec3 sum(0);
      double weights = 0;
      // Average over equally many frames before and after, so that the filter has no lag near the ends.
      const long reach = std::min({kReach, t, count - 1 - t});
      for (long d = -reach; d <= reach; ++d) {
        const double off = static_cast<double>(d) / motion.rate_hz / deviation_s;
        const double weight = std::exp(-0.5 * off * off);
        sum += weight * motion.poses[static_cast<std::size_t>(t + d)].joints[j];
        weights += weight;
      }
      smooth.poses[static_cast<std::size_t>(t)].joints[j] = sum / weights;
    }
  }
  return smooth;
}

Camera SensorOf(const RealRecording& real, const BodyMotion& motion, const Intrinsics& view) {
  if (real.recording.sensor_at)
    return LookAt(view, *real.recording.sensor_at, *real.recording.sensor_at + glm::dvec3(0, 0, 1));
  const BodyPose& pose = motion.poses[motion.poses.size() / 2];
  const glm::dvec3 body = pose[Role::kHipCentre];
  const SensorPlacement usual;
  const glm::dvec3 eye = body + usual.distance * Facing(pose);
  return LookAt(view, eye, body);
}

constexpr WorldKey kFitWorlds{.suite_seed = 1, .scenario = "sensor-fit", .trial = 0};

/// The settings that are at a bound after a step, as messages list them.
using Bounds = std::vector<std::string>;

/// Multiplies `value` by real ÷ simulated, limited to 1/3…3, and clamps the product to the range that the fit allows.
/// If the range limits the value, adds `name` to `bounds`.
void Scale(const std::string& name, double& value, const std::optional<double>& real,
           const std::optional<double>& simulated, Range allowed, Bounds& bounds) {
  if (!real || !simulated || *real <= 0 || *simulated <= 0) return;
  constexpr double kMaxFactor = 3;
  const double wanted = value * std::clamp(*real / *simulated, 1 / kMaxFactor, kMaxFactor);
  value = std::clamp(wanted, allowed.lowest, allowed.highest);
  if (value != wanted) bounds.push_back(fmt::format("{} {:g}", name, value));
}

void FitGroups(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor,
               Bounds& bounds) {
  for (const JointGroup group : AllJointGroups()) {
    const std::size_t g = Index(group);
    const std::string of = fmt::format("groups.{}.", GroupName(group));
    if (group != JointGroup::kFeet)
      Scale(of + "size_m", sensor[group].size, real.error_mm[g], simulated.error_mm[g], {0.001, 0.5}, bounds);
    Scale(of + "depth_ratio", sensor[group].depth_ratio, real.depth_ratio[g], simulated.depth_ratio[g], {0.2, 5},
          bounds);
  }
  Scale("planted_feet_m", sensor.planted_feet, real.planted_feet_mm, simulated.planted_feet_mm, {0.0001, 0.1}, bounds);
}

void FitCorrelations(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor) {
  constexpr double kStep = 0.8, kMaxCorrelation = 0.98;
  for (std::size_t b = 0; b < kBoneKindCount; ++b) {
    if (!real.correlation[b] || !simulated.correlation[b]) continue;
    double& rho = sensor.correlation[b];
    rho = std::clamp(rho + kStep * (*real.correlation[b] - *simulated.correlation[b]), -kMaxCorrelation,
                     kMaxCorrelation);
  }
}

void FitQuiet(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor,
              Bounds& bounds) {
  if (!real.quiet_white_mm || !simulated.quiet_white_mm || *simulated.quiet_white_mm <= 0) return;
  for (const JointGroup group : AllJointGroups()) {
    Scale(fmt::format("groups.{}.white_m", GroupName(group)), sensor[group].white, real.quiet_white_mm,
          simulated.quiet_white_mm, {0, 0.05}, bounds);
  }
  Scale("fast_quiet", sensor.fast_quiet, real.quiet_white_mm, simulated.quiet_white_mm, {0, 1}, bounds);
}

void FitFastPart(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor,
                 Bounds& bounds) {
  Scale("fast_share", sensor.fast_share, real.hand_jump_cm, simulated.hand_jump_cm, {0.01, 0.8}, bounds);
}

void FitStretch(const SensorStatistics& real, const SensorStatistics& simulated, SkeletonSensorOptions& sensor,
                Bounds& bounds) {
  constexpr Range kStretch{0.02, 4};
  Scale("arm_stretch", sensor.arm_stretch, real.arm_bones_percent, simulated.arm_bones_percent, kStretch, bounds);
  Scale("shoulder_stretch", sensor.shoulder_stretch, real.shoulder_width_percent, simulated.shoulder_width_percent,
        kStretch, bounds);
  Scale("hand_stretch", sensor.hand_stretch, real.hand_bones_percent, simulated.hand_bones_percent, kStretch, bounds);
}

double MeanDistance(const RealRecording& real) {
  double sum = 0, count = 0;
  for (const RolePositions& places : real.match.truth) {
    const auto& centre = places[Index(Role::kSpine)];
    if (!centre || !real.recording.sensor_at) continue;
    sum += std::abs(centre->z - real.recording.sensor_at->z);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Returns the mean over frames of the joints' RMS distance from their middle. `place` gives the position of a joint in
/// a frame, if there is one.
template <typename PlaceOf>
double SizeOf(std::size_t frames, const PlaceOf& place) {
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < frames; ++t) {
    glm::dvec3 middle(0);
    double squares = 0, joints = 0;
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const std::optional<glm::dvec3> at = place(t, j);
      if (!at) continue;
      middle += *at;
      squares += glm::dot(*at, *at);
      ++joints;
    }
    if (joints < 3) continue;
    middle /= joints;
    sum += std::sqrt(std::max(0.0, squares / joints - glm::dot(middle, middle)));
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Returns the RMS distance of the joints from their mean positions, metres.
double MovementOf(const std::vector<RolePositions>& frames) {
  double squares = 0, count = 0;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    glm::dvec3 sum(0);
    double own = 0, seen = 0;
    for (const RolePositions& places : frames) {
      if (!places[j]) continue;
      sum += *places[j];
      own += glm::dot(*places[j], *places[j]);
      ++seen;
    }
    if (seen > 0) squares += own - glm::dot(sum, sum) / seen;
    count += seen;
  }
  return count > 0 ? std::sqrt(std::max(0.0, squares / count)) : 0;
}

}  // namespace

std::optional<RealRecording> MakeRealRecording(JointRecording recording, TwinMotion twin) {
  auto match = AlignTwin(recording, twin);
  if (!match) return std::nullopt;
  return RealRecording{std::move(recording), std::move(twin), *std::move(match)};
}

namespace {

/// Describes clocks that run at different speeds: each half of the recording fits the twin clearly better than the
/// whole does, at its own shift in time. Returns "" if they do not.
std::string DescribeDrift(const RealRecording& real) {
  constexpr double kMaxShift_s = 1, kMinDrift_s = 0.1, kBetter = 0.85, kMinRms_m = 0.05;
  const auto& [recording, twin, match] = real;
  if (match.alignment.rms_m < kMinRms_m) return "";
  const std::size_t half = recording.frames.size() / 2;
  const double half_s = static_cast<double>(half) / recording.rate_hz;
  std::array<double, 2> shifts{};
  for (const std::size_t i : {0, 1}) {
    TwinAlignment start = match.alignment;
    start.shift_s += static_cast<double>(i) * half_s;
    const auto own = RealignTwin(Excerpt(recording, i * half, (i + 1) * half), twin, start, kMaxShift_s);
    if (!own || own->alignment.rms_m > kBetter * match.alignment.rms_m) return "";
    shifts[i] = own->alignment.shift_s - start.shift_s;
  }
  const double drift_s = shifts[1] - shifts[0];
  if (std::abs(drift_s) < kMinDrift_s) return "";
  return fmt::format(
      "the two halves of the recording fit the reference at shifts in time that differ by {:.2f} s, as if the "
      "reference's clock is {:.0f} % {}; the frame rate of one file may be wrong (--rate, --reference-rate)",
      std::abs(drift_s), 100 * std::abs(drift_s) / half_s, drift_s < 0 ? "slow" : "fast");
}

}  // namespace

std::string DescribeMismatch(const RealRecording& real) {
  constexpr double kMaxRatio = 2, kMax_m = 0.3, kMinMirror_m = 0.05, kMirror = 0.5;
  constexpr double kMinMovement_m = 0.1, kClearly = 0.7;
  using Places = std::optional<glm::dvec3>;
  const auto& [recording, twin, match] = real;
  // Compare the sizes by the joints that both show.
  std::array<bool, kRoleCount> is_common{};
  for (std::size_t j = 0; j < kRoleCount; ++j) is_common[j] = match.alignment.offsets[j].has_value();
  const double own = SizeOf(recording.frames.size(), [&](std::size_t t, std::size_t j) {
    return is_common[j] ? recording.frames[t][j] : Places();
  });
  const double other = SizeOf(twin.frames.size(), [&](std::size_t t, std::size_t j) {
    const auto& carrier = twin.frames[t][j];
    return is_common[j] && carrier ? Places(carrier->position) : Places();
  });
  if (!(other <= kMaxRatio * own && own <= kMaxRatio * other)) {
    return fmt::format(
        "the body in the reference is {:.3g} times as large as in the recording; the unit of one file may be wrong",
        other / own);
  }
  const double rms_m = match.alignment.rms_m;
  if (rms_m > kMinMirror_m) {
    JointRecording mirrored = recording;
    for (RolePositions& frame : mirrored.frames) {
      for (auto& place : frame) {
        if (place) place->x = -place->x;
      }
    }
    const auto image = AlignTwin(mirrored, twin);
    if (image && image->alignment.rms_m < kMirror * rms_m) {
      return fmt::format(
          "the RMS distance after alignment is {:.1f} mm, but {:.1f} mm if the recording is mirrored, so one of the "
          "two files is a mirror image",
          1000 * rms_m, 1000 * image->alignment.rms_m);
    }
  }
  // All shifts leave about the same of a body that hardly moves.
  const auto chance = ChanceRms(recording, twin, match);
  if (chance && MovementOf(match.truth) > kMinMovement_m && rms_m > kClearly * *chance) {
    return fmt::format(
        "the RMS distance after alignment is {:.1f} mm, hardly less than at other shifts in time ({:.1f} mm); if the "
        "motion is the same, the frame rate of one file may be wrong (--rate, --reference-rate)",
        1000 * rms_m, 1000 * *chance);
  }
  if (std::string drift = DescribeDrift(real); !drift.empty()) return drift;
  if (rms_m <= kMax_m) return "";
  return fmt::format(
      "the RMS distance after alignment is {:.1f} mm; allowed for recordings of the same motion: at most {:g} mm",
      1000 * rms_m, 1000 * kMax_m);
}

SensorStatistics StatisticsOf(const RealRecording& real) { return StatisticsOf(real.recording, &real.match); }

JointRecording Simulate(const RealRecording& real, const SkeletonSensorOptions& options, const WorldKey& world) {
  const BodyMotion motion = WithoutShiver(WholeMotion(real));
  const Camera sensor = SensorOf(real, motion, options.view);
  JointRecording simulated = RecordingOf(SenseSkeleton(motion, sensor, {}, options, world), sensor.p_WC);
  // match.truth has the poses of the recording's times. The sensor reports them Lag() frames later, the first one until
  // then.
  if (!real.recording.late_s.empty()) {
    simulated.late_s.assign(static_cast<std::size_t>(options.Lag()), real.recording.late_s.front());
    std::ranges::copy(real.recording.late_s, std::back_inserter(simulated.late_s));
    simulated.late_s.resize(simulated.frames.size());
  }
  for (std::size_t t = 0; t < simulated.frames.size(); ++t) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      if (!real.match.truth[t][j]) simulated.frames[t][j].reset();
    }
  }
  return simulated;
}

SensorStatisticsSummary SimulatedStatistics(const RealRecording& real, const SkeletonSensorOptions& options, int worlds,
                                            const WorldKey& first_world) {
  std::vector<SensorStatistics> recordings;
  TwinAlignment start = real.match.alignment;
  start.shift_s -= options.Lag() / real.recording.rate_hz;
  for (int i = 0; i < worlds; ++i) {
    WorldKey world = first_world;
    world.trial += i;
    const JointRecording simulated = Simulate(real, options, world);
    const auto match = RealignTwin(simulated, real.twin, start, 1 / real.recording.rate_hz);
    recordings.push_back(StatisticsOf(simulated, match ? &*match : nullptr));
  }
  return Summarise(recordings);
}

FittedSensor FitSensor(const RealRecording& real, const SensorFitOptions& options) {
  // Start from the given sensor, at the distance measured in the recording.
  const SensorStatistics measured = StatisticsOf(real);
  FittedSensor fitted{.sensor = options.start, .at_bounds = {}};
  SkeletonSensorOptions& sensor = fitted.sensor;
  if (const double distance = MeanDistance(real); distance > 0) sensor.reference_distance_m = distance;
  // In each step, compare the statistics of the recording and of the simulation. Correct each setting by the ratio or
  // the difference of the statistic that depends on it.
  for (int step = 0; step < options.steps; ++step) {
    const SensorStatistics simulated = SimulatedStatistics(real, sensor, options.worlds, kFitWorlds).mean;
    fitted.at_bounds.clear();
    FitGroups(measured, simulated, sensor, fitted.at_bounds);
    FitCorrelations(measured, simulated, sensor);
    FitQuiet(measured, simulated, sensor, fitted.at_bounds);
    FitFastPart(measured, simulated, sensor, fitted.at_bounds);
    FitStretch(measured, simulated, sensor, fitted.at_bounds);
    if (options.progress) options.progress(step);
  }
  return fitted;
}

}  // namespace etude
