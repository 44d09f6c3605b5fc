#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// Returns the landmark of the other side; one that has no side is its own.
Landmark OtherSide(Landmark landmark);
/// Returns the person with left and right exchanged.
SeenPerson WithSidesSwapped(const SeenPerson& person);

/// A mistake in a person's keypoints in one camera that was mended.
struct Mend {
  enum class Kind {
    kSwappedSides,  ///< left and right exchanged, of the whole body
    kSwappedArms,   ///< … of face, shoulders and arms only
    kSwappedLegs,   ///< … of hips, legs and feet only
    kOtherPerson,   ///< somebody else's keypoints; the person's own were found
    kNobody,        ///< somebody else's keypoints; the person's own are not there, and the frame is left out
  };
  Kind kind = Kind::kSwappedSides;
  std::size_t camera = 0;
  std::vector<std::size_t> frames;  ///< ascending
};

/// Mends a person whom two cameras or more saw *(ours)*. First identity: where a camera's keypoints lie off the
/// epipolar lines of the others', by 5 % of the height and three times more than another person's of that picture do,
/// that one is taken, and nobody where a third camera contradicts and nobody fits. Then sides: of each camera, for arms
/// and legs by themselves, both labellings are held against the other cameras' keypoints (Geman–McClure's loss of the
/// epipolar distance, its scale twice the residuals' own), and over time the cheaper course is taken (Viterbi, a change
/// costs 1.5); the camera that gains most is mended first. Of two cameras only facing tells which one was wrong: toes
/// are before heels or ankles, the nose before the ears. Where a body is the wrong way round in every camera for nine
/// tenths of the frames, all are swapped.
std::vector<Mend> MendPerson(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                             double least_confidence, MatchedPerson& person);

/// Returns a limit for outliers, pixels, from the residuals' own distribution: eight times their robust standard
/// deviation (1.48 · median), at least `least_px`, at most `most_px`.
double OutlierLimit(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person, double least_confidence,
                    double least_px, double most_px);

}  // namespace etude
