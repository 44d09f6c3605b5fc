#include "engine/recognition/example_recognisers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/recognition/alignment.h"
#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

/// The examples of one move, and the largest number of steps that a performance of the move may last.
struct Examples {
  std::vector<std::vector<PoseVector>> patterns;
  int longest = 0;

  std::vector<SubsequenceAligner> Aligners() const {
    std::vector<SubsequenceAligner> aligners;
    for (const auto& pattern : patterns) aligners.emplace_back(pattern, longest);
    return aligners;
  }
};

class DtwFollower final : public StepFollower {
 public:
  DtwFollower(const std::vector<Examples>& moves, const TrackingWeights& weights, const DtwOptions& options,
              double rate_hz)
      : StepFollower(PoseParts::kJoints, weights, moves.size(), rate_hz), moves_(moves), options_(options) {
    for (const Examples& move : moves) always_.push_back(move.Aligners());
  }

 private:
  void Open(std::optional<std::size_t> move) override {
    in_window_ = move ? moves_[*move].Aligners() : std::vector<SubsequenceAligner>();
  }

  double Take(const PoseVector& step, std::span<double> spotted) override {
    for (std::size_t i = 0; i < spotted.size(); ++i) spotted[i] = Nearest(always_[i], step);
    return Nearest(in_window_, step);
  }

  double Nearest(std::vector<SubsequenceAligner>& aligners, const PoseVector& step) const {
    double evidence = 0;
    const double half_at = options_.half_at_cm / 100;
    for (SubsequenceAligner& aligner : aligners) {
      aligner.Update(step);
      evidence = std::max(evidence, 1.0 / (1.0 + aligner.Cost() / (half_at * half_at)));
    }
    return evidence;
  }

  const std::vector<Examples>& moves_;
  const DtwOptions& options_;
  std::vector<std::vector<SubsequenceAligner>> always_;  // for each move, one aligner per example; they are never reset
  std::vector<SubsequenceAligner> in_window_;
};

using Pattern = std::vector<PoseVector>;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// If no known motion is nearer, a move competes with an unknown motion at this distance, metres. In 19 of 20 cases,
/// another person's performance of a move is nearer to the move's examples than this (simulated people,
/// tests/sim/performer). In recordings of real people, the median distance of another person's performance is 10 cm
/// in one set and 16–28 cm in another.
constexpr double kUnknownMotionDistance = 0.21;

/// An example of a move and the wrong patterns that it is compared with. All have the same number of steps.
struct Example {
  std::size_t move;
  Pattern right;
  std::vector<Pattern> wrong;  ///< the mirrored example and the example at half its amplitude
  PoseVector middle;           ///< the example's mean pose, which represents a person who holds still
};

/// Returns a standing body with paper B's proportions, a trunk of 50 cm and hanging arms.
PoseVector Standing() {
  PoseVector pose;
  pose.parts = {{{0, 0.75, 0},
                 {0.18, 0.5, 0},
                 {-0.18, 0.5, 0},
                 {0.18, 0.21, 0},
                 {-0.18, 0.21, 0},
                 {0.18, -0.04, 0},
                 {-0.18, -0.04, 0},
                 {0.09, -0.43, 0},
                 {-0.09, -0.43, 0},
                 {0.09, -0.85, 0},
                 {-0.09, -0.85, 0},
                 {0, 0, 0}}};
  return pose;
}

template <typename Change>
Pattern Changed(const Pattern& pattern, Change change) {
  Pattern changed;
  for (const PoseVector& pose : pattern) changed.push_back(change(pose));
  return changed;
}

PoseVector Halved(const PoseVector& pose) {
  static const PoseVector standing = Standing();
  PoseVector halved = pose;
  for (std::size_t i = 0; i < kPosePartCount; ++i) halved.parts[i] = 0.5 * (pose.parts[i] + standing.parts[i]);
  return halved;
}

/// Returns the root mean squared distance between the last steps of `seen` and `pattern`. Returns kFar if `seen` is
/// shorter than the pattern, or if the distance exceeds `farthest`; because of this limit, most comparisons stop after
/// a few steps.
double Distance(std::span<const PoseVector> seen, const Pattern& pattern, double farthest = kFar) {
  if (seen.size() < pattern.size()) return kFar;
  const auto end = seen.last(pattern.size());
  const auto steps = static_cast<double>(pattern.size());
  constexpr double kRounding = 1 + 1e-9;  // rounding must not reject a pattern at exactly `farthest`
  const double max_sum = kRounding * farthest * farthest * steps;
  double sum = 0;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    sum += SquaredDistance(end[i], pattern[i]);
    if (sum > max_sum) return kFar;
  }
  return std::sqrt(sum / steps);
}

Example ExampleOf(std::size_t move, Pattern right) {
  constexpr double kOwnImage = 0.03;  // distance, metres; a move this close to its mirror image has no wrong side
  Example example{.move = move, .right = std::move(right), .wrong = {}, .middle = {}};
  example.middle = MeanOf(example.right);
  Pattern mirrored = Changed(example.right, [](const PoseVector& pose) { return Mirrored(pose, PoseParts::kJoints); });
  if (Distance(mirrored, example.right) > kOwnImage) example.wrong.push_back(std::move(mirrored));
  example.wrong.push_back(Changed(example.right, Halved));
  return example;
}

/// Compares the last steps with one held pose.
class Stillness {
 public:
  Stillness(const PoseVector& pose, std::size_t longest) : pose_(pose), gaps_(longest) {}

  void Update(const PoseVector& step) { gaps_[count_++ % gaps_.size()] = SquaredDistance(step, pose_); }
  /// Returns the root mean squared distance over the last `steps` steps; kFar if fewer were seen.
  double Distance(std::size_t steps) const {
    if (count_ < steps) return kFar;
    double sum = 0;
    for (std::size_t i = count_ - steps; i < count_; ++i) sum += gaps_[i % gaps_.size()];
    return std::sqrt(sum / static_cast<double>(steps));
  }

 private:
  PoseVector pose_;
  std::size_t count_ = 0;
  std::vector<double> gaps_;  // ring of the last squared distances to the pose
};

class NearestFollower final : public StepFollower {
 public:
  NearestFollower(const std::vector<Example>& examples, std::size_t moves, const TrackingWeights& weights, double rate_hz)
      : StepFollower(PoseParts::kJoints, weights, moves, rate_hz),
        examples_(examples),
        right_(moves),
        wrong_(moves),
        held_still_(moves),
        longest_(LongestOf(examples)),
        standing_(Standing(), longest_) {
    for (const Example& example : examples) held_.emplace_back(example.middle, longest_);
  }

 private:
  static std::size_t LongestOf(const std::vector<Example>& examples) {
    std::size_t longest = 1;
    for (const Example& example : examples) longest = std::max(longest, example.right.size());
    return longest;
  }

  void Open(std::optional<std::size_t>) override { since_open_ = 0; }

  double Take(const PoseVector& step, std::span<double> spotted) override {
    // Add the step to the window of the last `longest_` steps and reset the per-move distances.
    if (seen_.size() == longest_) seen_.erase(seen_.begin());
    seen_.push_back(step);
    ++since_open_;
    std::ranges::fill(right_, kFar);
    std::ranges::fill(wrong_, kFar);
    std::ranges::fill(held_still_, kFar);
    bool fits_in_window = false;
    // For each move, find the distance to the nearest right example, and to the nearest wrong pattern or held pose.
    standing_.Update(step);
    for (std::size_t i = 0; i < examples_.size(); ++i) {
      const Example& example = examples_[i];
      const std::size_t steps = example.right.size();
      double &right = right_[example.move], &wrong = wrong_[example.move], &still = held_still_[example.move];
      held_[i].Update(step);
      wrong = std::min(wrong, standing_.Distance(steps));
      still = std::min(still, held_[i].Distance(steps));
      right = std::min(right, Distance(seen_, example.right, right));
      for (const Pattern& pattern : example.wrong) wrong = std::min(wrong, Distance(seen_, pattern, wrong));
      fits_in_window |= asked() == example.move && example.right.size() <= since_open_;
    }
    // If the move was not requested, two more alternatives compete with it: an unknown motion, and a person who holds
    // still.
    for (std::size_t move = 0; move < spotted.size(); ++move) {
      spotted[move] = EvidenceAgainst(std::min(held_still_[move], kUnknownMotionDistance), move);
    }
    // The requested move has evidence only if the window is long enough for one of its examples.
    return fits_in_window ? EvidenceAgainst(kFar, *asked()) : 0.0;
  }

  /// Returns the evidence n / (r + n) for a move: r is the distance to its nearest right example; n is the smallest of
  /// `other` and the distances to the move's wrong patterns and to the other moves' right examples.
  double EvidenceAgainst(double other, std::size_t move) const {
    if (right_[move] == kFar) return 0;
    other = std::min(other, wrong_[move]);
    for (std::size_t i = 0; i < right_.size(); ++i) {
      if (i != move) other = std::min(other, right_[i]);
    }
    const double both = right_[move] + other;
    return both > 0 ? other / both : 0.5;
  }

  const std::vector<Example>& examples_;
  // For each move, its distances in this step: to the nearest right example, wrong pattern and held pose.
  std::vector<double> right_, wrong_, held_still_;
  std::size_t longest_, since_open_ = 0;
  Stillness standing_;
  std::vector<Stillness> held_;   // for each example: compares the last steps with the example's mean pose
  std::vector<PoseVector> seen_;  // the last `longest_` steps
};

}  // namespace

std::unique_ptr<Recogniser> MakeDtwRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                              const DtwOptions& options) {
  std::vector<Examples> moves;
  for (const TaughtMove& move : taught) {
    Examples& examples = moves.emplace_back();
    examples.longest = static_cast<int>(std::ceil(move.span_s * kStepsPerSecond));
    for (const SkeletonStream& example : move.examples) {
      auto pattern = DescribeStream(example, PoseParts::kJoints);
      if (!pattern.empty()) examples.patterns.push_back(std::move(pattern));
    }
  }
  return MakeRecogniser([moves = std::move(moves), weights, options](double rate_hz) {
    return std::make_unique<DtwFollower>(moves, weights, options, rate_hz);
  });
}

std::unique_ptr<Recogniser> MakeNearestRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights) {
  std::vector<Example> examples;
  for (std::size_t move = 0; move < taught.size(); ++move) {
    for (const SkeletonStream& stream : taught[move].examples) {
      Pattern right = DescribeStream(stream, PoseParts::kJoints);
      if (!right.empty()) examples.push_back(ExampleOf(move, std::move(right)));
    }
  }
  return MakeRecogniser([examples = std::move(examples), moves = taught.size(), weights](double rate_hz) {
    return std::make_unique<NearestFollower>(examples, moves, weights, rate_hz);
  });
}

}  // namespace etude
