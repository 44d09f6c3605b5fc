#include "bench/metrics/alignment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace etude {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

bool BothSeen(const glm::dvec3& a, const glm::dvec3& b) { return !std::isnan(a.x) && !std::isnan(b.x); }

/// Returns the similarity of AlignSimilarity without a singular value decomposition, or nothing if rounding could make
/// the result inaccurate. The rotation is the eigenvector of the largest eigenvalue of Horn's 4 × 4 matrix (Horn 1987).
/// Newton's method finds that eigenvalue as a root of the characteristic polynomial (Theobald 2005).
std::optional<Similarity> AlignByQuaternion(const PointMoments& moments) {
  const glm::dmat3& s = moments.covariance;  // s[a][b] = Σ over points of point[a] · target[b], relative to the means
  const glm::dvec3 skew(s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]);
  const double xy = s[0][1] + s[1][0], yz = s[1][2] + s[2][1], zx = s[2][0] + s[0][2];
  const double trace = s[0][0] + s[1][1] + s[2][2];
  double rows[4][4] = {{trace, skew.x, skew.y, skew.z},
                       {skew.x, 2 * s[0][0] - trace, xy, zx},
                       {skew.y, xy, 2 * s[1][1] - trace, yz},
                       {skew.z, zx, yz, 2 * s[2][2] - trace}};
  // Compute the minors of the two lower rows, and the cofactors of the first row.
  const auto minor = [&](int i, int j) { return rows[2][i] * rows[3][j] - rows[2][j] * rows[3][i]; };
  const auto cofactors = [&] {
    const double m01 = minor(0, 1), m02 = minor(0, 2), m03 = minor(0, 3);
    const double m12 = minor(1, 2), m13 = minor(1, 3), m23 = minor(2, 3);
    const double* r = rows[1];
    return glm::dvec4(r[1] * m23 - r[2] * m13 + r[3] * m12, r[2] * m03 - r[0] * m23 - r[3] * m02,
                      r[0] * m13 - r[1] * m03 + r[3] * m01, r[1] * m02 - r[0] * m12 - r[2] * m01);
  };
  // The characteristic polynomial is λ⁴ + c₂λ² + c₁λ + c₀. The start value is above every root, so every Newton
  // step lowers λ.
  const double square = glm::dot(s[0], s[0]) + glm::dot(s[1], s[1]) + glm::dot(s[2], s[2]);
  const double c2 = -2 * square, c1 = -8 * glm::determinant(s);
  const double c0 = glm::dot(glm::dvec4(rows[0][0], rows[0][1], rows[0][2], rows[0][3]), cofactors());
  double lambda = std::sqrt(3 * square);
  constexpr int kMaxSteps = 50;
  constexpr double kSettled = 1e-15;
  for (int i = 0; i < kMaxSteps; ++i) {
    const double value = ((lambda * lambda + c2) * lambda + c1) * lambda + c0;
    const double step = value / ((4 * lambda * lambda + 2 * c2) * lambda + c1);
    lambda -= step;
    if (!(std::abs(step) > kSettled * lambda)) break;
  }
  for (int i = 0; i < 4; ++i) rows[i][i] -= lambda;
  const glm::dvec4 vector = cofactors();
  // If the cofactors are small, another rotation fits nearly as well, or the rotation is by nearly 180°.
  constexpr double kSafe = 0.01;
  const double length = glm::length(vector);
  if (!(length > kSafe * lambda * lambda * lambda)) return std::nullopt;
  Similarity similarity;
  similarity.rotation = glm::mat3_cast(glm::dquat(vector.x, vector.y, vector.z, vector.w) / length);
  similarity.scale = lambda / moments.scatter;
  similarity.translation = moments.target_mean - similarity.scale * (similarity.rotation * moments.mean);
  return similarity;
}

/// Returns `fit` if `with_scale` is true, else the rigid transformation with the same rotation. `moments` are the sums
/// from which `fit` was computed. Returns nothing if there is no fit.
std::optional<Similarity> WithScale(const std::optional<Similarity>& fit, const PointMoments& moments,
                                    bool with_scale) {
  if (!fit || with_scale) return fit;
  return Similarity{
      .scale = 1, .rotation = fit->rotation, .translation = moments.target_mean - fit->rotation * moments.mean};
}

/// Writes the error of each joint in one frame, millimetres, into `errors`.
void WriteErrorsMm(const EvaluatedPair& pair, std::size_t frame, const std::optional<Similarity>& fit, double* errors) {
  constexpr double kToMillimetres = 1000;
  const auto found = pair.found.Frame(frame), truth = pair.truth.Frame(frame);
  if (!fit) {
    std::fill_n(errors, found.size(), kUnseen);
    return;
  }
  const glm::dmat3 turn = fit->scale * fit->rotation;
  const glm::dvec3 move = fit->translation;
  // NaN propagates: the error is NaN for a joint that is not seen in the answer or in the truth.
  for (std::size_t j = 0; j < found.size(); ++j) {
    errors[j] = kToMillimetres * glm::length(turn * found[j] + move - truth[j]);
  }
}

}  // namespace

std::optional<Similarity> Fit(const PointMoments& moments, bool with_scale) {
  if (moments.count < kMinFitted) return std::nullopt;
  const auto fast = AlignByQuaternion(moments);
  return WithScale(fast ? *fast : AlignSimilarity(moments), moments, with_scale);
}

PairFits::PairFits(const EvaluatedPair& pair) : pair_(pair) {
  assert(pair.found.points == pair.truth.points && pair.found.positions.size() == pair.truth.positions.size());
  const std::size_t frames = pair.found.FrameCount();
  moments_.reserve(frames);
  each_frame_.reserve(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    moments_.push_back(MomentsOf(pair.found.Frame(f), pair.truth.Frame(f)));
    each_frame_.push_back(Fit(moments_.back(), true));
  }
}

FrameFits PairFits::Of(Alignment alignment) const {
  using enum Alignment;
  const std::size_t frames = moments_.size();
  // Handle alignments with one fit for all frames, and alignments by the root.
  const auto for_all = [&](std::optional<Similarity> fit) {
    return FrameFits{{std::move(fit)}, std::max<std::size_t>(frames, 1)};
  };
  switch (alignment) {
    case kNone:
      return for_all(Similarity{});
    case kRoot:
    case kRootScaled:
      return ByRoot(alignment == kRootScaled);
    case kFirst:
    case kFirstScaled: {
      const auto first = std::ranges::find_if(moments_, [](const auto& of) { return of.count >= kMinFitted; });
      if (first == moments_.end()) return for_all(std::nullopt);
      return for_all(WithScale(each_frame_[first - moments_.begin()], *first, alignment == kFirstScaled));
    }
    case kTake:
    case kTakeScaled: {
      PointMoments all;
      for (const PointMoments& of_frame : moments_) all.Add(of_frame);
      return for_all(Fit(all, alignment == kTakeScaled));
    }
    case kFrame:
    case kFrameScaled:
      break;
  }
  // Each frame has a similarity of its own. For kFrame, replace the similarity by the rigid fit.
  FrameFits found{each_frame_};
  if (alignment == kFrameScaled) return found;
  for (std::size_t f = 0; f < frames; ++f) found.fits[f] = WithScale(found.fits[f], moments_[f], false);
  return found;
}

FrameFits PairFits::ByRoot(bool with_scale) const {
  FrameFits found{std::vector<std::optional<Similarity>>(moments_.size())};
  if (pair_.found_root.empty()) return found;
  for (std::size_t f = 0; f < moments_.size(); ++f) {
    const glm::dvec3 &root = pair_.found_root[f], &onto = pair_.true_root[f];
    if (!BothSeen(root, onto)) continue;
    // Compute the scale that minimises the squared error of the joints relative to the root. As in N-MPJPE's code, it
    // may be negative.
    double product = 0, square = 0;
    const auto answer = pair_.found.Frame(f), truth = pair_.truth.Frame(f);
    for (std::size_t j = 0; with_scale && j < answer.size(); ++j) {
      if (!BothSeen(answer[j], truth[j])) continue;
      product += glm::dot(answer[j] - root, truth[j] - onto);
      square += glm::dot(answer[j] - root, answer[j] - root);
    }
    const double scale = square > 0 ? product / square : 1;
    found.fits[f] = Similarity{.scale = scale, .rotation = glm::dmat3(1), .translation = onto - scale * root};
  }
  return found;
}

FrameFits PairFits::OfSegments(std::size_t length, std::size_t fitted) const {
  FrameFits found{{}, length};
  for (std::size_t begin = 0; begin < moments_.size(); begin += length) {
    PointMoments sums;
    for (std::size_t f = begin; f < std::min({begin + fitted, begin + length, moments_.size()}); ++f) {
      sums.Add(moments_[f]);
    }
    found.fits.push_back(Fit(sums, true));
  }
  return found;
}

std::vector<double> JointErrorsMm(const EvaluatedPair& pair, const FrameFits& fits) {
  std::vector<double> errors(pair.found.positions.size());
  for (std::size_t f = 0; f < pair.found.FrameCount(); ++f) {
    WriteErrorsMm(pair, f, fits.At(f), &errors[f * pair.found.points]);
  }
  return errors;
}

std::optional<double> MeanJointErrorMm(const EvaluatedPair& pair, const FrameFits& fits) {
  SeenMean mean;
  std::vector<double> errors(pair.found.points);
  for (std::size_t f = 0; f < pair.found.FrameCount(); ++f) {
    WriteErrorsMm(pair, f, fits.At(f), errors.data());
    mean.Add(errors);
  }
  return mean.Value();
}

std::vector<double> EncodeMeans(const JointMeans& means) {
  std::vector<double> values;
  for (const std::optional<double>& mean : means) values.push_back(mean.value_or(-1));
  return values;
}

std::optional<JointMeans> DecodeMeans(std::span<const double> values) {
  JointMeans means;
  if (values.size() != means.size()) return std::nullopt;
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (values[i] >= 0) means[i] = values[i];
  }
  return means;
}

std::optional<double> MeanOfJoint(std::span<const double> errors, std::size_t joints, std::size_t joint) {
  double sum = 0, count = 0;
  for (std::size_t at = joint; at < errors.size(); at += joints) {
    if (std::isnan(errors[at])) continue;
    sum += errors[at];
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace etude
