#include "engine/recognition/dtw.h"

#include <algorithm>
#include <cmath>

#include "engine/recognition/alignment.h"
#include "engine/recognition/step_follower.h"

namespace etude {
namespace {

/// One move's examples, and how many steps a performance of it may last.
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
  DtwFollower(const std::vector<Examples>& moves, const SightWeights& weights, const DtwOptions& options,
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
  std::vector<std::vector<SubsequenceAligner>> always_;  // per move
  std::vector<SubsequenceAligner> in_window_;
};

class DtwRecogniser final : public Recogniser {
 public:
  DtwRecogniser(std::vector<Examples> moves, const SightWeights& weights, const DtwOptions& options)
      : moves_(std::move(moves)), weights_(weights), options_(options) {}

  std::unique_ptr<MoveFollower> Follow(double rate_hz) const override {
    return std::make_unique<DtwFollower>(moves_, weights_, options_, rate_hz);
  }

 private:
  std::vector<Examples> moves_;
  SightWeights weights_;
  DtwOptions options_;
};

}  // namespace

std::unique_ptr<Recogniser> MakeDtwRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
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
  return std::make_unique<DtwRecogniser>(std::move(moves), weights, options);
}

}  // namespace etude
