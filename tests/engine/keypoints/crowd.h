#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "engine/keypoints/correct_people.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/support/random_clip.h"

namespace etude {

/// Two people in front of four cameras. Their order changes; some keypoints are unsure, far off, or of the other side;
/// some people are unseen for a while.
struct Crowd {
  std::vector<Camera> cameras = Pinholes();
  std::vector<ProjectionMatrix> matrices = MatricesOf(cameras);
  std::vector<SeenPeople> people;

  Crowd(testing::Dice& dice, std::size_t frames, double noise_px, double far = 0.03, double rate_hz = 30) {
    RandomStream exact = WalkersDice("crowd");
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      SeenPeople& seen = people.emplace_back(frames);
      for (std::size_t k = 0; k < frames; ++k) {
        const double t = static_cast<double>(k) / rate_hz;
        for (int who = 0; who < 2; ++who) {
          if (k / 6 % 5 == 2 * c % 5 + who && k > 8) continue;
          LandmarkPositions places = who == 0 ? Walker(-0.6 + 0.2 * t, 0.1, t) : Walker(0.6, 0.3 - 0.2 * t, t + 0.7);
          for (const auto& [own, at, off] :
               {std::tuple(Landmark::kLeftEar, Landmark::kNose, glm::dvec3(0.08, 0.01, -0.1)),
                {Landmark::kRightEar, Landmark::kNose, glm::dvec3(-0.08, 0.01, -0.1)},
                {Landmark::kLeftHeel, Landmark::kLeftAnkle, glm::dvec3(0, -0.05, -0.06)},
                {Landmark::kRightHeel, Landmark::kRightAnkle, glm::dvec3(0, -0.05, -0.06)}}) {
            places[Index(own)] = *places[Index(at)] + off;
          }
          if (who == 0) places[Index(Landmark::kLeftHeel)].reset();
          SeenPerson person = Seen(cameras[c], places, 0, exact);
          for (Keypoint& keypoint : person.keypoints) {
            if (!(keypoint.confidence > 0)) continue;
            keypoint.pixel += noise_px * glm::dvec2(dice.Vector());
            keypoint.confidence = 0.6 + 0.4 * dice.Signed();
            if (dice.Below(40) == 0) keypoint = {};
            if (dice.Below(1000) < 1000 * far) keypoint.pixel += 90.0 * glm::dvec2(dice.Vector());
          }
          if (k / 4 % 7 == c) person = WithSidesSwapped(person);
          seen[k].push_back(person);
        }
        if (k * 7 % 3 == c % 3) std::ranges::reverse(seen[k]);
      }
    }
  }
};

}  // namespace etude
