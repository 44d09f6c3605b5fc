#include "engine/recognition/whole_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The units of distance: the median distance between two people who do the same move. Joint distances are in metres;
/// limb distances are lengths of differences of unit vectors. The medians were measured on six people in front of an
/// OpenNI sensor, each performance against the nearest one by another person. Distances in this file are squared and in
/// these units.
constexpr double kJointUnit = 0.08, kLimbUnit = 0.15;
/// The number of nearest examples whose distances are averaged, because a single example may be unusual.
constexpr std::size_t kNearestExamples = kExamplesOfWholeBody;

/// A body in one step: joint positions and limb directions in one array, with a weight per number.
struct WholePose {
  static constexpr std::size_t kNumbers = 2 * 3 * kPosePartCount;
  std::array<float, kNumbers> numbers{}, weights{};
};
using WholePattern = std::vector<WholePose>;

WholePose WholePoseOf(const PoseVector& joints, const PoseVector& limbs) {
  WholePose whole;
  std::size_t next = 0;
  const auto add = [&](const PoseVector& pose, double unit) {
    double total = 0;
    for (const double weight : pose.weights) total += weight;
    const double scale = total > 0 ? 0.5 / (total * unit * unit) : 0;
    for (std::size_t i = 0; i < kPosePartCount; ++i) {
      for (int axis = 0; axis < 3; ++axis, ++next) {
        whole.numbers[next] = static_cast<float>(pose.parts[i][axis]);
        whole.weights[next] = static_cast<float>(scale * pose.weights[i]);
      }
    }
  };
  add(joints, kJointUnit);
  add(limbs, kLimbUnit);
  return whole;
}

/// Returns the squared distance with the weights of `seen`. Eight partial sums fix the order of additions, so that
/// vectorised code gives the same bits.
double SquaredDistanceOf(const WholePose& seen, const WholePose& taught) {
  constexpr std::size_t kLanes = 8;
  static_assert(WholePose::kNumbers % kLanes == 0);
  std::array<float, kLanes> sums{};
  for (std::size_t i = 0; i < WholePose::kNumbers; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const float gap = seen.numbers[i + lane] - taught.numbers[i + lane];
      sums[lane] += seen.weights[i + lane] * gap * gap;
    }
  }
  float sum = 0;
  for (const float lane : sums) sum += lane;
  return sum;
}

/// Compares a stream with one example, and computes two distances from the example. For the first distance, the example
/// is compared with the most similar passage of the stream that ends now (as in SubsequenceAligner, but without the
/// path). For the second distance, the example is compared with the whole stream, as if it were one performance.
class ExampleDistance {
 public:
  ExampleDistance(const WholePattern& pattern, int longest)
      : pattern_(&pattern), longest_(longest), passage_(pattern.size(), kInfinity), whole_(pattern.size(), kInfinity) {
    starts_.resize(pattern.size());
  }

  void Update(const WholePose& seen);
  /// Returns the distance between the example and the most similar passage that ends at the last seen step.
  double Passage() const { return passage_.back() / static_cast<double>(pattern_->size()); }
  /// Returns the distance between the example and the whole stream so far (symmetric dynamic time warping).
  double Whole() const { return whole_.back() / static_cast<double>(pattern_->size() + count_); }
  /// Returns the number of seen steps divided by the number of steps in the example.
  double SharePassed() const { return static_cast<double>(count_) / static_cast<double>(pattern_->size()); }

 private:
  const WholePattern* pattern_;
  int longest_;
  std::size_t count_ = 0;  // number of seen steps
  std::vector<double> passage_, whole_;
  std::vector<int> starts_;
};

void ExampleDistance::Update(const WholePose& seen) {
  const int now = static_cast<int>(count_++);
  double diagonal = now == 0 ? 0 : kInfinity, left = kInfinity;
  // The costs at pattern steps j - 1 and j - 2 before this update; a passage may skip one pattern step.
  double passage_before = 0, passage_before_that = 0, gap_before = 0;
  int start_before = 0, start_before_that = 0;
  for (std::size_t j = 0; j < pattern_->size(); ++j) {
    // Update `whole_[j]`: extend the symmetric warping path; a diagonal step counts twice.
    const double gap = SquaredDistanceOf(seen, (*pattern_)[j]);
    left = std::min({diagonal + 2 * gap, whole_[j] + gap, left + gap});
    diagonal = whole_[j];
    whole_[j] = left;

    // Update `passage_[j]`: a passage stays at pattern step j, advances to j by one or two steps, or begins (j = 0).
    const double stayed = passage_[j];
    const int stayed_start = starts_[j];
    double best = stayed;
    int start = stayed_start;
    if (j >= 1 && passage_before < best) {
      best = passage_before;
      start = start_before;
    }
    if (j >= 2 && passage_before_that + gap_before < best) {
      best = passage_before_that + gap_before;
      start = start_before_that;
    }
    if (j == 0) {
      best = 0;
      start = now;
    }
    // Give a passage that is too long an infinite cost. Store the old costs for the next pattern steps.
    passage_[j] = now - start >= longest_ ? kInfinity : best + gap;
    starts_[j] = start;
    passage_before_that = passage_before;
    start_before_that = start_before;
    passage_before = stayed;
    start_before = stayed_start;
    gap_before = gap;
  }
}

/// A move's examples and their mirror images.
struct WholeMove {
  std::vector<WholePattern> examples, images;
  int longest = 1;
  bool has_sides = false;  ///< false if the move is its own mirror image

  static std::vector<ExampleDistance> Follow(const std::vector<WholePattern>& patterns, int longest) {
    std::vector<ExampleDistance> distances;
    for (const WholePattern& pattern : patterns) distances.emplace_back(pattern, longest);
    return distances;
  }
};

/// Returns true if the examples' median squared distance from their own mirror images exceeds twice the usual squared
/// distance between two people.
bool HasSides(const WholeMove& move) {
  constexpr double kOwnImage = 2;
  std::vector<double> nearest;
  for (std::size_t i = 0; i < move.examples.size(); ++i) {
    ExampleDistance distance(move.examples[i], move.longest);
    nearest.push_back(kInfinity);
    for (const WholePose& pose : move.images[i]) {
      distance.Update(pose);
      nearest.back() = std::min(nearest.back(), distance.Passage());
    }
  }
  return !nearest.empty() && UpperMedian(std::move(nearest)) > kOwnImage;
}

WholeMove WholeMoveOf(const TaughtMove& taught) {
  WholeMove move;
  move.longest = static_cast<int>(std::ceil(taught.span_s * kStepsPerSecond));
  for (const SkeletonStream& stream : taught.examples) {
    const auto joints = DescribeStream(stream, PoseParts::kJoints), limbs = DescribeStream(stream, PoseParts::kLimbs);
    if (joints.empty()) continue;
    WholePattern &example = move.examples.emplace_back(), &image = move.images.emplace_back();
    for (std::size_t t = 0; t < joints.size(); ++t) {
      example.push_back(WholePoseOf(joints[t], limbs[t]));
      image.push_back(WholePoseOf(Mirrored(joints[t], PoseParts::kJoints), Mirrored(limbs[t], PoseParts::kLimbs)));
    }
  }
  move.has_sides = HasSides(move);
  return move;
}

/// Returns the mean distance of the nearest examples.
template <typename Measure>
double NearestMean(const std::vector<ExampleDistance>& examples, Measure measure) {
  std::array<double, kNearestExamples> nearest;
  nearest.fill(kInfinity);
  for (const ExampleDistance& example : examples) {
    double distance = measure(example);
    for (double& kept : nearest) {
      if (distance < kept) std::swap(distance, kept);
    }
  }
  const std::size_t count = std::min(kNearestExamples, examples.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += nearest[i];
  return count > 0 ? sum / static_cast<double>(count) : kInfinity;
}

double PassageOf(const ExampleDistance& example) { return example.Passage(); }
double WholeOf(const ExampleDistance& example) { return example.Whole(); }

/// Keeps the lowest distance of a move within the last second.
class LatelyLowest {
 public:
  LatelyLowest() { kept_.fill(kInfinity); }
  void Add(double distance) { kept_[next_++ % kept_.size()] = distance; }
  double Value() const { return *std::ranges::min_element(kept_); }

 private:
  std::array<double, static_cast<std::size_t>(kStepsPerSecond)> kept_;
  std::size_t next_ = 0;
};

class WholeBodyFollower final : public MoveFollower {
 public:
  WholeBodyFollower(const std::vector<WholeMove>& moves, const TrackingWeights& weights, const Recogniser& judge,
                    bool judge_spots, double rate_hz)
      : moves_(moves),
        judge_(judge.Follow(rate_hz)),
        judge_spots_(judge_spots),
        joints_(PoseParts::kJoints, weights, rate_hz),
        limbs_(PoseParts::kLimbs, weights, rate_hz),
        lately_(moves.size()),
        spotted_(moves.size(), 0.0) {
    for (const WholeMove& move : moves) always_.push_back(WholeMove::Follow(move.examples, move.longest));
  }

  void Ask(std::optional<std::size_t> move) override {
    judge_->Ask(move);
    best_ = 0;
    right_ = image_ = kInfinity;
    in_window_.clear();
    images_.clear();
    if (!move || !moves_[*move].has_sides) return;
    in_window_ = WholeMove::Follow(moves_[*move].examples, moves_[*move].longest);
    images_ = WholeMove::Follow(moves_[*move].images, moves_[*move].longest);
  }

  Evidence Update(const SeenFrame& frame) override {
    const Evidence judged = judge_->Update(frame);
    const int completed = joints_.Update(frame);
    limbs_.Update(frame);
    if (completed > 0) std::ranges::fill(spotted_, 0.0);
    for (int i = 0; i < completed && joints_.Step(); ++i) Take(WholePoseOf(*joints_.Step(), *limbs_.Step()));
    if (MayShowItsSide()) best_ = std::max(best_, judged.asked * RightSide());
    return {.asked = best_, .spotted = judge_spots_ ? judged.spotted : spotted_};
  }

  std::optional<std::size_t> Whole() const override {
    std::optional<std::size_t> nearest;
    double lowest = kInfinity;
    for (std::size_t move = 0; move < always_.size(); ++move) {
      const double distance = NearestMean(always_[move], WholeOf);
      if (distance >= lowest) continue;
      lowest = distance;
      nearest = move;
    }
    return nearest;
  }

 private:
  void Take(const WholePose& step) {
    for (std::size_t move = 0; move < always_.size(); ++move) {
      for (ExampleDistance& example : always_[move]) example.Update(step);
      lately_[move].Add(NearestMean(always_[move], PassageOf));
    }
    for (ExampleDistance& example : in_window_) example.Update(step);
    for (ExampleDistance& image : images_) image.Update(step);
    right_ = std::min(right_, NearestMean(in_window_, PassageOf));
    image_ = std::min(image_, NearestMean(images_, PassageOf));
    if (!judge_spots_) Spot();
  }

  void Spot() {
    // Another person's performance of a move is rarely farther than this: 19 of 20 are within 3.4 squared units (six
    // people in front of an OpenNI sensor).
    constexpr double kMaxOtherDistance = 4;
    for (std::size_t move = 0; move < always_.size(); ++move) {
      double other = kMaxOtherDistance;
      for (std::size_t i = 0; i < lately_.size(); ++i) {
        if (i != move) other = std::min(other, lately_[i].Value());
      }
      const double both = NearestMean(always_[move], PassageOf) + other;
      spotted_[move] = std::isfinite(both) && both > 0 ? other / both : 0.0;
    }
  }

  /// Returns true if three quarters of the shortest example have passed since the window opened. Before
  /// that time, a move and its mirror image look alike, so the evidence stays 0.
  bool MayShowItsSide() const {
    constexpr double kShowsItsSide = 0.75;
    return in_window_.empty() || std::ranges::any_of(in_window_, [](const ExampleDistance& example) {
             return example.SharePassed() >= kShowsItsSide;
           });
  }

  /// Returns 1 if the examples were nearer than their mirror images so far, otherwise the squared ratio of the two
  /// distances.
  double RightSide() const {
    if (!(image_ < right_)) return 1;
    return image_ / right_ * (image_ / right_);
  }

  const std::vector<WholeMove>& moves_;
  std::unique_ptr<MoveFollower> judge_;
  bool judge_spots_;
  StepDescriber joints_, limbs_;
  std::vector<std::vector<ExampleDistance>> always_;  // for each move, one ExampleDistance per example
  std::vector<LatelyLowest> lately_;                  // for each move, its lowest distance in the last second
  std::vector<ExampleDistance> in_window_, images_;   // the asked move's examples, and their mirror images
  double right_ = kInfinity, image_ = kInfinity;      // lowest in the window: to an example; to a mirror image
  double best_ = 0;                                   // evidence of the performance asked for
  std::vector<double> spotted_;
};

}  // namespace

std::unique_ptr<Recogniser> MakeWholeBodyRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    std::unique_ptr<Recogniser> judge) {
  std::vector<WholeMove> moves;
  for (const TaughtMove& move : taught) moves.push_back(WholeMoveOf(move));
  const bool judge_spots =
      std::ranges::any_of(moves, [](const WholeMove& move) { return move.examples.size() < kNearestExamples; });
  return MakeRecogniser([moves = std::move(moves), weights, judge = std::move(judge), judge_spots](double rate_hz) {
    return std::make_unique<WholeBodyFollower>(moves, weights, *judge, judge_spots, rate_hz);
  });
}

}  // namespace etude
