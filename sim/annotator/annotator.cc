#include "sim/annotator/annotator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace etude {
namespace {

using enum Role;

constexpr double kHeadDeviation = 0.035, kShoulderDeviation = 0.079, kElbowDeviation = 0.072, kWristDeviation = 0.062,
                 kFingerDeviation = 0.026, kHipDeviation = 0.107, kKneeDeviation = 0.087, kAnkleDeviation = 0.089,
                 kToeDeviation = 0.068;

// The standard deviations σ of COCO and COCO-WholeBody, by role: the source of RelativeDeviations. The values are 0 for
// hip centre and spine, which are never marked.
constexpr std::array<double, kRoleCount> kDeviations = {
    0,
    0,
    kShoulderDeviation,
    kHeadDeviation,
    kShoulderDeviation,
    kElbowDeviation,
    kWristDeviation,
    kFingerDeviation,
    kShoulderDeviation,
    kElbowDeviation,
    kWristDeviation,
    kFingerDeviation,
    kHipDeviation,
    kKneeDeviation,
    kAnkleDeviation,
    kToeDeviation,
    kHipDeviation,
    kKneeDeviation,
    kAnkleDeviation,
    kToeDeviation,
};

constexpr std::array<double, kRoleCount> kRelative = [] {
  double sum = 0;
  int count = 0;
  for (const double deviation : kDeviations) {
    sum += deviation;
    count += deviation > 0;
  }
  std::array<double, kRoleCount> relative{};
  for (std::size_t i = 0; i < kRoleCount; ++i) relative[i] = kDeviations[i] * count / sum;
  return relative;
}();

glm::dvec2 Normal2(RandomStream& random) {
  const double u = random.Normal();
  return {u, random.Normal()};
}

constexpr double kReferenceErrorPx = 2;  // the `error_px` for which annotator.h states its probabilities and shares

// A left and a right limb. Each limb has three consecutive strokes; `left` and `right` are the indices of the first
// strokes of the left and the right limb.
struct Pair {
  std::size_t left, right;
};
constexpr std::array<Pair, 2> kPairs = {{{6, 9}, {0, 3}}};  // arms and legs
constexpr std::size_t kStrokesOfLimb = 3;

std::optional<glm::dvec2> MiddleOf(const PictureEvidence& seen, std::size_t first) {
  glm::dvec2 sum(0);
  int count = 0;
  for (std::size_t i = first; i < first + kStrokesOfLimb; ++i) {
    if (!seen.limbs[i]) continue;
    sum += 0.5 * (seen.limbs[i]->line.a + seen.limbs[i]->line.b);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return sum / static_cast<double>(count);
}

double HalfWidthOf(const PictureEvidence& seen, std::size_t first) {
  double widest = 0;
  for (std::size_t i = first; i < first + kStrokesOfLimb; ++i) {
    if (seen.limbs[i]) widest = std::max(widest, seen.limbs[i]->half_width);
  }
  return widest;
}

// Returns how much the two limbs overlap: 1 if their middles coincide or only one limb is visible, 0 if they are at
// least two widths apart.
double Overlap(const PictureEvidence& seen, const Pair& pair) {
  const auto left = MiddleOf(seen, pair.left), right = MiddleOf(seen, pair.right);
  if (!left || !right) return 1;
  const double reach = 4 * std::max(HalfWidthOf(seen, pair.left), HalfWidthOf(seen, pair.right));
  return std::max(0.0, 1 - glm::distance(*left, *right) / reach);
}

void Exchange(const Pair& pair, PictureEvidence& seen) {
  for (std::size_t i = 0; i < kStrokesOfLimb; ++i) {
    std::swap(seen.limbs[pair.left + i], seen.limbs[pair.right + i]);
    const Role from = StrokeMarks()[pair.left + i].from, to = StrokeMarks()[pair.left + i].to;
    if (i == 0) std::swap(seen.joints[Index(from)], seen.joints[Index(Mirrored(from))]);
    std::swap(seen.joints[Index(to)], seen.joints[Index(Mirrored(to))]);
  }
}

/// Computes the errors of the marks in one picture.
class PictureErrors {
 public:
  PictureErrors(const PersonErrors& errors, const std::array<glm::dvec2, kRoleCount>& bias, const PictureDice& dice,
                const PictureEvidence& seen)
      : errors_(errors), bias_(bias), dice_(dice), seen_(seen) {
    MeasureLimbs();
  }

  /// Returns the offset of a mark from the joint centre, pixels.
  glm::dvec2 ErrorAt(Role role) const {
    const std::size_t i = Index(role);
    const glm::dvec2 along = along_[i], across(-along.y, along.x);
    const glm::dvec2 bias = bias_[i].x * along + bias_[i].y * across;
    const glm::dvec2 shake =
        std::sqrt(kLastingShare) * dice_.lasting[i] + std::sqrt(kIndependentShare) * dice_.independent[i];
    return errors_.error_px * RelativeDeviations()[i] * (std::sqrt(kBiasShare) * bias + (1 + unclear_[i]) * shake);
  }

  bool Overlooks(std::size_t stroke) const {
    return dice_.miss[stroke] < Strength() * MissProbability(*seen_.limbs[stroke]);
  }

  /// Returns the drawn stroke: the line between the marked ends, shortened by random amounts.
  PixelSegment Stroke(std::size_t i) const {
    const PixelSegment& line = seen_.limbs[i]->line;
    const glm::dvec2 a = line.a + ErrorAt(StrokeMarks()[i].from), b = line.b + ErrorAt(StrokeMarks()[i].to);
    constexpr double kMaxShortening = 0.3;  // maximum share of the stroke left out at each end
    const glm::dvec2 left_out = glm::min(Strength() * kShortShare * glm::abs(dice_.shortness[i]), kMaxShortening);
    return {glm::mix(a, b, left_out.x), glm::mix(b, a, left_out.y)};
  }

 private:
  double Strength() const { return errors_.error_px / kReferenceErrorPx; }

  // Computes each joint's unclearness and the direction of its bias. A joint between two limbs gets the larger
  // unclearness of these limbs. The bias is along the limb that ends at the joint if that limb is visible, otherwise
  // along the limb that begins there.
  void MeasureLimbs() {
    along_.fill({0, 1});
    for (std::size_t i = kStrokeCount; i-- > 0;) {
      if (!seen_.limbs[i]) continue;
      const auto& [line, seen_share, contrast, half_width] = *seen_.limbs[i];
      const glm::dvec2 limb = line.b - line.a;
      const double length = glm::length(limb);
      for (const Role role : {StrokeMarks()[i].from, StrokeMarks()[i].to}) {
        unclear_[Index(role)] = std::max(unclear_[Index(role)], Unclearness(contrast));
        if (length > 0) along_[Index(role)] = limb / length;
      }
    }
  }

  const PersonErrors& errors_;
  const std::array<glm::dvec2, kRoleCount>& bias_;
  const PictureDice& dice_;
  const PictureEvidence& seen_;
  std::array<glm::dvec2, kRoleCount> along_;
  std::array<double, kRoleCount> unclear_{};
};

std::size_t StrokeTo(Role role) {
  std::size_t i = 0;
  while (StrokeMarks()[i].to != role) ++i;
  return i;
}

}  // namespace

const std::array<double, kRoleCount>& RelativeDeviations() { return kRelative; }

double Unclearness(double contrast) {
  constexpr double kHalf = 20;
  return 1 / (1 + contrast * contrast / (kHalf * kHalf));
}

double MissProbability(const LimbEvidence& limb) {
  constexpr double kAlways = 0.002, kHidden = 0.1, kUnclear = 0.03;
  const double hidden = 1 - limb.seen_share;
  return kAlways + kHidden * hidden * hidden + kUnclear * Unclearness(limb.contrast);
}

AnnotatorDice::AnnotatorDice(const WorldKey& key, int annotator, int camera)
    : key_(key), purpose_(fmt::format("annotator-{}/camera-{}", annotator, camera)) {
  RandomStream random(key, fmt::format("annotator-{}/bias", annotator));
  for (glm::dvec2& joint : bias_) joint = Normal2(random);
}

const PictureDice& AnnotatorDice::DrawNumbers(int frame) {
  assert(frame > last_frame_);
  RandomStream random(key_, fmt::format("{}/{}", purpose_, frame));
  const double kept = last_frame_ < 0 ? 0 : std::exp((last_frame_ - frame) / kLastingFrames);
  const double renewed = std::sqrt(1 - kept * kept);
  for (glm::dvec2& joint : dice_.lasting) joint = kept * joint + renewed * Normal2(random);
  for (glm::dvec2& joint : dice_.independent) joint = Normal2(random);
  for (glm::dvec2& stroke : dice_.shortness) stroke = Normal2(random);
  for (double& stroke : dice_.miss) stroke = random.Uniform();
  for (double& limbs : dice_.swap_begins) limbs = random.Uniform();
  for (double& limbs : dice_.swap_lasts) limbs = random.Uniform();
  last_frame_ = frame;
  return dice_;
}

Annotator::Annotator(const PersonErrors& errors, const EvidenceOptions& eye, const WorldKey& key, int annotator,
                     int camera)
    : errors_(errors), eye_(eye), dice_(key, annotator, camera) {}

void Annotator::SwapSides(const PictureDice& dice, PictureEvidence& seen) {
  const double strength = errors_.error_px / kReferenceErrorPx;
  for (std::size_t i = 0; i < kPairs.size(); ++i) {
    const double begins = strength * (kSwapProbability + kOverlapSwapProbability * Overlap(seen, kPairs[i]));
    if (swapped_frames_[i] > 0) {
      --swapped_frames_[i];
    } else if (dice.swap_begins[i] < begins) {
      // Draw the length of an exchange from a geometric distribution: 1, 2, … frames with mean kSwapFrames.
      swapped_frames_[i] = 1 + static_cast<int>(std::log1p(-dice.swap_lasts[i]) / std::log1p(-1 / kSwapFrames));
    }
    if (swapped_frames_[i] > 0) Exchange(kPairs[i], seen);
  }
}

Marks Annotator::Mark(int frame, const AnnotatedPicture& picture) {
  const PictureDice& dice = dice_.DrawNumbers(frame);
  // Measure the visible limbs, then exchange those limbs whose left and right are confused in this frame.
  PictureEvidence seen = SeePicture(picture, eye_);
  SwapSides(dice, seen);
  const PictureErrors errors(errors_, dice_.bias(), dice, seen);
  Marks marks;
  // Draw a stroke for every limb that is visible and not overlooked.
  std::array<bool, kStrokeCount> overlooked{};
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!seen.limbs[i]) continue;
    overlooked[i] = errors.Overlooks(i);
    if (!overlooked[i]) marks.strokes[i] = errors.Stroke(i);
  }
  // Mark the end effectors.
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    const Role role = EffectorMarks()[i].role;
    const auto& joint = seen.joints[Index(role)];
    if (joint && !overlooked[StrokeTo(role)]) marks.effectors[i] = *joint + errors.ErrorAt(role);
  }
  return marks;
}

}  // namespace etude
