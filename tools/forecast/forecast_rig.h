#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/point_error.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/keypoint_noise.h"
#include "engine/keypoints/place_rig.h"
#include "engine/keypoints/pose_error.h"
#include "engine/motion/body.h"
#include "tools/capture/capture_films.h"
#include "tools/listener.h"

namespace etude {

struct ForecastOptions {
  std::string rig;         ///< a calibration, as for `CaptureFilms`
  PlacementOptions place;  ///< the rig's unit, up axis and floor
  SightingErrors errors;
  CaptureFilmsOptions take = {};  ///< films and keypoints with the rig, whose noise replaces `errors.noise_px`, or none
  glm::dvec3 size_m{3, 2, 3};  ///< the volume that people move in: width (x), height from the floor, depth (z)
  std::optional<glm::dvec2>
      middle_m;              ///< its middle on the floor (x, z); absent = the point nearest to all optical axes
  std::string picture;       ///< a PNG of heat maps, "" = none
  std::string table;         ///< a CSV of all places, "" = none
  std::string report;        ///< an HTML page, "" = none
  std::string command_line;  ///< the command as typed, for the page
  std::string version;       ///< the program's, for the page
  Listener listener = {};
};

/// The number of places along x, height and z at which errors are computed: the middles of equal cells.
inline constexpr int kForecastColumns = 20, kForecastHeights = 10, kForecastRows = 20;

/// The expected error at one place.
struct ForecastPlace {
  glm::dvec3 place_m{0};
  int cameras = 0;                      ///< number of cameras that have it in their pictures
  double lost = 1;                      ///< probability that it cannot be triangulated
  std::optional<double> error_mm = {};  ///< root mean square distance; absent if two cameras never see it
};

/// The expected error over the volume, for the rig as it is or with one change.
struct RigWorth {
  std::string change;                      ///< the change, in words for users
  std::optional<glm::dvec3> added_m = {};  ///< position of the added camera, if there is one
  double seen = 0;                         ///< share of all places that two cameras have in their pictures
  double median_mm = 0;                    ///< median error over the places that the unchanged rig sees, too
};

/// The expected root mean square errors of one joint of a person who stands in the volume.
struct ForecastJoint {
  Role role = Role::kHipCentre;
  std::optional<double> noise_px;      ///< standard deviation of its keypoints; absent if it is not triangulated
  double point_mm = 0, body_mm = 0;    ///< RMS error of the triangulated joint; of the joint in the fitted body
  double point_deg = 0, body_deg = 0;  ///< RMS errors of the direction of the limb that ends there, likewise; 0 for the
                                       ///< hip centre
};

struct RigForecast {
  std::vector<NamedCamera> cameras;   ///< metres, Y up
  std::optional<KeypointNoise> measured;  ///< from the take's keypoints, if there is one
  glm::dvec2 middle_m{0};             ///< of the volume
  std::vector<ForecastPlace> places;  ///< by height, then z, then x, each ascending
  double seen = 0;                    ///< share of places in the pictures of at least two cameras
  double median_mm = 0, p95_mm = 0;   ///< over these places
  ForecastPlace worst;                ///< the place of the largest error
  double bodies = 0;  ///< share of places on the floor where two cameras see each joint of a standing body
  std::vector<ForecastJoint> joints;  ///< one per role, averaged over these places; empty if there are none
  std::vector<RigWorth> worths;       ///< the rig itself, then each change
};

/// Computes the expected errors of a rig, prints them, and writes the files that `options` name. Fails, before anything
/// is written, for a rig of fewer than two cameras or of too many, for cameras that look in parallel if `middle_m` is
/// absent, and for a volume in which no place is seen by two cameras.
Result<RigForecast> ForecastRig(const ForecastOptions& options);

/// Draws a heat map for each height and a plan of the cameras. Returns the bytes of a PNG file.
std::string ForecastPicture(const RigForecast& forecast, const ForecastOptions& options);
/// Writes one HTML page with the picture and all tables.
std::string ForecastPage(const RigForecast& forecast, const ForecastOptions& options);
/// Return text for users: what was measured and assumed; what was found.
std::string AssumedWords(const RigForecast& forecast, const ForecastOptions& options);
std::string FoundWords(const RigForecast& forecast);

}  // namespace etude
