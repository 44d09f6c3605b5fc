#include "engine/teaching/teach_move.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/order_statistics.h"
#include "engine/recognition/sight.h"

namespace etude {
namespace {

using Angles = std::array<double, kFeatureCount>;
using Track = std::vector<Angles>;

/// Returns the ten angles of every frame that shows a body. A moving average over a sixth of a second removes noise but
/// keeps key poses.
Track TrackOf(const SkeletonStream& stream) {
  const SeenStream seen = SeeStream(stream, {});
  Track raw;
  for (const FeatureFrame& frame : seen.frames) {
    if (frame.body_seen) raw.push_back(frame.features.values);
  }
  const auto count = static_cast<int>(raw.size());
  const int half = std::max(0, static_cast<int>(stream.rate_hz / 12));
  Track smooth(raw.size());
  for (int t = 0; t < count; ++t) {
    const int begin = std::max(0, t - half), end = std::min(count, t + half + 1);
    for (std::size_t f = 0; f < kFeatureCount; ++f) {
      for (int u = begin; u < end; ++u) smooth[t][f] += raw[u][f] / (end - begin);
    }
  }
  return smooth;
}

/// Returns the difference between an angle's 95th and 5th percentile over the frames.
double RangeOf(const Track& track, std::size_t feature) {
  std::vector<double> values;
  for (const Angles& angles : track) values.push_back(angles[feature]);
  return LowerPercentile(values, 0.95) - LowerPercentile(values, 0.05);
}

/// Groups of angles: if a key pose uses one angle of a group, it uses every angle of the group.
constexpr Feature kTogether[][4] = {{Feature::kRH, Feature::kLH, Feature::kRHE, Feature::kLHE},
                                    {Feature::kRF, Feature::kRFK, Feature::kRF, Feature::kRFK},
                                    {Feature::kLF, Feature::kLFK, Feature::kLF, Feature::kLFK}};

/// Returns the angles that define the move: the angles whose median range over the examples is large, and all angles of
/// the same groups. If no angle changes much, returns the arms' angles.
std::vector<std::size_t> AnglesThatMatter(std::span<const Track> tracks, const TeachOptions& options) {
  // Find the median range of each angle over the examples.
  std::array<double, kFeatureCount> ranges{};
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    std::vector<double> of_examples;
    for (const Track& track : tracks) of_examples.push_back(RangeOf(track, f));
    ranges[f] = LowerPercentile(of_examples, 0.5);
  }
  // Choose the angles with large ranges, then complete their groups.
  const double least = std::max(options.least_range_deg, 0.5 * *std::ranges::max_element(ranges));
  std::array<bool, kFeatureCount> matters{};
  for (std::size_t f = 0; f < kFeatureCount; ++f) matters[f] = ranges[f] >= least;
  const bool is_still = std::ranges::none_of(matters, [](bool does) { return does; });
  const auto at = [](Feature feature) { return static_cast<std::size_t>(feature); };
  for (const auto& together : kTogether) {
    const bool moves = std::ranges::any_of(together, [&](Feature feature) { return matters[at(feature)]; });
    const bool is_default = is_still && &together == &kTogether[0];
    for (const Feature feature : together) matters[at(feature)] = matters[at(feature)] || moves || is_default;
  }
  std::vector<std::size_t> chosen;
  for (std::size_t f = 0; f < kFeatureCount; ++f) {
    if (matters[f]) chosen.push_back(f);
  }
  return chosen;
}

double Distance(const Angles& a, const Angles& b, std::span<const std::size_t> features) {
  double sum = 0;
  for (const std::size_t f : features) sum += (a[f] - b[f]) * (a[f] - b[f]);
  return std::sqrt(sum);
}

/// Marks the held poses, so that a recogniser can match a key pose in several frames. A pose is held if no angle
/// changes by the minimum tolerance or more within a tenth of a second before or after it. If the move never rests, all
/// poses are marked.
std::vector<bool> HeldPoses(const Track& track, std::span<const std::size_t> features, double rate_hz,
                            const TeachOptions& options) {
  const auto count = static_cast<int>(track.size());
  const int around = std::max(1, static_cast<int>(rate_hz / 10));
  std::vector<bool> held(track.size());
  for (int t = 0; t < count; ++t) {
    bool is_held = true;
    for (int u = std::max(0, t - around); u <= std::min(count - 1, t + around); ++u) {
      for (const std::size_t f : features) {
        is_held = is_held && std::abs(track[u][f] - track[t][f]) < options.least_tolerance_deg;
      }
    }
    held[static_cast<std::size_t>(t)] = is_held;
  }
  if (std::ranges::none_of(held, [](bool is) { return is; })) held.assign(track.size(), true);
  return held;
}

/// Returns the index of the first peak of `distances` that is nearly as high as the highest peak.
std::size_t FirstOfFarthest(const std::vector<double>& distances) {
  constexpr double kNearPeak = 0.95;
  const double farthest = *std::ranges::max_element(distances);
  const auto first = std::ranges::find_if(distances, [&](double d) { return d >= kNearPeak * farthest; });
  auto t = static_cast<std::size_t>(first - distances.begin());
  while (t + 1 < distances.size() && distances[t + 1] > distances[t]) ++t;
  return t;
}

/// Returns the frames of the key poses, in order of time.
std::vector<std::size_t> KeyFrames(const Track& track, std::span<const std::size_t> features, double rate_hz,
                                   const TeachOptions& options) {
  // The first key pose is the held pose farthest from the mean.
  const std::vector<bool> held = HeldPoses(track, features, rate_hz, options);
  Angles mean{};
  for (const Angles& angles : track) {
    for (const std::size_t f : features) mean[f] += angles[f] / static_cast<double>(track.size());
  }
  std::vector<double> distances;
  for (std::size_t t = 0; t < track.size(); ++t) {
    distances.push_back(held[t] ? Distance(track[t], mean, features) : 0.0);
  }
  std::vector<std::size_t> frames = {FirstOfFarthest(distances)};
  // Add the held pose farthest from all key poses chosen so far; stop when that pose is too near to one of them.
  double first_gap = 0;
  while (frames.size() < static_cast<std::size_t>(options.most_poses)) {
    for (std::size_t t = 0; t < track.size(); ++t) {
      const double here = held[t] ? Distance(track[t], track[frames.back()], features) : 0.0;
      distances[t] = frames.size() == 1 ? here : std::min(distances[t], here);
    }
    const std::size_t next = FirstOfFarthest(distances);
    if (frames.size() == 1) first_gap = distances[next];
    const double least = std::max(options.least_range_deg, 0.5 * first_gap);
    if (distances[next] < least) break;
    frames.push_back(next);
  }
  std::ranges::sort(frames);
  return frames;
}

/// Aligns `track` with `to` by dynamic time warping. Each frame of the result is the mean of the frames of `track` that
/// are matched with that frame of `to`.
Track Aligned(const Track& track, const Track& to, std::span<const std::size_t> features) {
  // Compute the cost of the best path to every pair of frames.
  const std::size_t rows = to.size(), columns = track.size();
  std::vector<double> cost(rows * columns);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      double before = i == 0 && j == 0 ? 0 : std::numeric_limits<double>::infinity();
      if (i > 0) before = std::min(before, cost[(i - 1) * columns + j]);
      if (j > 0) before = std::min(before, cost[i * columns + j - 1]);
      if (i > 0 && j > 0) before = std::min(before, cost[(i - 1) * columns + j - 1]);
      cost[i * columns + j] = before + Distance(to[i], track[j], features);
    }
  }
  // Trace the best path back, and average the matched frames.
  Track aligned(rows);
  std::vector<int> counts(rows, 0);
  for (std::size_t i = rows - 1, j = columns - 1;;) {
    for (const std::size_t f : features) aligned[i][f] += track[j][f];
    ++counts[i];
    if (i == 0 && j == 0) break;
    const double up = i > 0 ? cost[(i - 1) * columns + j] : std::numeric_limits<double>::infinity();
    const double left = j > 0 ? cost[i * columns + j - 1] : std::numeric_limits<double>::infinity();
    const double both = i > 0 && j > 0 ? cost[(i - 1) * columns + j - 1] : std::numeric_limits<double>::infinity();
    if (both <= up && both <= left) {
      --i, --j;
    } else if (up <= left) {
      --i;
    } else {
      --j;
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    for (const std::size_t f : features) aligned[i][f] /= counts[i];
  }
  return aligned;
}

/// Returns the index of the example with the median length.
std::size_t MiddleExample(std::span<const Track> tracks) {
  std::vector<std::size_t> order(tracks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return tracks[a].size() < tracks[b].size(); });
  return order[order.size() / 2];
}

PoseTarget TargetOf(std::span<const Track> aligned, std::size_t frame, std::size_t feature,
                    const TeachOptions& options) {
  const auto count = static_cast<double>(aligned.size());
  double mean = 0, variance = 0;
  for (const Track& track : aligned) mean += track[frame][feature] / count;
  for (const Track& track : aligned) {
    const double off = track[frame][feature] - mean;
    variance += off * off / std::max(1.0, count - 1);
  }
  return {.feature = AllFeatures()[feature],
          .degrees = mean,
          .tolerance_deg = std::clamp(options.spread * std::sqrt(variance), options.least_tolerance_deg,
                                      options.most_tolerance_deg)};
}

std::vector<TaughtPose> FindKeyPoses(std::span<const Track> tracks, double rate_hz, const TeachOptions& options) {
  const std::vector<std::size_t> features = AnglesThatMatter(tracks, options);
  const Track& reference = tracks[MiddleExample(tracks)];
  std::vector<Track> aligned;
  for (const Track& track : tracks) aligned.push_back(Aligned(track, reference, features));
  std::vector<TaughtPose> poses;
  for (const std::size_t frame : KeyFrames(reference, features, rate_hz, options)) {
    TaughtPose& pose = poses.emplace_back();
    for (const std::size_t f : features) pose.targets.push_back(TargetOf(aligned, frame, f, options));
  }
  return poses;
}

double SecondsOf(const SkeletonStream& stream) { return static_cast<double>(stream.frames.size()) / stream.rate_hz; }

}  // namespace

Result<TaughtMove> TeachMove(const std::string& name, std::vector<SkeletonStream> right,
                             std::vector<SkeletonStream> wrong, const TeachOptions& options) {
  constexpr double kMinSeconds = 0.5, kSlowestFactor = 1.3;
  if (right.empty()) return Fail({}, "move '{}' has no right performance from which Etude could learn", name);
  // Check the performances, and compute the angles of each.
  std::vector<Track> tracks;
  double longest = 0;
  for (const SkeletonStream& stream : right) {
    tracks.push_back(TrackOf(stream));
    const double seen = static_cast<double>(tracks.back().size()) / stream.rate_hz;
    if (seen < kMinSeconds) {
      return Fail({}, "a performance of '{}' shows a body for only {:.2f} s; allowed: at least {} s", name, seen,
                  kMinSeconds);
    }
    if (SecondsOf(stream) > kMaxSpan) {
      return Fail({},
                  "a performance of '{}' lasts {:.1f} s; allowed: at most {} s; use labels to mark where each "
                  "performance begins and ends",
                  name, SecondsOf(stream), kMaxSpan);
    }
    longest = std::max(longest, SecondsOf(stream));
  }
  // Find the key poses. TaughtMove::span_s allows for performances that are slower than the longest example.
  std::vector<TaughtPose> poses = FindKeyPoses(tracks, right.front().rate_hz, options);
  return TaughtMove{.name = name,
                    .poses = std::move(poses),
                    .span_s = std::min(kMaxSpan, kSlowestFactor * longest),
                    .examples = std::move(right),
                    .counter_examples = std::move(wrong)};
}

}  // namespace etude
