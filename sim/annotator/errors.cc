#include "sim/annotator/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

using enum Role;

constexpr double kHeadDeviation = 0.035, kShoulderDeviation = 0.079, kElbowDeviation = 0.072, kWristDeviation = 0.062,
                 kFingerDeviation = 0.026, kHipDeviation = 0.107, kKneeDeviation = 0.087, kAnkleDeviation = 0.089,
                 kToeDeviation = 0.068;

// Hip centre and spine are never marked.
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

const PictureDice& AnnotatorDice::Throw(int frame) {
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

}  // namespace etude
