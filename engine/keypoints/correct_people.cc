#include "engine/keypoints/correct_people.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "engine/base/order_statistics.h"
#include "engine/cameras/robust_triangulation.h"
#include "engine/cameras/triangulation.h"
#include "engine/keypoints/keypoint_motion.h"

namespace etude {

Landmark OtherSide(Landmark landmark) {
  const std::string_view name = LandmarkName(landmark);
  std::string other(name);
  if (name.front() == 'L') other.front() = 'R';
  if (name.front() == 'R') other.front() = 'L';
  return FindLandmark(other).value_or(landmark);
}

namespace {

using enum Landmark;

constexpr std::size_t kGroups = 2;  // group 0: face, shoulders and arms; group 1: hips and legs

/// Returns the left and right landmarks of a group.
const std::vector<std::pair<Landmark, Landmark>>& PairsOf(std::size_t group) {
  static const std::array<std::vector<std::pair<Landmark, Landmark>>, kGroups> pairs = {
      {{{kLeftEye, kRightEye},
        {kLeftEar, kRightEar},
        {kLeftShoulder, kRightShoulder},
        {kLeftElbow, kRightElbow},
        {kLeftWrist, kRightWrist},
        {kLeftHand, kRightHand}},
       {{kLeftHip, kRightHip},
        {kLeftKnee, kRightKnee},
        {kLeftAnkle, kRightAnkle},
        {kLeftBigToe, kRightBigToe},
        {kLeftSmallToe, kRightSmallToe},
        {kLeftHeel, kRightHeel}}}};
  return pairs[group];
}

void SwapGroup(SeenPerson& person, std::size_t group) {
  for (const auto& [left, right] : PairsOf(group)) std::swap(person[left], person[right]);
}

class PersonCorrector {
 public:
  PersonCorrector(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people, double min_confidence,
                  MatchedPerson& person)
      : cameras_(cameras),
        people_(people),
        least_confidence_(min_confidence),
        person_(person),
        geometry_(PairGeometry(cameras)) {
    frames_ = person.seen.empty() ? 0 : person.seen.front().size();
    for (auto& group : flips_) group.assign(cameras.size(), std::vector<bool>(frames_));
  }

  std::vector<PersonCorrection> Run() {
    FindPersonAgain();
    scale_px_ = ScalePx();
    for (std::size_t group = 0; group < kGroups; ++group) SwapBack(group);
    for (std::size_t group = 0; group < kGroups; ++group) ResolveFacing(group);
    ReportSwaps();
    return std::move(corrections_);
  }

 private:
  std::optional<double> DistancePx(std::size_t a, const Keypoint& p, std::size_t b, const Keypoint& q) const {
    if (p.confidence < least_confidence_ || q.confidence < least_confidence_ || !geometry_(a, b)) return std::nullopt;
    return std::abs(geometry_(a, b)->DistancePx(p.pixel, q.pixel));
  }

  /// Returns the median epipolar distance of a person in camera `c` to the person in camera `o`, as a share of the
  /// height; sides are labelled as they are or swapped, whichever gives the smaller median. Returns nullopt if the two
  /// detections have too few keypoints in common.
  std::optional<double> MisfitOf(std::size_t c, const SeenPerson& one, std::size_t o, const SeenPerson& other) const {
    std::optional<double> least;
    for (const bool is_swapped : {false, true}) {
      const SeenPerson labelled = is_swapped ? WithSidesSwapped(one) : one;
      std::vector<double> distances;
      for (std::size_t i = 0; i < kLandmarkCount; ++i) {
        if (const auto px = DistancePx(c, labelled.keypoints[i], o, other.keypoints[i])) distances.push_back(*px);
      }
      constexpr std::size_t kMinCount = 5;
      if (distances.size() < kMinCount) continue;
      const double misfit = UpperMedian(std::move(distances)) / std::max(1.0, HeightPx(one));
      if (!least || misfit < *least) least = misfit;
    }
    return least;
  }

  /// Returns the median misfit of a person in camera `c` over all other cameras.
  std::optional<double> MisfitOf(std::size_t c, std::size_t frame, const SeenPerson& one) const {
    std::vector<double> misfits;
    for (std::size_t o = 0; o < cameras_.size(); ++o) {
      if (o == c || !person_.seen[o][frame]) continue;
      if (const auto misfit = MisfitOf(c, one, o, *person_.seen[o][frame])) misfits.push_back(*misfit);
    }
    if (misfits.empty()) return std::nullopt;
    return LowerPercentile(misfits, 0.5);
  }

  void FindPersonAgain() {
    std::vector<PersonCorrection> found(cameras_.size()), nobody(cameras_.size());
    constexpr double kOff = 0.05, kBetter = 1.0 / 3;
    for (std::size_t frame = 0; frame < frames_; ++frame) {
      for (std::size_t round = 0; round < cameras_.size(); ++round) {
        // Take the worst camera first: its wrong keypoints also raise the misfit of the other cameras.
        std::optional<std::size_t> worst;
        double most = kOff;
        std::size_t seeing = 0;
        std::optional<SeenPerson> instead;
        bool has_better = false;
        for (std::size_t c = 0; c < cameras_.size(); ++c) {
          if (!person_.seen[c][frame]) continue;
          ++seeing;
          const auto misfit = MisfitOf(c, frame, *person_.seen[c][frame]);
          if (!misfit || *misfit <= kOff) continue;
          // Look for the person in the same picture who fits best, and much better than the person chosen so far.
          const SeenPerson* best = nullptr;
          double least = kBetter * *misfit;
          for (const SeenPerson& candidate : people_[c][frame]) {
            const auto other = MisfitOf(c, frame, candidate);
            if (!other || *other >= least) continue;
            least = *other;
            best = &candidate;
          }
          // The worst camera has the greatest misfit among the cameras whose pictures show a better-fitting person, or
          // among all cameras if no picture shows one.
          if (has_better ? best == nullptr || *misfit <= most : best == nullptr && *misfit <= most) continue;
          worst = c;
          most = *misfit;
          if (best != nullptr) instead = *best;
          has_better = best != nullptr;
        }
        if (!worst || (!has_better && seeing < 3)) break;
        // Take the better person's keypoints. If there is no better person, remove the keypoints; at least two other
        // cameras still show the person.
        person_.seen[*worst][frame] = has_better ? instead : std::nullopt;
        (has_better ? found : nobody)[*worst].frames.push_back(frame);
      }
    }
    // Report the corrections by camera.
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      for (auto* list : {&found, &nobody}) {
        PersonCorrection& correction = (*list)[c];
        correction.frames.erase(std::unique(correction.frames.begin(), correction.frames.end()),
                                correction.frames.end());
        if (correction.frames.empty()) continue;
        correction.camera = c;
        correction.kind = list == &found ? PersonCorrection::Kind::kOtherPerson : PersonCorrection::Kind::kNobody;
        corrections_.push_back(correction);
      }
    }
  }

  /// Returns twice the robust standard deviation of the epipolar distances, at least 0.7 px. For each left and right
  /// landmark seen by two cameras, the labelling with the smaller distances counts.
  double ScalePx() const {
    std::vector<double> distances;
    for (std::size_t frame = 0; frame < frames_; ++frame) {
      for (std::size_t a = 0; a < cameras_.size(); ++a) {
        for (std::size_t b = a + 1; b < cameras_.size(); ++b) {
          const auto &one = person_.seen[a][frame], &other = person_.seen[b][frame];
          if (!one || !other) continue;
          for (std::size_t group = 0; group < kGroups; ++group) {
            for (const auto& [l, r] : PairsOf(group)) {
              const auto ll = DistancePx(a, (*one)[l], b, (*other)[l]), rr = DistancePx(a, (*one)[r], b, (*other)[r]);
              const auto lr = DistancePx(a, (*one)[l], b, (*other)[r]), rl = DistancePx(a, (*one)[r], b, (*other)[l]);
              if (!ll || !rr || !lr || !rl) continue;
              const bool is_swapped = *lr + *rl < *ll + *rr;
              distances.push_back(is_swapped ? *lr : *ll);
              distances.push_back(is_swapped ? *rl : *rr);
            }
          }
        }
      }
    }
    constexpr double kMinPx = 0.7;
    return distances.empty() ? kMinPx : std::max(kMinPx, 2 * 1.4826 * UpperMedian(std::move(distances)));
  }

  double Loss(double px) const { return px * px / (px * px + scale_px_ * scale_px_); }

  /// Returns two costs in one frame: of keeping a group's labels, and of swapping left and right.
  std::array<double, 2> CostsOf(std::size_t group, std::size_t c, std::size_t frame) const {
    std::array<double, 2> costs{};
    const auto& one = person_.seen[c][frame];
    if (!one) return costs;
    for (std::size_t o = 0; o < cameras_.size(); ++o) {
      const auto& other = person_.seen[o][frame];
      if (o == c || !other) continue;
      for (const auto& [l, r] : PairsOf(group)) {
        for (const auto& [p, q, way] : {std::tuple(l, l, 0), {r, r, 0}, {l, r, 1}, {r, l, 1}}) {
          if (const auto px = DistancePx(c, (*one)[p], o, (*other)[q]))
            costs[static_cast<std::size_t>(way)] += Loss(*px);
        }
      }
    }
    return costs;
  }

  /// A sequence of labellings of one camera over time.
  struct Course {
    std::vector<bool> is_swapped;
    double gain = 0;  ///< the cost of keeping all labels minus the cost of this sequence
  };

  // Finds the labelling of minimal cost over time (Viterbi).
  Course CourseOf(std::size_t group, std::size_t c) const {
    constexpr double kChange = 1.5;
    std::vector<std::array<bool, 2>> from(frames_);  // true: the best path into this state comes from the swapped state
    std::array<double, 2> total{};
    double as_it_is = 0;
    // Forward pass: the lowest cost of each of the two states.
    for (std::size_t frame = 0; frame < frames_; ++frame) {
      const auto costs = CostsOf(group, c, frame);
      as_it_is += costs[0];
      std::array<double, 2> next{};
      for (std::size_t state = 0; state < 2; ++state) {
        const double stay = total[state], change = total[1 - state] + kChange;
        from[frame][state] = change < stay ? state == 0 : state == 1;
        next[state] = std::min(stay, change) + costs[state];
      }
      total = next;
    }
    // Backward pass: follow the best path from the last frame to the first.
    Course course{std::vector<bool>(frames_), as_it_is - std::min(total[0], total[1])};
    bool state = total[1] < total[0];
    for (std::size_t frame = frames_; frame-- > 0;) {
      course.is_swapped[frame] = state && person_.seen[c][frame].has_value();
      state = from[frame][state ? 1 : 0];
    }
    return course;
  }

  void Flip(std::size_t group, std::size_t c, std::size_t frame) {
    if (!person_.seen[c][frame]) return;
    SwapGroup(*person_.seen[c][frame], group);
    flips_[group][c][frame] = !flips_[group][c][frame];
  }

  // Swaps the sides in the camera with the largest gain, and repeats this until no gain is large enough.
  void SwapBack(std::size_t group) {
    constexpr double kMinGain = 1.5;
    for (std::size_t round = 0; round < 3 * cameras_.size(); ++round) {
      Course best;
      std::size_t camera = 0;
      for (std::size_t c = 0; c < cameras_.size(); ++c) {
        Course course = CourseOf(group, c);
        if (course.gain > best.gain + 1e-9) {
          best = std::move(course);
          camera = c;
        }
      }
      if (!(best.gain > kMinGain)) return;
      for (std::size_t frame = 0; frame < frames_; ++frame) {
        if (best.is_swapped[frame]) Flip(group, camera, frame);
      }
    }
  }

  // Triangulates a landmark in one frame; nullopt if the triangulation fails.
  std::optional<glm::dvec3> PositionOf(std::size_t frame, Landmark landmark) const {
    std::vector<Sighting> sightings;
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      const auto& seen = person_.seen[c][frame];
      if (seen && (*seen)[landmark].confidence >= least_confidence_) {
        sightings.push_back({cameras_[c], (*seen)[landmark].pixel});
      }
    }
    const TriangulatedPoint point = Triangulate(sightings);
    return point.status == PointStatus::kOk ? std::optional(point.position) : std::nullopt;
  }

  std::optional<glm::dvec3> MiddleOf(std::size_t frame, Landmark a, Landmark b) const {
    const auto p = PositionOf(frame, a), q = PositionOf(frame, b);
    return p && q ? std::optional(0.5 * (*p + *q)) : std::nullopt;
  }

  /// Returns the cosine between the direction `from` → `to` and the front of a body part, whose left side is `left` and
  /// whose lower and upper end are `low` and `high`. Returns nullopt if a point is missing or the cosine says little.
  static std::optional<double> FacingOf(const glm::dvec3& left, const std::optional<glm::dvec3>& low,
                                        const std::optional<glm::dvec3>& high, const std::optional<glm::dvec3>& from,
                                        const std::optional<glm::dvec3>& to) {
    if (!low || !high || !from || !to) return std::nullopt;
    const glm::dvec3 front = glm::cross(left, *high - *low), forward = *to - *from;
    const double cosine = glm::dot(front, forward) / (glm::length(front) * glm::length(forward));
    constexpr double kSaysLittle = 0.3;
    return std::abs(cosine) > kSaysLittle ? std::optional(cosine) : std::nullopt;
  }

  /// Returns a value above 0 if the left landmarks are on the body's left side, below 0 if they are on its right side;
  /// nullopt if landmarks are missing or the side is ambiguous. The evidence is the feet relative to the shanks, so the
  /// body may stand, kneel, bend or lie; otherwise the nose relative to the trunk. Both come from landmarks without a
  /// side, or from midpoints of both sides.
  std::optional<double> Chirality(std::size_t group, std::size_t frame) const {
    const auto left = PositionOf(frame, group == 0 ? kLeftShoulder : kLeftHip);
    const auto right = PositionOf(frame, group == 0 ? kRightShoulder : kRightHip);
    if (!left || !right) return std::nullopt;
    const auto ankles = MiddleOf(frame, kLeftAnkle, kRightAnkle), heels = MiddleOf(frame, kLeftHeel, kRightHeel);
    const auto by_feet = FacingOf(*left - *right, ankles, MiddleOf(frame, kLeftKnee, kRightKnee),
                                  heels ? heels : ankles, MiddleOf(frame, kLeftBigToe, kRightBigToe));
    if (by_feet) return by_feet;
    return FacingOf(*left - *right, MiddleOf(frame, kLeftHip, kRightHip),
                    MiddleOf(frame, kLeftShoulder, kRightShoulder), MiddleOf(frame, kLeftEar, kRightEar),
                    PositionOf(frame, kNose));
  }

  bool HasFlip(std::size_t group, std::size_t frame) const {
    return std::ranges::any_of(flips_[group], [&](const std::vector<bool>& camera) { return camera[frame]; });
  }

  /// Corrects swaps that were made in the wrong camera: if the body faces backwards where sides were swapped, left and
  /// right are swapped there in all cameras.
  void ResolveFacing(std::size_t group) {
    std::vector<std::optional<double>> sides;
    for (std::size_t frame = 0; frame < frames_; ++frame) sides.push_back(Chirality(group, frame));
    // Returns true if left and right are exchanged in at least `share` of the frames that show a facing direction.
    const auto is_wrong = [&](std::size_t first, std::size_t last, double share) {
      std::size_t wrong = 0, told = 0;
      for (std::size_t frame = first; frame < last; ++frame) {
        if (!sides[frame]) continue;
        ++told;
        if (*sides[frame] < 0) ++wrong;
      }
      return told > 0 && static_cast<double>(wrong) >= share * static_cast<double>(told);
    };
    const auto flip_all = [&](std::size_t first, std::size_t last) {
      for (std::size_t frame = first; frame < last; ++frame) {
        for (std::size_t c = 0; c < cameras_.size(); ++c) Flip(group, c, frame);
      }
    };
    // Swap the whole take if nearly all frames are wrong; otherwise test each run of swapped frames.
    constexpr double kNearlyAll = 0.9, kMajority = 0.6;
    if (frames_ > 0 && is_wrong(0, frames_, kNearlyAll)) return flip_all(0, frames_);
    for (std::size_t first = 0; first < frames_;) {
      if (!HasFlip(group, first)) {
        ++first;
        continue;
      }
      std::size_t last = first;
      while (last < frames_ && HasFlip(group, last)) ++last;
      if (is_wrong(first, last, kMajority)) flip_all(first, last);
      first = last;
    }
  }

  // Reports each camera's frames with arms and legs swapped, with only arms swapped, and with only legs swapped.
  void ReportSwaps() {
    for (std::size_t c = 0; c < cameras_.size(); ++c) {
      PersonCorrection both{PersonCorrection::Kind::kSwappedSides, c, {}},
          arms{PersonCorrection::Kind::kSwappedArms, c, {}}, legs{PersonCorrection::Kind::kSwappedLegs, c, {}};
      for (std::size_t frame = 0; frame < frames_; ++frame) {
        const bool arm = flips_[0][c][frame], leg = flips_[1][c][frame];
        if (arm || leg) (arm && leg ? both : arm ? arms : legs).frames.push_back(frame);
      }
      for (PersonCorrection* correction : {&both, &arms, &legs}) {
        if (!correction->frames.empty()) corrections_.push_back(std::move(*correction));
      }
    }
  }

  std::span<const ProjectionMatrix> cameras_;
  std::span<const SeenPeople> people_;
  double least_confidence_;
  MatchedPerson& person_;
  PairGeometry geometry_;
  std::size_t frames_ = 0;
  double scale_px_ = 1;
  std::array<std::vector<std::vector<bool>>, kGroups> flips_;  ///< true if swapped; [group][camera][frame]
  std::vector<PersonCorrection> corrections_;
};

}  // namespace

SeenPerson WithSidesSwapped(const SeenPerson& person) {
  SeenPerson swapped = person;
  for (std::size_t group = 0; group < kGroups; ++group) SwapGroup(swapped, group);
  return swapped;
}

std::vector<PersonCorrection> CorrectPerson(std::span<const ProjectionMatrix> cameras,
                                            std::span<const SeenPeople> people, double min_confidence,
                                            MatchedPerson& person) {
  return PersonCorrector(cameras, people, min_confidence, person).Run();
}

double OutlierLimit(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person, double min_confidence,
                    double min_px, double max_px) {
  std::vector<double> residuals;
  for (const TriangulatedLandmark& one :
       TriangulateLandmarks(cameras, person, {.min_confidence = min_confidence, .robust = {max_px}})) {
    residuals.push_back(one.point.residual_px);
  }
  constexpr double kDeviations = 8, kDeviationOfMedian = 1.4826;
  if (residuals.empty()) return max_px;
  return std::clamp(kDeviations * kDeviationOfMedian * UpperMedian(std::move(residuals)), min_px, max_px);
}

}  // namespace etude
