#pragma once

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
  std::string rig;         ///< a calibration that OpenRig can open
  PlacementOptions place;  ///< the rig's unit, up axis and floor
  SightingErrors errors;
  /// Films and keypoints taken with the rig; the measured noise of these keypoints replaces `errors.noise_px`; may be
  /// empty.
  CaptureFilmsOptions take = {};
  glm::dvec3 size_m{3, 2, 3};  ///< the volume in which people move, metres: width (x), height from the floor, depth (z)
  /// The volume's middle on the floor (x, z); absent = below the point that is nearest to all optical axes.
  std::optional<glm::dvec2> middle_m;
  /// The room around this middle in which another camera may stand, like `size_m`; absent = the smallest box with all
  /// cameras and the volume.
  std::optional<glm::dvec3> room_m = {};
  std::string picture;       ///< a PNG of heat maps, "" = none
  std::string table;         ///< a CSV of all places, "" = none
  std::string report;        ///< an HTML page, "" = none
  std::string command_line;  ///< the command as typed, which `report` shows
  std::string version;       ///< version of the program, which `report` shows
  Listener listener = {};
};

/// The number of places along x, height and z at which errors are computed. The places are the middles of equal cells.
inline constexpr int kForecastColumns = 20, kForecastHeights = 10, kForecastRows = 20;

/// The expected error at one place.
struct ForecastPlace {
  glm::dvec3 place_m{0};
  int cameras = 0;                      ///< number of cameras whose pictures contain this place
  double lost = 1;                      ///< probability that a point in this place cannot be triangulated
  std::optional<double> error_mm = {};  ///< root mean square distance, mm; absent if two cameras never see the place
};

/// The expected error over the volume, for the unchanged rig or with one change.
struct RigWorth {
  std::string change;                      ///< the change, in words for users
  std::optional<glm::dvec3> added_m = {};  ///< position of the added camera; absent if the change adds none
  double seen = 0;                         ///< share of all places that are in the pictures of at least two cameras
  double median_mm = 0;                    ///< median error over the places that the unchanged rig also sees
};

/// The expected root mean square errors of one joint of a person who stands in the volume.
struct ForecastJoint {
  Role role = Role::kHipCentre;
  /// Standard deviation of the joint's keypoints, pixels; absent if the joint is not triangulated.
  std::optional<double> noise_px;
  double point_mm = 0, body_mm = 0;  ///< RMS errors: of the triangulated joint, and of the joint in the fitted body
  /// RMS errors of the direction of the limb that ends at the joint, from triangulation and from the fitted body; 0 for
  /// the hip centre.
  double point_deg = 0, body_deg = 0;
};

struct RigForecast {
  std::vector<NamedCamera> cameras;   ///< cameras in the world, metres, Y up
  std::string placed;                 ///< the file's format, its unit and its axes, in words for users
  std::vector<std::string> doubts;    ///< doubts about the rig, "doubtful: …", for users
  std::optional<KeypointNoise> measured;  ///< noise measured from the take's keypoints; absent without a take
  glm::dvec2 middle_m{0};                 ///< middle of the volume on the floor (x, z); if computed, in whole mm
  std::vector<ForecastPlace> places;      ///< places sorted by height, then z, then x; in whole micrometres
  double seen = 0;                    ///< share of places in the pictures of at least two cameras
  double median_mm = 0, p95_mm = 0;   ///< median and 95th percentile of the error over the places that are seen
  ForecastPlace worst;                ///< the place with the largest error among the seen places
  double bodies = 0;  ///< share of places on the floor at which two cameras see each joint of a standing body
  /// One entry per role, averaged over the places that `bodies` counts; empty if `bodies` is 0.
  std::vector<ForecastJoint> joints;
  std::vector<RigWorth> worths;       ///< the unchanged rig, then the rig with each change
};

/// Computes the expected errors of a rig, prints them, and writes the files that `options` name. Fails before anything
/// is written if PlaceRig fails, if the rig has fewer than two or too many cameras, if `middle_m` is absent and all
/// optical axes are parallel, or if two cameras see no place of the volume.
Result<RigForecast> ForecastRig(const ForecastOptions& options);

/// Draws a heat map for each height and a plan of the cameras. Returns the bytes of a PNG file.
std::string ForecastPicture(const RigForecast& forecast, const ForecastOptions& options);
/// Writes one HTML page with the picture and all tables.
std::string ForecastPage(const RigForecast& forecast, const ForecastOptions& options);
/// Return texts for users: the measured and assumed inputs, and the results.
std::string AssumedWords(const RigForecast& forecast, const ForecastOptions& options);
std::string FoundWords(const RigForecast& forecast);

}  // namespace etude
