#include "engine/cameras/agreeing_views.h"

#include <gtest/gtest.h>

#include "tests/engine/cameras/camera_at.h"

namespace etude {
namespace {

using Indices = std::vector<std::size_t>;
constexpr double kTolerancePx = 12;
const glm::dvec3 kPoint(0.3, 1.2, -0.4), kOther(-0.2, 0.7, 0.1);

std::vector<Sighting> Sightings(int count, const glm::dvec3& point) {
  std::vector<Sighting> sightings;
  for (int i = 0; i < count; ++i) sightings.push_back({CameraAt(-70 + 55 * i), *Project(CameraAt(-70 + 55 * i), point)});
  return sightings;
}

Indices AllBut(std::size_t count, std::size_t one) {
  Indices indices;
  for (std::size_t i = 0; i < count; ++i) {
    if (i != one) indices.push_back(i);
  }
  return indices;
}

TEST(AgreeingViews, LeaveOutTheOneCameraThatIsWrong) {
  for (std::size_t count = 3; count <= 6; ++count) {
    for (std::size_t wrong = 0; wrong < count; ++wrong) {
      std::vector<Sighting> sightings = Sightings(static_cast<int>(count), kPoint);
      sightings[wrong].pixel += glm::dvec2(45, -60);
      EXPECT_EQ(AgreeingViews(sightings, kTolerancePx), AllBut(count, wrong)) << count << " cameras, " << wrong;
    }
  }
}

TEST(AgreeingViews, KeepAllWhoseErrorsAreSmall) {
  std::vector<Sighting> sightings = Sightings(5, kPoint);
  for (std::size_t i = 0; i < 5; ++i) sightings[i].pixel += glm::dvec2(i % 2 ? 2 : -2, i % 3 ? 1 : -1);
  EXPECT_EQ(AgreeingViews(sightings, kTolerancePx).size(), 5u);
  EXPECT_LT(AgreeingViews(sightings, 0.1).size(), 5u) << "the control: a tolerance below the errors";
}

TEST(AgreeingViews, OfTwoNobodyCanSayWhichIsWrong) {
  std::vector<Sighting> sightings = Sightings(2, kPoint);
  sightings[1].pixel.y += 100;
  EXPECT_EQ(AgreeingViews(sightings, kTolerancePx), (Indices{0, 1}));
}

TEST(AgreeingViews, OfALimbLeaveOutThePictureThatShowsAnother) {
  for (std::size_t wrong = 0; wrong < 4; ++wrong) {
    const auto begins = Sightings(4, kPoint), ends = Sightings(4, kOther);
    std::vector<LimbSighting> limb;
    for (std::size_t i = 0; i < 4; ++i) limb.push_back({begins[i].matrix, {begins[i].pixel, ends[i].pixel}});
    EXPECT_EQ(AgreeingViews(limb, kTolerancePx).size(), 4u);
    limb[wrong].stroke.b += glm::dvec2(-70, 20);
    EXPECT_EQ(AgreeingViews(limb, kTolerancePx), AllBut(4, wrong));
  }
}

}  // namespace
}  // namespace etude
