#include "engine/keypoints/rig_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "engine/base/order_statistics.h"
#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

using enum Landmark;

constexpr int kGains = 15;
constexpr double kGainStep = 0.02;
double GainAt(int i) { return 1 + kGainStep * (i - kGains / 2); }

/// The cost of each tested gain, that is, of each factor on the focal length.
using Costs = std::array<double, kGains>;

/// Returns the gain of minimal cost, refined by a parabola through its neighbours; nullopt if the minimum is at an end
/// of the range.
std::optional<double> GainOfLeast(const Costs& costs) {
  const auto at = static_cast<int>(std::ranges::min_element(costs) - costs.begin());
  if (at == 0 || at + 1 == kGains) return std::nullopt;
  const double before = costs[at - 1], here = costs[at], after = costs[at + 1];
  const double bend = before - 2 * here + after;
  return GainAt(at) + (bend > 0 ? 0.5 * kGainStep * (before - after) / bend : 0);
}

/// Returns the jackknife standard error of the gain, leaving out one part of the costs at a time; nullopt if a gain is
/// at an end of the range or there are fewer than four parts.
std::optional<double> ErrorByParts(const Costs& whole, std::span<const Costs> parts) {
  std::vector<double> gains;
  for (const Costs& part : parts) {
    Costs others = whole;
    for (int i = 0; i < kGains; ++i) others[i] -= part[i];
    if (others == whole) continue;
    const auto gain = GainOfLeast(others);
    if (!gain) return std::nullopt;
    gains.push_back(*gain);
  }
  constexpr std::size_t kMinParts = 4;
  if (gains.size() < kMinParts) return std::nullopt;
  double mean = 0, squares = 0;
  const auto count = static_cast<double>(gains.size());
  for (const double gain : gains) mean += gain / count;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  return std::sqrt((count - 1) / count * squares);
}

/// A factor that multiplies the focal length of one film, or of all films if `film` is nullopt.
struct FocalGain {
  std::optional<std::size_t> film;
  double gain = 1, error = 0;
  double cost = 0;
};

/// The hypothesis that relative coordinates refer to a square that contains the picture. `padded` is the share of the
/// square's padding that lies before the picture; `told` describes the square for users.
struct SquareReading {
  double padded;
  const char* told;
};
constexpr std::array kSquares = {SquareReading{0.5, "the side of a square around the picture"},
                                 SquareReading{0, "the longer side of the picture"}};

class RigChecker {
 public:
  using Read = std::function<glm::dvec2(std::size_t film, const glm::dvec2& pixel)>;

  RigChecker(std::span<const Camera> cameras, std::span<const std::string> names, const MatchedPerson& person,
             double min_confidence)
      : cameras_(cameras), names_(names), person_(person), least_confidence_(min_confidence) {
    constexpr std::size_t kMaxFrames = 60;
    const std::size_t frames = person.seen.empty() ? 0 : person.seen.front().size();
    const std::size_t stride = std::max<std::size_t>(1, frames / kMaxFrames);
    for (std::size_t frame = 0; frame < frames; frame += stride) frames_.push_back(frame);
  }

  std::vector<std::string> Run() {
    std::vector<std::string> told;
    for (const auto& one : {CheckReading(), CheckFocalLengths()}) {
      if (one) told.push_back(*one);
    }
    return told;
  }

 private:
  const SeenPerson* Seen(std::size_t film, std::size_t frame) const {
    const auto& seen = person_.seen[film];
    return frame < seen.size() && seen[frame] ? &*seen[frame] : nullptr;
  }

  /// For each pair of sightings of one landmark, calls `take` with the index in frames_, the landmark and the epipolar
  /// distance.
  void ForEachDistance(std::span<const double> gains, const Read& read,
                       const std::function<void(std::size_t, std::size_t, double)>& take) const {
    for (std::size_t a = 0; a < cameras_.size(); ++a) {
      for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
        const auto geometry = EpipolarGeometry::Of(MatrixBy(a, gains), MatrixBy(b, gains));
        if (!geometry) continue;
        for (std::size_t k = 0; k < frames_.size(); ++k) {
          const SeenPerson *one = Seen(a, frames_[k]), *other = Seen(b, frames_[k]);
          if (one == nullptr || other == nullptr) continue;
          for (std::size_t i = 0; i < kLandmarkCount; ++i) {
            const Keypoint &p = one->keypoints[i], &q = other->keypoints[i];
            if (p.confidence < least_confidence_ || q.confidence < least_confidence_) continue;
            take(k, i, geometry->DistancePx(read(a, p.pixel), read(b, q.pixel)));
          }
        }
      }
    }
  }

  ProjectionMatrix MatrixBy(std::size_t film, std::span<const double> gains) const {
    Camera camera = cameras_[film];
    camera.intrinsics.fx *= gains[film];
    camera.intrinsics.fy *= gains[film];
    return MatrixOf(camera);
  }

  double MedianMiss(std::span<const double> gains, const Read& read) const {
    std::vector<double> distances;
    ForEachDistance(gains, read, [&](std::size_t, std::size_t, double d) { distances.push_back(std::abs(d)); });
    return distances.empty() ? 0 : UpperMedian(std::move(distances));
  }

  static glm::dvec2 AsDeclared(std::size_t, const glm::dvec2& pixel) { return pixel; }

  std::vector<double> Gains(const std::optional<std::size_t>& film, double gain) const {
    std::vector<double> gains(cameras_.size(), film ? 1 : gain);
    if (film) gains[*film] = gain;
    return gains;
  }

  std::optional<FocalGain> Estimate(const std::optional<std::size_t>& film, double usual_px) const {
    constexpr std::size_t kTimes = 10;
    Costs whole{};
    std::array<Costs, kLandmarkCount> by_landmark{};
    std::array<Costs, kTimes> by_time{};
    // At every gain, sum the Geman–McClure loss: in total, by landmark, and by tenth of the time.
    const double far = 9 * usual_px * usual_px;
    for (int i = 0; i < kGains; ++i) {
      ForEachDistance(Gains(film, GainAt(i)), AsDeclared, [&](std::size_t k, std::size_t landmark, double d) {
        const double cost = d * d / (d * d + far);
        whole[i] += cost;
        by_landmark[landmark][i] += cost;
        by_time[k * kTimes / frames_.size()][i] += cost;
      });
    }
    const auto gain = GainOfLeast(whole);
    const auto a = ErrorByParts(whole, by_landmark), b = ErrorByParts(whole, by_time);
    if (!gain || !a || !b) return std::nullopt;
    return FocalGain{film, *gain, std::max(*a, *b), *std::ranges::min_element(whole)};
  }

  std::optional<std::string> CheckFocalLengths() const {
    // kNormal: the ratio of the standard deviation to the median of |x| for a normal distribution.
    constexpr double kNormal = 1.4826, kMinUsualPx = 0.05;
    const double miss = MedianMiss(Gains({}, 1), AsDeclared), usual_px = std::max(kMinUsualPx, kNormal * miss);
    // Take the film, or all films, whose best gain has the lowest cost.
    std::optional<FocalGain> best = Estimate({}, usual_px);
    constexpr std::size_t kMaxFilmsAlone = 8;
    for (std::size_t film = 0; film < std::min(kMaxFilmsAlone, cameras_.size()); ++film) {
      const auto one = Estimate(film, usual_px);
      if (one && (!best || one->cost < best->cost)) best = one;
    }
    // Warn only if the gain is plausible and significant.
    constexpr double kMinChange = 0.02, kMinStandardErrors = 4, kMaxChange = 0.12;
    if (!best) return std::nullopt;
    const double off = std::abs(best->gain - 1);
    if (off < kMinChange || off > kMaxChange || off < kMinStandardErrors * best->error) return std::nullopt;
    const double better = MedianMiss(Gains(best->film, best->gain), AsDeclared);
    if (!(better < miss)) return std::nullopt;
    return TextOf(*best, miss, better);
  }

  /// Describes the evidence for another focal length: its standard error, and the median distances of the rays, pixels,
  /// with the rig's focal length and with this one.
  std::string TextOf(const FocalGain& found, double miss, double better) const {
    std::string whose =
        fmt::format("focal lengths of all cameras multiplied by {:.3f} ± {:.3f}", found.gain, found.error);
    if (found.film) {
      whose =
          fmt::format("{}: a focal length multiplied by {:.3f} ± {:.3f}", names_[*found.film], found.gain, found.error);
    }
    if (found.film && cameras_.size() == 2) {
      whose += fmt::format(" (or that of {} multiplied by {:.3f})", names_[1 - *found.film], 1 / found.gain);
    }
    constexpr double kClearly = 0.95;
    const std::string strength = better < kClearly * miss ? "" : ", which is weak evidence";
    const std::string rivals = found.film ? "a moved camera or a wrong lens can have the same effect"
                                          : "the person's size would change by about the same factor";
    return fmt::format(
        "{} would fit the keypoints better: rays to the same keypoint would miss each other by {:.3f} px (median) "
        "instead of {:.3f} px{}; {} (±: standard error)",
        whose, better, miss, strength, rivals);
  }

  /// Returns the median shoulder width as a share of the leg length; 0 if shoulders or legs are not seen.
  double ShouldersOfLegs(const Read& read) const {
    std::vector<double> shoulders, thighs, shanks;
    for (const std::size_t frame : frames_) {
      const auto add = [&](Landmark a, Landmark b, std::vector<double>& lengths) {
        const auto p = PositionOf(frame, a, read), q = PositionOf(frame, b, read);
        if (p && q) lengths.push_back(glm::distance(*p, *q));
      };
      add(kLeftShoulder, kRightShoulder, shoulders);
      add(kLeftHip, kLeftKnee, thighs);
      add(kRightHip, kRightKnee, thighs);
      add(kLeftKnee, kLeftAnkle, shanks);
      add(kRightKnee, kRightAnkle, shanks);
    }
    if (shoulders.empty() || thighs.empty() || shanks.empty()) return 0;
    return UpperMedian(std::move(shoulders)) / (UpperMedian(std::move(thighs)) + UpperMedian(std::move(shanks)));
  }

  // Triangulates a landmark in one frame; nullopt if the triangulation fails.
  std::optional<glm::dvec3> PositionOf(std::size_t frame, Landmark landmark, const Read& read) const {
    std::vector<Sighting> sightings;
    for (std::size_t film = 0; film < cameras_.size(); ++film) {
      const SeenPerson* seen = Seen(film, frame);
      if (seen == nullptr || (*seen)[landmark].confidence < least_confidence_) continue;
      sightings.push_back({MatrixOf(cameras_[film]), read(film, (*seen)[landmark].pixel)});
    }
    const TriangulatedPoint point = Triangulate(sightings);
    return point.status == PointStatus::kOk ? std::optional(point.position) : std::nullopt;
  }

  std::optional<std::string> CheckReading() const {
    const Intrinsics& in = cameras_.front().intrinsics;
    constexpr double kUsual = 0.42, kClearly = 1.17, kSomewhat = 1.1, kClearlyLess = 0.9;
    // Compute the factor by which shoulder width / leg length differs from its usual value.
    const double said = ShouldersOfLegs(AsDeclared);
    const auto strange = [&](double share) { return share > kUsual ? share / kUsual : kUsual / share; };
    if (in.width == in.height || said == 0 || strange(said) < kSomewhat) return std::nullopt;
    const std::vector<double> as_they_are = Gains({}, 1);
    const double miss = MedianMiss(as_they_are, AsDeclared);
    double least = (strange(said) < kClearly ? kClearlyLess : 1) * miss;
    std::optional<std::string> told;
    // Try the other interpretations of the coordinates; keep the one with the smallest distances.
    for (const SquareReading& square : kSquares) {
      const Read read = [&](std::size_t film, const glm::dvec2& p) {
        const Intrinsics& own = cameras_[film].intrinsics;
        const glm::dvec2 size(own.width, own.height);
        const double side = std::max(size.x, size.y);
        return p * side / size - square.padded * (side - size);
      };
      const double share = ShouldersOfLegs(read);
      // Reading coordinates relative to a square stretches one axis and thereby the distances; undo this scaling.
      const auto [shorter, longer] = std::minmax(in.width, in.height);
      const double miss_read =
          MedianMiss(as_they_are, read) * static_cast<double>(shorter) / static_cast<double>(longer);
      if (share == 0 || !(strange(share) < strange(said)) || !(miss_read < least)) continue;
      least = miss_read;
      told = fmt::format(
          "the shoulder width is {:.2f} times the leg length (usual: {:.2f}); if keypoint coordinates are fractions of "
          "{}, the ratio is {:.2f}, and the residual of the rays is {:.2f} px instead of {:.2f} px",
          said, kUsual, square.told, share, miss_read, miss);
    }
    return told;
  }

  std::span<const Camera> cameras_;
  std::span<const std::string> names_;
  const MatchedPerson& person_;
  double least_confidence_;
  std::vector<std::size_t> frames_;
};

}  // namespace

std::vector<std::string> RigWarnings(std::span<const Camera> cameras, std::span<const std::string> names,
                                  const MatchedPerson& person, double min_confidence) {
  return RigChecker(cameras, names, person, min_confidence).Run();
}

}  // namespace etude
