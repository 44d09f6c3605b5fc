#include "engine/boards/film_delays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/results.h"

namespace etude {
namespace {

constexpr double kPeriodS = 1.0 / 6;

struct SteppingCase {
  double delay_s = 0;
  double other_period_s = kPeriodS;
};

/// Returns what two cameras see of a moving board of 4 x 5 squares; the second film is late.
std::vector<BoardSighting> SightingsOf(const SteppingCase& of, std::vector<Camera>& cameras) {
  const Intrinsics in{.width = 1280, .height = 720, .fx = 900, .fy = 900, .cx = 640, .cy = 360, .skew = 0};
  cameras = {LookAt(in, {0.3, 0.2, -1.2}, {0, 0, 0}), LookAt(in, {-0.7, 0.1, -0.9}, {0, 0, 0})};
  const auto at = [&](double t, const glm::dvec2& place) {
    const double a = 1.5 * t, yaw = 0.6 * std::sin(1.3 * a), pitch = 0.5 * std::sin(1.9 * a + 1);
    const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
    const glm::dvec3 down(std::sin(pitch) * std::sin(yaw), std::cos(pitch), -std::sin(pitch) * std::cos(yaw));
    const glm::dvec3 middle(0.15 * std::sin(1.1 * a), 0.1 * std::cos(0.9 * a), 0.12 * std::sin(0.7 * a));
    return middle + (place.x - 0.11) * right + (place.y - 0.13) * down;
  };
  std::vector<BoardSighting> sightings;
  constexpr int kLooks = 36;
  for (std::size_t camera = 0; camera < 2; ++camera) {
    const double period = camera == 0 ? kPeriodS : of.other_period_s;
    for (int look = 0; look * period < kLooks * kPeriodS; ++look) {
      BoardSighting s{.view = {.camera = camera, .target = static_cast<std::size_t>(look), .pairs = {}}, .look = look};
      const double t = look * period - (camera == 1 ? of.delay_s : 0);
      for (int i = 0; i < 12; ++i) {
        const glm::dvec2 place(0.054 * (i % 3 + 1), 0.054 * (i / 3 + 1));
        const glm::dvec2 pixel = *Project(cameras[camera], at(t, place));
        // Corner errors of a tenth of a pixel, deterministic.
        const glm::dvec2 error(std::sin(12.9 * look + 78.2 * i + static_cast<double>(camera)),
                               std::sin(37.7 * look + 11.1 * i + 2.0 * static_cast<double>(camera)));
        s.view.pairs.push_back({{place.x, place.y, 0}, pixel + 0.1 * error});
      }
      sightings.push_back(s);
    }
  }
  return sightings;
}

constexpr PictureSize kSizes[] = {{1280, 720}, {1280, 720}};

TEST(FindFilmDelays, FindsHowLateAFilmIsAndItsCamerasWithIt) {
  const double periods[] = {kPeriodS, kPeriodS};
  std::vector<Camera> truth;
  const auto sightings = SightingsOf({.delay_s = 0.7 * kPeriodS}, truth);
  ASSERT_OK(steps, FindFilmDelays(kSizes, sightings, periods, 2 * kPeriodS));
  EXPECT_EQ(steps->delay_s[0], 0);
  EXPECT_NEAR(steps->delay_s[1], 0.7 * kPeriodS, 0.04 * kPeriodS);
  EXPECT_GT(steps->before_px, 3 * steps->after_px);
  ASSERT_OK(rig, CalibrateFromPlanes(kSizes, SynchronisedViews(sightings, periods, steps->delay_s)));
  EXPECT_LT(rig->rms_px, 0.4);
  for (const Camera& camera : rig->cameras) EXPECT_NEAR(camera.intrinsics.fx, 900, 9);
  EXPECT_NEAR(glm::distance(rig->cameras[0].p_WC, rig->cameras[1].p_WC), glm::distance(truth[0].p_WC, truth[1].p_WC),
              0.01);
}

TEST(FindFilmDelays, LeavesFilmsInStepAlone) {
  const double periods[] = {kPeriodS, kPeriodS};
  std::vector<Camera> truth;
  const auto sightings = SightingsOf({}, truth);
  ASSERT_OK(steps, FindFilmDelays(kSizes, sightings, periods, 2 * kPeriodS));
  EXPECT_EQ(steps->delay_s, std::vector<double>(2));
  EXPECT_LT(steps->after_px, 0.2);
}

TEST(SynchronisedViews, OfAnotherRateStandAtTheFirstFilmsMoments) {
  const double periods[] = {kPeriodS, 0.7 * kPeriodS}, delay_s[] = {0, 0};
  std::vector<Camera> truth;
  const auto sightings = SightingsOf({.other_period_s = periods[1]}, truth);
  const auto views = SynchronisedViews(sightings, periods, delay_s);
  ASSERT_EQ(views.size(), sightings.size());  // no view is lost: views between the first film's looks get own targets
  ASSERT_OK(rig, CalibrateFromPlanes(kSizes, views));
  EXPECT_LT(rig->rms_px, 0.4);
  EXPECT_NEAR(glm::distance(rig->cameras[0].p_WC, rig->cameras[1].p_WC), glm::distance(truth[0].p_WC, truth[1].p_WC),
              0.01);
}

TEST(LocateBoards, TellsKnownCamerasResidual) {
  const double periods[] = {kPeriodS, kPeriodS}, in_step[] = {0, 0}, late[] = {0, 0.5 * kPeriodS};
  std::vector<Camera> truth;
  const auto sightings = SightingsOf({}, truth);
  ASSERT_OK(right, LocateBoards(truth, SynchronisedViews(sightings, periods, in_step)));
  EXPECT_LT(right->rms_px, 0.12);
  ASSERT_OK(wrong, LocateBoards(truth, SynchronisedViews(sightings, periods, late)));
  EXPECT_GT(wrong->rms_px, 1);
}

}  // namespace
}  // namespace etude
