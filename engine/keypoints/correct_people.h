#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// Returns the landmark on the other side; a landmark without a side is returned unchanged.
Landmark OtherSide(Landmark landmark);
/// Returns the person with left and right exchanged.
SeenPerson WithSidesSwapped(const SeenPerson& person);

/// A corrected mistake in a person's keypoints in one camera.
struct PersonCorrection {
  enum class Kind {
    kSwappedSides,  ///< left and right exchanged on the whole body
    kSwappedArms,   ///< left and right exchanged on face, shoulders and arms only
    kSwappedLegs,   ///< left and right exchanged on hips, legs and feet only
    kOtherPerson,   ///< another person's keypoints were replaced by the person's own
    kNobody,        ///< another person's keypoints were removed, because the person's own were not found
  };
  Kind kind = Kind::kSwappedSides;
  std::size_t camera = 0;
  std::vector<std::size_t> frames;  ///< the frames of this mistake, ascending
};

/// Corrects the keypoints of a person seen by two cameras or more *(ours)*. First, it checks the identity: if a
/// camera's keypoints are more than 5 % of the height off the other cameras' epipolar lines, and another person in
/// that picture is less than a third of this distance off, the other person's keypoints are taken. If nobody fits and
/// at least three cameras see the person, this camera's keypoints are left out in this frame. Then it checks the
/// sides, for each camera and separately for the upper body and the legs. Both labellings of a frame are compared
/// with the other cameras' keypoints; their cost is Geman–McClure's loss of the epipolar distance, with a scale of
/// twice the residuals' standard deviation. The cheapest sequence of labellings is taken (Viterbi; a change of the
/// labelling costs 1.5). The camera whose new labels lower the cost most is corrected first. With two cameras, only
/// the body's front shows which camera was wrong: toes are in front of the shanks, or else the nose is in front of the
/// trunk. If the body faces the wrong way in nine tenths of the frames, sides are swapped in all cameras.
std::vector<PersonCorrection> CorrectPerson(std::span<const ProjectionMatrix> cameras,
                                            std::span<const SeenPeople> people, double min_confidence,
                                            MatchedPerson& person);

/// Returns an outlier threshold in pixels from the distribution of the residuals: eight times their robust standard
/// deviation (1.48 · median), at least `min_px` and at most `max_px`.
double OutlierLimit(std::span<const ProjectionMatrix> cameras, const MatchedPerson& person, double min_confidence,
                    double min_px, double max_px);

}  // namespace etude
