#include "engine/boards/film_delays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace etude {
namespace {

/// Identifies a sighting by camera, board and look (a look is one of the examined, evenly spaced pictures of a film).
using SightingKey = std::tuple<std::size_t, std::size_t, int>;
using SightingMap = std::map<SightingKey, const BoardSighting*>;

const glm::dvec2* PixelOf(const SightingMap& map, const SightingKey& key, const glm::dvec3& corner) {
  const auto found = map.find(key);
  if (found == map.end()) return nullptr;
  for (const PointPair& pair : found->second->view.pairs) {
    if (pair.world == corner) return &pair.pixel;
  }
  return nullptr;
}

/// Returns the corners of a sighting at another time, interpolated between looks. `share` (−0.5 to 0.5) is the time
/// from the sighting's look to that other time, divided by the interval between looks. Corners that no neighbouring
/// look shows are left out.
std::vector<PointPair> CornersBetween(const SightingMap& map, const SightingKey& key, const BoardSighting& sighting,
                                      double share) {
  constexpr double kNow = 1e-6;
  if (std::abs(share) < kNow) return sighting.view.pairs;
  const auto& [camera, board, look] = key;
  std::vector<PointPair> moved;
  for (const PointPair& pair : sighting.view.pairs) {
    const glm::dvec2* const before = PixelOf(map, {camera, board, look - 1}, pair.world);
    const glm::dvec2* const after = PixelOf(map, {camera, board, look + 1}, pair.world);
    if (before && after) {
      const glm::dvec2 velocity = 0.5 * (*after - *before), curvature = 0.5 * (*after + *before) - pair.pixel;
      moved.push_back({pair.world, pair.pixel + share * velocity + share * share * curvature});
    } else if (before || after) {
      const glm::dvec2 velocity = after ? *after - pair.pixel : pair.pixel - *before;
      moved.push_back({pair.world, pair.pixel + share * velocity});
    }
  }
  return moved;
}

/// Returns all sightings if they show at most kMaxMoments targets, or if no target is seen in several films. (A target
/// is a board at one time; a look is an examined picture of a film.) Otherwise returns the sightings of about
/// kMaxMoments targets, in evenly spaced blocks of consecutive looks.
std::vector<BoardSighting> Subsampled(std::span<const BoardSighting> sightings) {
  constexpr std::size_t kMaxMoments = 60;
  std::map<std::size_t, std::size_t> cameras;  // number of cameras that see each target
  for (const BoardSighting& s : sightings) ++cameras[s.view.target];
  std::size_t shared = 0;
  for (const auto& [target, count] : cameras) shared += count > 1 ? 1 : 0;
  if (cameras.size() <= kMaxMoments || shared == 0) return {sightings.begin(), sightings.end()};
  // Keep blocks of consecutive looks, because velocities are computed from neighbouring looks.
  constexpr int kBlock = 6;
  const std::size_t blocks = std::max<std::size_t>(1, (cameras.size() + kMaxMoments - 1) / kMaxMoments);
  std::vector<BoardSighting> kept;
  for (const BoardSighting& s : sightings) {
    if (static_cast<std::size_t>(s.look / kBlock) % blocks == 0) kept.push_back(s);
  }
  return kept;
}

}  // namespace

std::vector<TargetView> SynchronisedViews(std::span<const BoardSighting> sightings, std::span<const double> period_s,
                                    std::span<const double> delay_s) {
  SightingMap map;
  for (const BoardSighting& s : sightings) map[{s.view.camera, s.board, s.look}] = &s;
  // The index of each target, by the target's board and by the look of the first film that is nearest in time.
  std::map<std::pair<std::size_t, int>, std::size_t> targets;
  std::size_t count = 0;
  const auto target_of = [&](std::size_t board, int look) {
    const auto [at, is_new] = targets.try_emplace({board, look}, count);
    count += is_new ? 1 : 0;
    return at->second;
  };
  std::vector<TargetView> views;
  for (const BoardSighting& s : sightings) {
    const std::size_t camera = s.view.camera;
    const double period = period_s[camera];
    // In the first film, find the look (an examined picture) that is nearest in time to this sighting. Compute the time
    // from this sighting to that look, as a fraction of the time between looks.
    const int look = static_cast<int>(std::lround((s.look * period - delay_s[camera]) / period_s[0]));
    const double share = (look * period_s[0] + delay_s[camera]) / period - s.look;
    constexpr double kHalf = 0.5 + 1e-9;
    std::vector<PointPair> pairs;
    if (std::abs(share) <= kHalf) pairs = CornersBetween(map, {camera, s.board, s.look}, s, share);
    constexpr std::size_t kMinCorners = 4;
    if (pairs.size() >= kMinCorners) {
      views.push_back({camera, target_of(s.board, look), std::move(pairs)});
    } else {
      views.push_back({camera, count++, s.view.pairs});
    }
  }
  return views;
}

Result<FilmDelays> FindFilmDelays(std::span<const PictureSize> sizes, std::span<const BoardSighting> sightings,
                                std::span<const double> period_s, double max_delay_s, const RefineOptions& options,
                                const OnProgress& on_progress) {
  FilmDelays steps{.delay_s = std::vector<double>(sizes.size())};
  const std::vector<BoardSighting> tried = Subsampled(sightings);
  RefineOptions quick = options;
  constexpr int kQuick = 25;
  quick.most_iterations = kQuick;
  const auto residual = [&](std::span<const double> delay_s) -> Result<double> {
    ASSIGN_OR_RETURN(const RefinedRig rig, CalibrateFromPlanes(sizes, SynchronisedViews(tried, period_s, delay_s), quick));
    return rig.rms_px;
  };
  // If calibration fails without delays, its residual counts as infinite: calibration may succeed with delays.
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const auto in_step = residual(steps.delay_s);
  steps.before_px = steps.after_px = in_step ? *in_step : kNever;
  const std::size_t rounds = sizes.size() > 2 ? 2 : 1;
  // The grid covers ±max_delay_s in steps of half the time between looks. With more than two films, the search runs
  // twice.
  const double step_s = 0.5 * period_s[0];
  const int wide = std::max(1, static_cast<int>(std::floor(max_delay_s / step_s)));
  constexpr int kHalvings = 5;
  const std::size_t all = rounds * (sizes.size() - 1) * static_cast<std::size_t>(2 * wide + 1 + 2 * kHalvings);
  std::size_t done = 0;
  for (std::size_t round = 0; round < rounds; ++round) {
    for (std::size_t film = 1; film < sizes.size(); ++film) {
      std::vector<double> delay_s = steps.delay_s;
      double best_s = delay_s[film], min_px = steps.after_px;
      const auto try_delay = [&](double s) {
        delay_s[film] = s;
        const auto px = residual(delay_s);
        if (on_progress) on_progress(std::min(all, ++done), all);
        if (!px || !(*px < min_px)) return;
        min_px = *px;
        best_s = s;
      };
      // Search the grid, then halve the step around the best delay.
      for (int i = -wide; i <= wide; ++i) try_delay(i * step_s);
      double half = 0.5 * step_s;
      for (int i = 0; i < kHalvings; ++i, half *= 0.5) {
        const double middle = best_s;
        try_delay(middle - half);
        try_delay(middle + half);
      }
      // Accept the delay if the residual falls enough.
      constexpr double kMinImprovement = 0.9;
      if (!(min_px < kMinImprovement * steps.after_px)) continue;
      steps.after_px = min_px;
      steps.delay_s[film] = best_s;
    }
  }
  if (on_progress) on_progress(all, all);
  if (!std::isfinite(steps.after_px)) return tl::unexpected(in_step.error());
  return steps;
}

}  // namespace etude
