#include "engine/recognition/measuring_recogniser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

constexpr double kUnaligned = std::numeric_limits<double>::infinity();

/// An example of a move, and the largest number of steps that a performance of the move may last.
struct TaughtExample {
  std::size_t move;
  std::vector<PoseVector> pattern;
  int longest;
  PoseVector middle;  ///< the mean of the pattern
};

/// A ring buffer of the last seen steps, indexed by step number.
class RecentSteps {
 public:
  explicit RecentSteps(std::size_t kept) : steps_(kept) {}

  void Add(const PoseVector& step) { steps_[static_cast<std::size_t>(count_++) % steps_.size()] = step; }
  int Count() const { return count_; }
  const PoseVector& operator[](int number) const { return steps_[static_cast<std::size_t>(number) % steps_.size()]; }

 private:
  std::vector<PoseVector> steps_;
  int count_ = 0;
};

/// Keeps each move's lowest alignment cost of the last second.
class RecentCosts {
 public:
  explicit RecentCosts(std::size_t moves) : moves_(moves), costs_(moves * kKept, kUnaligned) {}

  void Next() {
    std::fill_n(costs_.begin() + static_cast<std::ptrdiff_t>(++step_ % kKept * moves_), moves_, kUnaligned);
  }
  void Lower(std::size_t move, double cost) {
    double& known = costs_[step_ % kKept * moves_ + move];
    known = std::min(known, cost);
  }
  /// Returns the lowest cost of all moves other than `move`.
  double LowestOther(std::size_t move) const {
    double lowest = kUnaligned;
    for (std::size_t i = 0; i < costs_.size(); ++i) {
      if (i % moves_ != move) lowest = std::min(lowest, costs_[i]);
    }
    return lowest;
  }

 private:
  static constexpr std::size_t kKept = 15;  // number of steps: one second
  std::size_t moves_, step_ = 0;
  std::vector<double> costs_;
};

class MeasuringFollower final : public StepFollower {
 public:
  MeasuringFollower(const std::vector<TaughtExample>& examples, std::size_t moves, const TrackingWeights& weights,
                    const PerformanceJudge& judge, double rate_hz)
      : StepFollower(PoseParts::kLimbs, weights, moves, rate_hz),
        examples_(examples),
        judge_(judge),
        is_alone_(moves == 1),
        steps_(LongestOf(examples)),
        costs_(std::max<std::size_t>(moves, 1)) {
    for (const TaughtExample& example : examples) always_.emplace_back(example.pattern, example.longest);
  }

 private:
  static std::size_t LongestOf(const std::vector<TaughtExample>& examples) {
    int longest = 1;
    for (const TaughtExample& example : examples) longest = std::max(longest, example.longest);
    return static_cast<std::size_t>(longest);
  }

  void Open(std::optional<std::size_t> move) override {
    if (nearest_in_window_) usual_.Add(*nearest_in_window_);
    nearest_in_window_.reset();
    nearest_cost_ = kUnaligned;
    in_window_.clear();
    opened_at_ = steps_.Count();
    for (const TaughtExample& example : examples_) {
      if (example.move != move) continue;
      in_window_.push_back({&example,
                            {example.pattern, example.longest},
                            ClockComparison(example.pattern),
                            RigidComparison(example.pattern)});
    }
  }

  double Take(const PoseVector& step, std::span<double> spotted) override {
    // Update every example's aligner and find the example of the lowest cost.
    steps_.Add(step);
    costs_.Next();
    std::size_t nearest = 0;
    double lowest = kUnaligned;
    for (std::size_t i = 0; i < examples_.size(); ++i) {
      always_[i].Update(step);
      const double cost = always_[i].Cost();
      costs_.Lower(examples_[i].move, cost);
      if (cost < lowest) {
        lowest = cost;
        nearest = i;
      }
    }
    // Judge the move of lowest cost as a performance that nobody asked for.
    if (lowest < kUnaligned) {
      const TaughtExample& example = examples_[nearest];
      spotted[example.move] =
          judge_(PerformanceOrigin::kSpotted, example.move, MeasureNow(example, always_[nearest], 0, nullptr));
    }
    // Judge every example of the asked move, and remember the measures of the best alignment in this window.
    double evidence = 0;
    for (InWindow& window : in_window_) {
      auto& [example, aligner, clock, rigid] = window;
      aligner.Update(step);
      clock.Update(step);
      rigid.Update(step);
      if (aligner.Cost() == kUnaligned) continue;
      const PerformanceMeasures measures = MeasureNow(*example, aligner, opened_at_, &window);
      evidence = std::max(evidence, judge_(PerformanceOrigin::kAsked, example->move, measures));
      if (aligner.Cost() < nearest_cost_) {
        nearest_cost_ = aligner.Cost();
        nearest_in_window_ = measures;
      }
    }
    return evidence;
  }

  struct InWindow {
    const TaughtExample* example;
    SubsequenceAligner aligner;
    ClockComparison clock;
    RigidComparison rigid;
  };

  /// Measures the best alignment that ends now. `first` is the number, in `steps_`, of the aligner's first step.
  /// `window` is null for a spotted performance, whose comparisons with the window (kClockSlice, kRigidSlice) are 0.
  PerformanceMeasures MeasureNow(const TaughtExample& example, const SubsequenceAligner& aligner, int first,
                                 const InWindow* window) const {
    const std::vector<StepPair> path = aligner.Path();
    const auto seen = [&](int number) -> const PoseVector& { return steps_[first + number]; };
    // If only one move was taught, there are no other moves; compare with holding still instead.
    double other = costs_.LowestOther(example.move);
    if (is_alone_) other = CostOfHolding(example, path, seen);
    PerformanceMeasures measures =
        Measure({.path = path, .seen = seen, .pattern = example.pattern, .cost = aligner.Cost(), .other_cost = other});
    if (window != nullptr) {
      std::ranges::copy(window->clock.Measure(usual_.Shift()).All(), measures.begin() + kClockSlice.first);
      std::ranges::copy(window->rigid.Measure(usual_.Shift()), measures.begin() + kRigidSlice.first);
    }
    // Compare each measure with the performer's usual measures.
    usual_.Relate(measures);
    if (window == nullptr) std::fill(measures.begin() + kClockSlice.first, measures.end(), 0.0);
    return measures;
  }

  /// Returns the cost of holding still in the example's mean pose along `path`. It replaces the costs of other moves if
  /// only one move was taught.
  static double CostOfHolding(const TaughtExample& example, std::span<const StepPair> path,
                              const std::function<const PoseVector&(int)>& seen) {
    double cost = 0;
    for (const StepPair& pair : path) cost += SquaredDistance(seen(pair.seen), example.middle);
    return cost / static_cast<double>(example.pattern.size());
  }

  const std::vector<TaughtExample>& examples_;
  const PerformanceJudge& judge_;
  bool is_alone_;
  RecentSteps steps_;
  RecentCosts costs_;
  std::vector<SubsequenceAligner> always_;  // one aligner per example
  std::vector<InWindow> in_window_;
  int opened_at_ = 0;
  PersonBaseline usual_;
  std::optional<PerformanceMeasures> nearest_in_window_;
  double nearest_cost_ = kUnaligned;
};

}  // namespace

std::unique_ptr<Recogniser> MakeMeasuringRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                    PerformanceJudge judge) {
  std::vector<TaughtExample> examples;
  for (std::size_t move = 0; move < taught.size(); ++move) {
    const int longest = static_cast<int>(std::ceil(taught[move].span_s * kStepsPerSecond));
    for (const SkeletonStream& stream : taught[move].examples) {
      auto pattern = DescribeStream(stream, PoseParts::kLimbs);
      if (pattern.empty()) continue;
      const PoseVector middle = MeanOf(pattern);
      examples.push_back({move, std::move(pattern), longest, middle});
    }
  }
  return MakeRecogniser(
      [examples = std::move(examples), moves = taught.size(), weights, judge = std::move(judge)](double rate_hz) {
        return std::make_unique<MeasuringFollower>(examples, moves, weights, judge, rate_hz);
      });
}

}  // namespace etude
