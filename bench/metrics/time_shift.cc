#include "bench/metrics/time_shift.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bench/metrics/pose_error.h"

namespace etude {
namespace {

constexpr double kNotShown = std::numeric_limits<double>::quiet_NaN();
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Returns a joint's position at a time in frames; NaN where one of the four frames around it is not seen.
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

/// The points of the truth that have a velocity and, at one shift, a partner in the answer.
struct ShiftedPoints {
  std::vector<glm::dvec3> found, truth, velocity;
  std::vector<std::size_t> frames;  ///< of each
};

class ShiftFinder {
 public:
  ShiftFinder(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer, double answer_rate_hz)
      : truth_(truth), answer_(answer), truth_rate_hz_(truth_rate_hz), answer_rate_hz_(answer_rate_hz) {}

  std::optional<TimeShift> Find() const {
    const auto whole = FindWholeFrames();
    return whole ? Refine(static_cast<double>(*whole) / truth_rate_hz_) : std::nullopt;
  }

 private:
  /// Collects the points of every `stride`-th frame.
  ShiftedPoints PointsAt(double shift_s, std::size_t stride) const {
    ShiftedPoints points;
    for (std::size_t f = 1; f + 1 < truth_.FrameCount(); f += stride) {
      const double at = (static_cast<double>(f) / truth_rate_hz_ + shift_s) * answer_rate_hz_;
      for (std::size_t j = 0; j < truth_.points; ++j) {
        const glm::dvec3 found = CubicAt(answer_, at, j), truth = truth_.Frame(f)[j];
        const glm::dvec3 velocity = 0.5 * truth_rate_hz_ * (truth_.Frame(f + 1)[j] - truth_.Frame(f - 1)[j]);
        if (std::isnan(found.x + truth.x + velocity.x)) continue;
        points.found.push_back(found);
        points.truth.push_back(truth);
        points.velocity.push_back(velocity);
        points.frames.push_back(f);
      }
    }
    return points;
  }

  /// Moves the answer's points onto the truth's as a whole, and returns what is left of each.
  static std::vector<glm::dvec3> Rests(const ShiftedPoints& points) {
    Similarity fit = AlignSimilarity(points.found, points.truth);
    glm::dvec3 of_found(0), of_truth(0);
    for (std::size_t i = 0; i < points.found.size(); ++i) {
      of_found += points.found[i];
      of_truth += points.truth[i];
    }
    fit.scale = 1;
    fit.translation = (of_truth - fit.rotation * of_found) / static_cast<double>(points.found.size());
    std::vector<glm::dvec3> rests;
    for (std::size_t i = 0; i < points.found.size(); ++i) {
      rests.push_back(fit.Apply(points.found[i]) - points.truth[i]);
    }
    return rests;
  }

  /// Returns the shift in whole frames of the truth that fits best, unless it is the largest.
  std::optional<int> FindWholeFrames() const {
    constexpr std::size_t kMaxCompared = 1000;  // frames
    const std::size_t stride = 1 + truth_.FrameCount() / kMaxCompared;
    const std::size_t least = std::max<std::size_t>(kMinPoints, PointsAt(0, stride).found.size() / 2);
    const int reach = static_cast<int>(std::floor(kMaxTimeShift_s * truth_rate_hz_));
    std::optional<int> best;
    double smallest = std::numeric_limits<double>::infinity();
    // From the smallest shift on: of two that fit alike, the smaller is taken.
    for (int at = 0; at <= 2 * reach; ++at) {
      const int shift = at % 2 == 0 ? -at / 2 : (at + 1) / 2;
      const ShiftedPoints points = PointsAt(shift / truth_rate_hz_, stride);
      if (points.found.size() < least) continue;
      double sum = 0;
      for (const glm::dvec3& rest : Rests(points)) sum += glm::dot(rest, rest);
      const double mean = sum / static_cast<double>(points.found.size());
      if (mean < smallest) best = shift;
      smallest = std::min(mean, smallest);
    }
    if (!best || std::abs(*best) == reach) return std::nullopt;
    return best;
  }

  /// Takes out of the velocities what a movement as a whole explains. Returns nothing if little is left.
  static std::optional<std::vector<glm::dvec3>> OwnVelocities(const ShiftedPoints& points) {
    constexpr double kMinLeft = 1e-6;  // of the squares
    glm::dvec3 centre(0);
    for (const glm::dvec3& p : points.truth) centre += p / static_cast<double>(points.truth.size());
    // Least squares: velocity = rate of translation + rotation × arm.
    const auto jacobian = [&](std::size_t i) {
      const glm::dvec3 arm = points.truth[i] - centre;
      Eigen::Matrix<double, 3, 6> rows = Eigen::Matrix<double, 3, 6>::Zero();
      rows.leftCols<3>().setIdentity();
      rows.rightCols<3>() << 0, arm.z, -arm.y, -arm.z, 0, arm.x, arm.y, -arm.x, 0;
      return rows;
    };
    const auto column = [](const glm::dvec3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    double before = 0, after = 0;
    for (std::size_t i = 0; i < points.truth.size(); ++i) {
      const auto rows = jacobian(i);
      normal += rows.transpose() * rows;
      right += rows.transpose() * column(points.velocity[i]);
      before += glm::dot(points.velocity[i], points.velocity[i]);
    }
    const Vector6 movement = normal.ldlt().solve(right);
    std::vector<glm::dvec3> own;
    for (std::size_t i = 0; i < points.truth.size(); ++i) {
      const Eigen::Vector3d left = column(points.velocity[i]) - jacobian(i) * movement;
      own.emplace_back(left.x(), left.y(), left.z());
      after += left.squaredNorm();
    }
    if (!(after > kMinLeft * before)) return std::nullopt;
    return own;
  }

  std::optional<TimeShift> Refine(double shift_s) const {
    constexpr int kMaxSteps = 50;
    constexpr double kSettled_s = 1e-10;
    const double start_s = shift_s;
    for (int step = 0; step < kMaxSteps; ++step) {
      const ShiftedPoints points = PointsAt(shift_s, 1);
      if (points.found.size() < kMinPoints) return std::nullopt;
      const auto own = OwnVelocities(points);
      if (!own) return std::nullopt;
      const std::vector<glm::dvec3> rests = Rests(points);
      double product = 0, square = 0;
      for (std::size_t i = 0; i < rests.size(); ++i) {
        product += glm::dot((*own)[i], rests[i]);
        square += glm::dot((*own)[i], (*own)[i]);
      }
      const double change_s = -product / square;
      shift_s += change_s;
      if (std::abs(shift_s - start_s) > 2 / truth_rate_hz_) return std::nullopt;  // leaves the best whole frame
      if (std::abs(change_s) < kSettled_s) return TimeShift{shift_s, HalfWidth(points, *own, rests, square)};
    }
    return std::nullopt;
  }

  /// Returns half the width of the jackknife's interval over equal parts of the motion.
  static std::optional<double> HalfWidth(const ShiftedPoints& points, const std::vector<glm::dvec3>& own,
                                         const std::vector<glm::dvec3>& rests, double square) {
    constexpr std::size_t kParts = 10, kMinFrames = 3;  // a part has at least three
    constexpr double kStudent = 2.2621571628;           // t, 97.5 %, nine degrees of freedom
    const std::size_t first = points.frames.front(), frames = points.frames.back() - first + 1;
    if (frames < kParts * kMinFrames) return std::nullopt;
    std::array<double, kParts> products{};
    for (std::size_t i = 0; i < rests.size(); ++i) {
      products[(points.frames[i] - first) * kParts / frames] += glm::dot(own[i], rests[i]);
    }
    double variance = 0;
    for (const double product : products) variance += product * product / (square * square);
    return kStudent * std::sqrt(variance * kParts / (kParts - 1));
  }

  static constexpr std::size_t kMinPoints = 15;  // five frames of three joints

  const PointTracks &truth_, &answer_;
  const double truth_rate_hz_, answer_rate_hz_;
};

}  // namespace

std::optional<TimeShift> FindTimeShift(const PointTracks& truth, double truth_rate_hz, const PointTracks& answer,
                                       double answer_rate_hz) {
  constexpr std::size_t kMinJoints = 3;
  if (truth.points < kMinJoints || truth.points != answer.points) return std::nullopt;
  return ShiftFinder(truth, truth_rate_hz, answer, answer_rate_hz).Find();
}

}  // namespace etude
