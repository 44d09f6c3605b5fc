#include "bench/metrics/time_shift.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace etude {
namespace {

constexpr double kNotShown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMinFrames = 5;

/// Returns a joint's position at the time `at`, which is counted in frames: in a whole frame, the position in this
/// frame; between frames, a Catmull-Rom cubic through the four frames around `at`. NaN if one of these frames does
/// not exist or does not show the joint.
glm::dvec3 CubicAt(const PointTracks& tracks, double at, std::size_t joint) {
  constexpr double kSameFrame = 1e-9;
  const double whole = std::round(at), frames = static_cast<double>(tracks.FrameCount());
  if (std::abs(at - whole) < kSameFrame) {
    const bool is_inside = whole >= 0 && whole < frames;
    return is_inside ? tracks.Frame(static_cast<std::size_t>(whole))[joint] : glm::dvec3(kNotShown);
  }
  const double floor = std::floor(at), u = at - floor;
  if (floor < 1 || floor + 2 >= frames) return glm::dvec3(kNotShown);
  const auto first = static_cast<std::size_t>(floor) - 1;
  const auto p = [&](std::size_t k) { return tracks.Frame(first + k)[joint]; };
  return 0.5 * (2.0 * p(1) + u * (p(2) - p(0)) + u * u * (2.0 * p(0) - 5.0 * p(1) + 4.0 * p(2) - p(3)) +
                u * u * u * (3.0 * p(1) - p(0) - 3.0 * p(2) + p(3)));
}

/// The distance between two joints over time, metres: `truth` is the true distance, `rate` its rate of change (metres
/// per second), and `found` the answer's distance at the shifted time. There is one entry per frame of the truth in
/// which all three values are known.
struct Distances {
  std::vector<double> truth, rate, found;
  std::vector<std::size_t> frames;

  void Clear() {
    for (std::vector<double>* values : {&truth, &rate, &found}) values->clear();
    frames.clear();
  }
};

/// The least-squares line of the answer's distances as a function of the true distances. Its slope is at least 0.
struct Line {
  double slope = 0, mean_truth = 0, mean_found = 0;
  double square_truth = 0;
  double explained = 0, all = 0;  ///< sums of squares of the answer's distances: the part that the line explains, and
                                  ///< the total
};

Line FitLine(const Distances& pair) {
  Line line;
  const double n = static_cast<double>(pair.truth.size());
  for (std::size_t i = 0; i < pair.truth.size(); ++i) {
    line.mean_truth += pair.truth[i] / n;
    line.mean_found += pair.found[i] / n;
  }
  double product = 0;
  for (std::size_t i = 0; i < pair.truth.size(); ++i) {
    const double s = pair.truth[i] - line.mean_truth, f = pair.found[i] - line.mean_found;
    line.square_truth += s * s;
    line.all += f * f;
    product += s * f;
  }
  if (line.square_truth > 0) line.slope = std::max(0.0, product / line.square_truth);
  line.explained = line.slope * product;
  return line;
}

class ShiftFinder {
 public:
  ShiftFinder(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer, double answer_rate_hz)
      : truth_(truth), answer_(answer), truth_rate_hz_(truth_rate_hz), answer_rate_hz_(answer_rate_hz) {
    constexpr std::size_t kMaxJoints = 20;
    const std::size_t count = std::min(truth.points, kMaxJoints);
    for (std::size_t i = 0; i < count; ++i) joints_.push_back(i * truth.points / count);
  }

  std::optional<TimeShift> Find() const {
    const auto whole = FindWholeFrames();
    return whole ? Refine(static_cast<double>(*whole) / truth_rate_hz_) : std::nullopt;
  }

 private:
  /// Calls `visit` with the distances of each pair of joints in every `stride`-th frame, except the first and the last
  /// frame. All calls share one object, because a shift is tried hundreds of times.
  template <typename Visit>
  void VisitPairs(double shift_s, std::size_t stride, const Visit& visit) const {
    const std::size_t n = joints_.size();
    std::vector<std::size_t> frames;
    std::vector<glm::dvec3> found;  // frames × joints
    for (std::size_t f = 1; f + 1 < truth_.FrameCount(); f += stride) {
      frames.push_back(f);
      const double at = (static_cast<double>(f) / truth_rate_hz_ + shift_s) * answer_rate_hz_;
      for (const std::size_t joint : joints_) found.push_back(CubicAt(answer_, at, joint));
    }
    Distances pair;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        pair.Clear();
        const auto distance = [&](std::size_t frame) {
          return glm::distance(truth_.Frame(frame)[joints_[a]], truth_.Frame(frame)[joints_[b]]);
        };
        for (std::size_t i = 0; i < frames.size(); ++i) {
          const std::size_t f = frames[i];
          const double of_found = glm::distance(found[i * n + a], found[i * n + b]);
          if (std::isnan(of_found)) continue;
          const double s = distance(f), rate = 0.5 * truth_rate_hz_ * (distance(f + 1) - distance(f - 1));
          if (std::isnan(s + rate)) continue;
          pair.truth.push_back(s);
          pair.rate.push_back(rate);
          pair.found.push_back(of_found);
          pair.frames.push_back(f);
        }
        visit(pair);
      }
    }
  }

  /// Returns the shift, in whole frames of the truth, that fits best. In a motion that repeats, many shifts fit nearly
  /// as well (step 1 of FindTimeShift). Returns nothing if no shift
  /// explains kMinExplainedShare of the variance, or if the shift is the largest that is searched.
  std::optional<int> FindWholeFrames() const {
    constexpr std::size_t kMaxCompared = 1000;  // largest number of compared frames
    constexpr double kNearlyAsWell = 1.44, kRounding = 1e-9;
    const std::size_t stride = 1 + truth_.FrameCount() / kMaxCompared;
    std::size_t unmoved = 0;
    VisitPairs(0, stride, [&](const Distances& pair) { unmoved += pair.truth.size(); });
    const std::size_t fewest = std::max(unmoved / 2, kMinFrames);
    const int reach = static_cast<int>(std::floor(kMaxTimeShift_s * truth_rate_hz_));
    std::vector<double> unexplained;  // share of the variance, by shift
    for (int shift = -reach; shift <= reach; ++shift) {
      std::size_t compared = 0;
      double explained = 0, all = 0;
      VisitPairs(shift / truth_rate_hz_, stride, [&](const Distances& pair) {
        compared += pair.truth.size();
        const Line line = FitLine(pair);
        explained += line.explained;
        all += line.all;
      });
      unexplained.push_back(compared >= fewest && all > 0 ? 1 - explained / all : 1);
    }
    const double least = std::ranges::min(unexplained);
    if (least > 1 - kMinExplainedShare) return std::nullopt;
    const auto at = [&](int shift) { return unexplained[static_cast<std::size_t>(reach + shift)]; };
    const auto fits = [&](int shift) {
      return std::abs(shift) <= reach && at(shift) <= kNearlyAsWell * least + kRounding;
    };
    int smallest = 0;
    while (!fits(smallest) && !fits(-smallest)) ++smallest;
    int best = fits(-smallest) ? -smallest : smallest;
    for (const int way : {-1, 1}) {
      for (int shift = way * smallest; fits(shift); shift += way) {
        if (at(shift) < at(best)) best = shift;
      }
    }
    return std::abs(best) == reach ? std::nullopt : std::optional(best);
  }

  /// The sums of one Newton step.
  struct Step {
    double square = 0;             ///< Σ w (β v)² over all pairs
    std::vector<double> products;  ///< by frame: Σ w β v · residual
    double motion = 0;             ///< Σ (β v)²
    double count = 0;
  };

  Step StepAt(double shift_s) const {
    Step step;
    step.products.assign(truth_.FrameCount(), 0.0);
    VisitPairs(shift_s, 1, [&](const Distances& pair) {
      if (pair.truth.size() < kMinFrames) return;
      const Line line = FitLine(pair);
      constexpr double kExact_m2 = 1e-6;  // 1 mm²
      const double n = static_cast<double>(pair.truth.size());
      const double weight = 1 / (std::max(0.0, line.all - line.explained) / n + kExact_m2);
      // Subtract from the rate its regression on 1 and s, where s is the true distance.
      double mean = 0, product = 0;
      for (const double rate : pair.rate) mean += rate / n;
      for (std::size_t i = 0; i < pair.rate.size(); ++i) {
        product += (pair.rate[i] - mean) * (pair.truth[i] - line.mean_truth);
      }
      const double along = line.square_truth > 0 ? product / line.square_truth : 0;
      for (std::size_t i = 0; i < pair.rate.size(); ++i) {
        const double s = pair.truth[i] - line.mean_truth, f = pair.found[i] - line.mean_found;
        const double own = line.slope * (pair.rate[i] - mean - along * s);
        step.products[pair.frames[i]] += weight * own * (f - line.slope * s);
        step.square += weight * own * own;
        step.motion += own * own;
      }
      step.count += n;
    });
    return step;
  }

  std::optional<TimeShift> Refine(double shift_s) const {
    constexpr int kMaxSteps = 50;
    constexpr double kSettled_s = 1e-10, kMinRate_mps = 1e-4, kMaxWay = 2;  // kMaxWay is in frames
    const double start_s = shift_s;
    for (int count = 0; count < kMaxSteps; ++count) {
      const Step step = StepAt(shift_s);
      if (!(step.motion > kMinRate_mps * kMinRate_mps * step.count)) return std::nullopt;
      double product = 0;
      for (const double of_frame : step.products) product += of_frame;
      const double change_s = -product / step.square;
      shift_s += change_s;
      if (std::abs(shift_s - start_s) > kMaxWay / truth_rate_hz_) return std::nullopt;
      if (std::abs(change_s) < kSettled_s) return TimeShift{shift_s, HalfWidth(step)};
    }
    return std::nullopt;
  }

  /// Returns half the width of the jackknife interval over equal parts of the motion; nothing if the motion is too
  /// short.
  static std::optional<double> HalfWidth(const Step& step) {
    constexpr std::size_t kParts = 10, kMinPart = 3;  // number of parts; smallest part, frames
    constexpr double kStudent = 2.2621571628;         // 97.5 % quantile of Student's t with nine degrees of freedom
    const std::size_t frames = step.products.size();
    if (frames < kParts * kMinPart) return std::nullopt;
    std::array<double, kParts> parts{};
    for (std::size_t f = 0; f < frames; ++f) parts[f * kParts / frames] += step.products[f];
    double variance = 0;
    for (const double part : parts) variance += part * part / (step.square * step.square);
    return kStudent * std::sqrt(variance * kParts / (kParts - 1));
  }

  const PointTracks &truth_, &answer_;
  const double truth_rate_hz_, answer_rate_hz_;
  std::vector<std::size_t> joints_;
};

}  // namespace

std::optional<TimeShift> FindTimeShift(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer,
                                       double answer_rate_hz) {
  if (truth.points < 2 || truth.points != answer.points) return std::nullopt;
  return ShiftFinder(truth, truth_rate_hz, answer, answer_rate_hz).Find();
}

}  // namespace etude
