#include "bench/metrics/measurement.h"

#include <cassert>
#include <cstdint>

#include "bench/statistics/curves/curves.h"
#include "engine/base/angles.h"
#include "engine/base/directions.h"

namespace etude {
namespace {

/// Returns the mean of `error_of` over the values that have both a measurement and a truth, and the coverage.
template <typename ErrorOf>
MeasuredError Compare(std::span<const MeasuredAndTrue> things, ErrorOf error_of) {
  double sum = 0;
  std::int64_t measured = 0, all = 0;
  for (const MeasuredAndTrue& thing : things) {
    if (!thing.truth) continue;
    ++all;
    if (!thing.found) continue;
    ++measured;
    sum += error_of(*thing.found, *thing.truth);
  }
  MeasuredError error{.mean = {}, .coverage = Share(measured, all)};
  if (measured > 0) error.mean = sum / static_cast<double>(measured);
  return error;
}

}  // namespace

MeasuredError LimbDirectionErrorDeg(std::span<const MeasuredAndTrue> limbs) {
  return Compare(limbs,
                 [](const glm::dvec3& found, const glm::dvec3& truth) { return Degrees(AngleBetween(found, truth)); });
}

MeasuredError TriangulationErrorMm(std::span<const MeasuredAndTrue> ends) {
  constexpr double kMmPerMetre = 1000;
  return Compare(
      ends, [](const glm::dvec3& found, const glm::dvec3& truth) { return kMmPerMetre * glm::distance(found, truth); });
}

double MeanReprojectionRmsPx(std::span<const CameraFit> cameras) {
  assert(!cameras.empty());
  double mean = 0;
  for (const CameraFit& camera : cameras) {
    mean += ReprojectionRms(camera.matrix, camera.pairs) / static_cast<double>(cameras.size());
  }
  return mean;
}

}  // namespace etude
