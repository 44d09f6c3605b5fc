#include "bench/tasks/capture/calibration.h"

#include <cmath>
#include <optional>

#include "bench/tasks/capture/shooting.h"
#include "engine/base/angles.h"
#include "engine/boards/find_boards.h"
#include "engine/boards/find_disc.h"
#include "sim/rig/calibration_target.h"

namespace etude {
namespace {

constexpr double kMetresPerMm = 0.001;

/// How far a click is off, in deviations. Upwards is thrown first.
glm::dvec2 ThrowMiss(RandomStream& hand) {
  const double y = hand.Normal(), x = hand.Normal();
  return {x, y};
}

std::vector<PointPair> ClickedBy(const StudioOptions& options, const Camera& camera, std::size_t index,
                                 const glm::dvec3& middle, const WorldKey& key) {
  RandomStream random(key, fmt::format("capture/camera-{}/calibration", index));
  RandomStream tape(key, fmt::format("capture/camera-{}/measured-points", index));
  const glm::dvec3 low = middle + glm::dvec3(-0.8, 0.1, -0.8), high = middle + glm::dvec3(0.8, 1.9, 0.8);
  std::vector<PointPair> pairs;
  for (int i = 0; i < options.calibration_pairs; ++i) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = random.Uniform(low[axis], high[axis]);
    // In turn the back wall, the left wall and the floor of the box.
    constexpr int kWalls[] = {2, 0, 1};
    const int wall = kWalls[i % 3];
    point[wall] = low[wall];
    const glm::dvec2 click = ThrowMiss(random);
    const glm::dvec3 measured = point + options.calibration_measure_mm * kMetresPerMm * tape.Normal3();
    const auto pixel = Project(camera, point);
    if (pixel) pairs.push_back({measured, *pixel + options.calibration_noise_px * click});
  }
  return pairs;
}

// Where the picture has a disc that somebody points at, so far off its middle.
std::optional<glm::dvec2> FindPointedAt(const PlacedDisc& disc, const Camera& camera, const GreyImage& picture,
                                        const glm::dvec2& off) {
  constexpr double kMostAside_deg = 70;
  constexpr double kReach = 8, kWidest = 40;  // pixels
  const glm::dvec3 to_camera = glm::normalize(camera.p_WC - disc.middle_W);
  if (glm::dot(to_camera, disc.outwards_W) < std::cos(Radians(kMostAside_deg))) return std::nullopt;
  const auto pixel = Project(camera, disc.middle_W);
  return pixel ? FindDisc(picture, *pixel + off, kReach, kWidest) : std::nullopt;
}

}  // namespace

CalibrationPairs ClickedPoints(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key) {
  CalibrationPairs pairs;
  for (const Camera& camera : world.cameras) {
    pairs.push_back(ClickedBy(options, camera, pairs.size(), world.middle, key));
  }
  return pairs;
}

CalibrationPairs FoundMarks(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                            Renderer& renderer) {
  const MarkedCube cube = MakeMarkedCube(world.middle);
  RandomStream tape(key, "capture/measured-marks");
  std::vector<glm::dvec3> measured;
  for (const PlacedDisc& disc : cube.discs) {
    measured.push_back(disc.middle_W + options.calibration_measure_mm * kMetresPerMm * tape.Normal3());
  }
  Shooting shooting(world, options.camera, key, renderer);
  CalibrationPairs pairs;
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    const GreyImage grey = ToGrey(shooting.ShootStage(camera, {Figure{.shape = {}, .surfaces = cube.surfaces}}));
    RandomStream hand(key, fmt::format("capture/camera-{}/calibration-marks", camera));
    std::vector<PointPair>& found = pairs.emplace_back();
    for (std::size_t i = 0; i < cube.discs.size(); ++i) {
      const glm::dvec2 off = options.calibration_noise_px * ThrowMiss(hand);
      const auto pixel = FindPointedAt(cube.discs[i], world.cameras[camera], grey, off);
      if (pixel) found.push_back({measured[i], *pixel});
    }
  }
  return pairs;
}

CalibrationPairs FoundCorners(const StudioOptions& options, const CaptureWorld& world, const WorldKey& key,
                              Renderer& renderer) {
  const std::vector<PlacedBoard> target = CalibrationTarget(world.middle);
  const std::vector<Surface> surfaces = SurfacesOf(target);
  RandomStream tape(key, "capture/measured-boards");
  std::vector<PlacedBoard> measured = target;
  for (PlacedBoard& board : measured) board.p_WO += options.calibration_measure_mm * kMetresPerMm * tape.Normal3();
  std::vector<Board> boards;
  for (const PlacedBoard& placed : target) boards.push_back(placed.board);

  Shooting shooting(world, options.camera, key, renderer);
  CalibrationPairs pairs;
  for (std::size_t camera = 0; camera < world.cameras.size(); ++camera) {
    const ColourImage picture = shooting.ShootStage(camera, {Figure{.shape = {}, .surfaces = surfaces}});
    pairs.push_back(PairsOf(measured, FindBoards(picture, boards)));
  }
  return pairs;
}

}  // namespace etude
