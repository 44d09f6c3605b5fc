#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/keypoints/landmarks.h"

namespace etude {

/// Where a picture shows a landmark, pixels, and how sure the estimator is: 0 = not seen, 1 = sure.
struct Keypoint {
  glm::dvec2 pixel{0};
  double confidence = 0;
};

/// One person in one picture.
struct SeenPerson {
  std::array<Keypoint, kLandmarkCount> keypoints;

  Keypoint& operator[](Landmark landmark) { return keypoints[Index(landmark)]; }
  const Keypoint& operator[](Landmark landmark) const { return keypoints[Index(landmark)]; }
};

/// Of each frame of one camera, everybody in it, in no order.
using SeenPeople = std::vector<std::vector<SeenPerson>>;

/// The height of the box around all keypoints that were seen; 0 of nobody.
double HeightPx(const SeenPerson& person);

}  // namespace etude
