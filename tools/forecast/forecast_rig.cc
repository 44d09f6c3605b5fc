#include "tools/forecast/forecast_rig.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"
#include "engine/cameras/rig_doubts.h"
#include "io/drawing/numbers.h"
#include "io/drawing/table.h"
#include "io/files/files.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

constexpr double kMmPerM = 1000;

std::vector<Camera> CamerasOf(const std::vector<NamedCamera>& named) {
  std::vector<Camera> cameras;
  for (const NamedCamera& camera : named) cameras.push_back(camera.camera);
  return cameras;
}

/// Adds the cameras of the rig file, in the world, metres, Y up.
Result<void> AddCameras(const ForecastOptions& options, RigForecast& forecast) {
  ASSIGN_OR_RETURN(const RigFile rig, OpenRig(options.rig));
  constexpr std::size_t kMaxCameras = 32;
  const std::size_t most = options.errors.dropout > 0 ? kMaxDroppingCameras : kMaxCameras;
  if (rig.cameras.size() < 2 || rig.cameras.size() > most) {
    return Fail({options.rig}, "{}; allowed: 2 to {}{}", Plural(static_cast<long long>(rig.cameras.size()), "camera"),
                most, options.errors.dropout > 0 ? " with --dropout" : "");
  }
  const auto place = PlaceRig(rig, options.place);
  if (!place) return Fail({options.rig}, "{}", place.error().message);
  forecast.placed = fmt::format("{}: {}", rig.format, place->told);
  if (!place->doubt.empty()) forecast.doubts.push_back("doubtful: " + place->doubt);
  for (const NamedCamera& named : rig.cameras) {
    forecast.cameras.push_back({named.name, Placed(*place, named.camera)});
    Intrinsics& in = forecast.cameras.back().camera.intrinsics;
    if (in.width > 0) continue;
    // The file states no size: assume that the principal point is the picture's centre.
    in.width = static_cast<int>(std::lround(2 * in.cx));
    in.height = static_cast<int>(std::lround(2 * in.cy));
    if (in.width <= 0 || in.height <= 0)
      return Fail(
          {options.rig},
          "camera {}: the rig states no picture size, and the principal point does not determine a picture size",
          named.name);
    options.listener.print(fmt::format(
        "{}: the rig states no picture size, so Etude assumes {} x {} pixels, which are twice the principal point\n",
        named.name, in.width, in.height));
  }
  for (const std::string& doubt : RigDoubts(forecast.cameras)) forecast.doubts.push_back("doubtful: " + doubt);
  for (const std::string& doubt : forecast.doubts) options.listener.print(doubt + "\n");
  return {};
}

/// Returns the point (x, z) on the floor that lies below the point nearest to all optical axes, in whole millimetres.
Result<glm::dvec2> MiddleOf(const std::vector<NamedCamera>& cameras, const std::string& file) {
  glm::dmat3 normal(0);
  glm::dvec3 right(0);
  for (const auto& [name, camera] : cameras) {
    const glm::dvec3 axis_W = glm::transpose(camera.R_CW)[2];
    const glm::dmat3 across = glm::dmat3(1) - glm::outerProduct(axis_W, axis_W);
    normal += across;
    right += across * camera.p_WC;
  }
  // The minimum of det(`normal`) / (number of cameras)³. Below this value, the optical axes deviate from one
  // direction by less than about 2° (root mean square).
  constexpr double kParallel = 1e-3;
  if (!(glm::determinant(normal) > kParallel * std::pow(static_cast<double>(cameras.size()), 3))) {
    return Fail({file},
                "the cameras look in parallel directions, which do not determine the middle of the volume; use "
                "--middle X,Z, in m, to set the middle");
  }
  const glm::dvec3 middle = glm::inverse(normal) * right;
  return glm::round(kMmPerM * glm::dvec2(middle.x, middle.z)) / kMmPerM;
}

std::vector<ForecastPlace> PlacesOf(const std::vector<Camera>& cameras, const glm::dvec2& middle,
                                    const ForecastOptions& options, const SightingErrors& errors) {
  constexpr double kMicrometres = 1e6;
  std::vector<ForecastPlace> places;
  const glm::dvec3 low(middle.x - options.size_m.x / 2, 0, middle.y - options.size_m.z / 2);
  for (int h = 0; h < kForecastHeights; ++h) {
    for (int z = 0; z < kForecastRows; ++z) {
      for (int x = 0; x < kForecastColumns; ++x) {
        const glm::dvec3 share((x + 0.5) / kForecastColumns, (h + 0.5) / kForecastHeights, (z + 0.5) / kForecastRows);
        ForecastPlace place{.place_m = glm::round(kMicrometres * (low + share * options.size_m)) / kMicrometres};
        const PointError error = ExpectedPointError(cameras, place.place_m, errors);
        place.cameras = error.cameras;
        place.lost = error.lost;
        if (error.lost < 1) place.error_mm = kMmPerM * error.Rms();
        places.push_back(place);
      }
    }
  }
  return places;
}

double ShareSeen(const std::vector<ForecastPlace>& places) {
  const auto seen =
      std::ranges::count_if(places, [](const ForecastPlace& place) { return place.error_mm.has_value(); });
  return static_cast<double>(seen) / static_cast<double>(places.size());
}

/// Adds a doubt for each camera that sees no place of the volume, and prints it.
void AddBlindCameras(const ForecastOptions& options, RigForecast& forecast) {
  for (const auto& [name, camera] : forecast.cameras) {
    const Intrinsics& in = camera.intrinsics;
    const bool is_blind = std::ranges::none_of(forecast.places, [&](const ForecastPlace& place) {
      const auto pixel = Project(camera, place.place_m);
      return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x <= in.width && pixel->y <= in.height;
    });
    if (!is_blind) continue;
    forecast.doubts.push_back(fmt::format("doubtful: {}: this camera sees no place of the volume", name));
    options.listener.print(forecast.doubts.back() + "\n");
  }
}

/// Returns the errors in `places`, mm, of those places that also have an error in `own`.
std::vector<double> ErrorsWhere(const std::vector<ForecastPlace>& own, const std::vector<ForecastPlace>& places) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i].error_mm && places[i].error_mm) errors.push_back(*places[i].error_mm);
  }
  return errors;
}

/// The room in which another camera may stand.
struct Room {
  glm::dvec3 low, high;

  /// Returns how far the walls are from `place` (x, z), which is in the room, along a unit vector.
  double DistanceToWall(const glm::dvec2& place, const glm::dvec2& along) const {
    const auto to = [](double first, double last, double at, double step) {
      return step == 0 ? INFINITY : ((step > 0 ? last : first) - at) / step;
    };
    return std::min(to(low.x, high.x, place.x, along.x), to(low.z, high.z, place.y, along.y));
  }
};

Room RoomOf(const std::vector<Camera>& cameras, const glm::dvec2& middle, const ForecastOptions& options) {
  const glm::dvec3 size = options.room_m.value_or(options.size_m), floor(middle.x, 0, middle.y);
  Room room{floor - glm::dvec3(size.x / 2, 0, size.z / 2), floor + glm::dvec3(size.x / 2, size.y, size.z / 2)};
  if (options.room_m) return room;
  for (const Camera& camera : cameras) {
    room.low = glm::min(room.low, camera.p_WC);
    room.high = glm::max(room.high, camera.p_WC);
  }
  return room;
}

/// Finds the best place for one more camera. The new camera has the lens of the first camera and looks at the middle of
/// the volume. Tries 36 directions, three heights and three distances (0.75, 1 and 1.25 times the median distance of
/// the rig's cameras); those beyond a wall or the ceiling are moved to it. The best place has the largest sum of
/// 1 / error over a coarse grid of places in the volume; a place that fewer than two cameras see counts 0.
Camera BestAddition(const std::vector<Camera>& cameras, const std::vector<ForecastPlace>& places,
                    const glm::dvec2& middle, const ForecastOptions& options) {
  // Choose a coarse grid, and compute the rig's median distance from the middle.
  std::vector<const ForecastPlace*> coarse;
  for (int h = 1; h < kForecastHeights; h += 3) {
    for (int z = 2; z < kForecastRows; z += 4) {
      for (int x = 2; x < kForecastColumns; x += 4)
        coarse.push_back(&places[(h * kForecastRows + z) * kForecastColumns + x]);
    }
  }
  std::vector<double> distances;
  for (const Camera& camera : cameras)
    distances.push_back(glm::distance(glm::dvec2(camera.p_WC.x, camera.p_WC.z), middle));
  std::ranges::sort(distances);
  const double usual = distances[distances.size() / 2];
  const glm::dvec3 aim(middle.x, options.size_m.y / 2, middle.y);
  const Room room = RoomOf(cameras, middle, options);
  // Score every candidate.
  std::vector<Camera> more = cameras;
  more.emplace_back();
  Camera best;
  double best_score = -1;
  constexpr int kDirections = 36;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2 * kPi * k / kDirections;
    const glm::dvec2 along(std::sin(angle), std::cos(angle));
    const double wall = room.DistanceToWall(middle, along);
    for (const double height : {0.5, 1.5, 2.5}) {
      for (const double distance : {0.75 * usual, usual, 1.25 * usual}) {
        const glm::dvec2 at = middle + std::min(distance, wall) * along;
        const glm::dvec3 p_WC(at.x, std::min(height, room.high.y), at.y);
        if (glm::distance(at, middle) < 0.1) continue;  // the candidate would look straight down
        more.back() = LookAt(cameras.front().intrinsics, p_WC, aim);
        more.back().distortion = cameras.front().distortion;
        double score = 0;
        for (const ForecastPlace* place : coarse) {
          const PointError error = ExpectedPointError(more, place->place_m, options.errors);
          if (error.lost < 1) score += 1 / error.Rms();
        }
        if (score <= best_score) continue;
        best_score = score;
        best = more.back();
      }
    }
  }
  return best;
}

/// Adds the root mean square errors of a standing body's joints. The body stands on every second place of the floor
/// along x and z, and faces first +Z, then +X.
Result<void> AddJoints(const std::vector<Camera>& cameras, const ForecastOptions& options, RigForecast& forecast) {
  std::array<JointErrors, kRoleCount> sums{};
  std::array<double, kRoleCount> noise_px{};
  // For the keypoint of each joint, take the measured noise if it exists, otherwise the assumed noise.
  for (const Role role : AllRoles()) {
    noise_px[Index(role)] = forecast.measured ? forecast.measured->Of(role) : options.errors.noise_px;
  }
  // Sum the squared errors over the two headings and all places.
  int whole = 0, all = 0;
  for (const double yaw : {0.0, kPi / 2}) {
    ASSIGN_OR_RETURN(const auto bodies, PoseErrorForecast::Of(FloorMove{.yaw = yaw}.Apply(PoseOf(ReadyStance()))));
    for (int z = 0; z < kForecastRows; z += 2) {
      for (int x = 0; x < kForecastColumns; x += 2) {
        const glm::dvec3 place = forecast.places[z * kForecastColumns + x].place_m;
        const auto errors = bodies.At(cameras, {place.x, 0, place.z}, options.errors, noise_px);
        ++all;
        if (!errors) continue;
        ++whole;
        for (std::size_t i = 0; i < kRoleCount; ++i) {
          sums[i].point += (*errors)[i].point;
          sums[i].body += (*errors)[i].body;
          sums[i].point_turn += (*errors)[i].point_turn;
          sums[i].body_turn += (*errors)[i].body_turn;
        }
      }
    }
  }
  // Turn the sums into root mean squares.
  forecast.bodies = static_cast<double>(whole) / all;
  if (whole == 0) return {};
  const auto mm = [&](double sum) { return kMmPerM * std::sqrt(sum / whole); };
  const auto deg = [&](double sum) { return Degrees(std::sqrt(sum / whole)); };
  for (const Role role : AllRoles()) {
    const JointErrors& sum = sums[Index(role)];
    const auto noise = IsTriangulated(role) ? std::optional(noise_px[Index(role)]) : std::nullopt;
    forecast.joints.push_back({role, noise, mm(sum.point), mm(sum.body), deg(sum.point_turn), deg(sum.body_turn)});
  }
  return {};
}

/// Adds the errors of the unchanged rig, and the errors of the rig after each of these changes alone: more exact
/// pixels, a better calibration, one more camera.
void AddWorths(const std::vector<Camera>& cameras, const ForecastOptions& options, RigForecast& forecast) {
  const auto add = [&](const std::string& change, const std::vector<Camera>& changed, const SightingErrors& errors,
                       std::optional<glm::dvec3> added = {}) {
    const auto places = PlacesOf(changed, forecast.middle_m, options, errors);
    const std::vector<double> there = ErrorsWhere(forecast.places, places);
    forecast.worths.push_back({change, added, ShareSeen(places), Quantile(there, 0.5)});
  };
  add("as it is", cameras, options.errors);
  SightingErrors errors = options.errors;
  errors.noise_px /= 2;
  add("keypoints twice as exact", cameras, errors);
  if (options.errors.calibration != CalibrationDeviation{}) {
    errors = options.errors;
    for (double* one : {&errors.calibration.place_m, &errors.calibration.turn, &errors.calibration.focal}) *one /= 2;
    add("a calibration twice as exact", cameras, errors);
    errors.calibration = {};
    add("a perfect calibration", cameras, errors);
  }
  if (options.errors.dropout > 0 && cameras.size() == kMaxDroppingCameras) return;
  std::vector<Camera> more = cameras;
  more.push_back(BestAddition(cameras, forecast.places, forecast.middle_m, options));
  const glm::dvec3 p = more.back().p_WC;
  add(fmt::format("one more camera at x {:.1f}, z {:.1f}, {:.1f} m high", p.x, p.z, p.y), more, options.errors, p);
}

std::string PlacesCsv(const RigForecast& forecast) {
  Table table;
  for (const char* head : {"x_m", "height_m", "z_m", "cameras", "lost_share", "error_mm"})
    table.columns.push_back({.head = head, .is_number = true});
  for (const ForecastPlace& place : forecast.places) {
    table.rows.push_back(
        {{place.place_m.x, place.place_m.y, place.place_m.z, place.cameras, place.lost, TableCell(place.error_mm)}});
  }
  return TableCsv(table);
}

std::string CamerasText(const RigForecast& forecast) {
  std::string text = forecast.placed + "\n";
  for (const auto& [name, camera] : forecast.cameras) {
    const glm::dvec3& p = camera.p_WC;
    text += fmt::format("  {:<14} x {:.2f}, z {:.2f}, {:.2f} m high\n", name, p.x, p.z, p.y);
  }
  return text;
}

std::string JointsText(const RigForecast& forecast) {
  if (forecast.joints.empty()) return "There is no place where two cameras see all joints of a standing body.\n";
  std::string text = fmt::format(
      "\n"
      "Root mean square errors of a standing body, over the {:.0f} % of the floor where two cameras see every joint.\n"
      "Triangulated: the error of each joint on its own. Fitted: the error of the same joint, if a body is fitted to "
      "all\n"
      "joints at once. Limb: the error of the direction of the limb that ends in the joint.\n"
      "{:<16}{:>15}{:>18}{:>12}{:>24}{:>18}\n",
      100 * forecast.bodies, "joint", "keypoints, px", "triangulated, mm", "fitted, mm", "limb triangulated, deg",
      "limb fitted, deg");
  for (const ForecastJoint& joint : forecast.joints) {
    const bool has_limb = joint.role != Role::kHipCentre;
    const auto degrees = [&](double value) { return has_limb ? fmt::format("{:.1f}", value) : std::string("-"); };
    const std::string noise = joint.noise_px ? fmt::format("{:.1f}", *joint.noise_px) : "-";
    text += fmt::format("{:<16}{:>15}{:>18.1f}{:>12.1f}{:>24}{:>18}\n", RoleName(joint.role), noise, joint.point_mm,
                        joint.body_mm, degrees(joint.point_deg), degrees(joint.body_deg));
  }
  return text;
}

std::string WorthsText(const RigForecast& forecast) {
  std::string text = fmt::format(
      "\n"
      "What would help. Median: the median error of a point, over the places that two cameras of the present rig see.\n"
      "Visible: the share of all places that two cameras of the changed rig see.\n"
      "{:<52}{:>12}{:>13}\n",
      "", "median, mm", "visible");
  for (const RigWorth& worth : forecast.worths)
    text += fmt::format("{:<52}{:>12.1f}{:>11.0f} %\n", worth.change, worth.median_mm, 100 * worth.seen);
  return text;
}

}  // namespace

std::string AssumedWords(const RigForecast& forecast, const ForecastOptions& options) {
  const SightingErrors& errors = options.errors;
  const std::string measured =
      forecast.measured
          ? fmt::format(
                "Measured: the standard deviation of keypoints is {:.1f} px along each axis ({} points). Assumed:",
                forecast.measured->all_px, forecast.measured->points)
          : fmt::format("Assumed: the standard deviation of keypoints is {:g} px along each axis;", errors.noise_px);
  return fmt::format(
      "{} a joint has no keypoint in {:g} % of a camera's pictures; the standard deviations of cameras are {:g} mm, "
      "{:g} degrees and {:g} % of the focal length",
      measured, 100 * errors.dropout, kMmPerM * errors.calibration.place_m, Degrees(errors.calibration.turn),
      100 * errors.calibration.focal);
}

std::string FoundWords(const RigForecast& forecast) {
  const glm::dvec3& worst = forecast.worst.place_m;
  return fmt::format(
      "The error of a point is {:.1f} mm in the median and {:.1f} mm at the 95th percentile, over the {:.0f} % of "
      "places that two cameras see. The largest error is {:.1f} mm at x {:.2f}, z {:.2f}, {:.2f} m high",
      forecast.median_mm, forecast.p95_mm, 100 * forecast.seen, *forecast.worst.error_mm, worst.x, worst.z, worst.y);
}

Result<RigForecast> ForecastRig(const ForecastOptions& asked) {
  RigForecast forecast;
  ForecastOptions options = asked;
  if (!options.take.keypoints.empty()) {
    options.take.rig = options.rig;
    options.take.listener = options.listener;
    ASSIGN_OR_RETURN(forecast.measured, MeasureFilmedNoise(options.take));
    options.errors.noise_px = forecast.measured->all_px;
  }
  RETURN_IF_ERROR(AddCameras(options, forecast));
  const std::vector<Camera> cameras = CamerasOf(forecast.cameras);
  if (options.middle_m) {
    forecast.middle_m = *options.middle_m;
  } else {
    ASSIGN_OR_RETURN(forecast.middle_m, MiddleOf(forecast.cameras, options.rig));
  }
  // Compute the error at every place of the grid.
  forecast.places = PlacesOf(cameras, forecast.middle_m, options, options.errors);
  forecast.seen = ShareSeen(forecast.places);
  if (forecast.seen == 0) {
    return Fail({options.rig},
                "two cameras see no common place within {:g} x {:g} m around x {:.2f}, z {:.2f}; use another --middle, "
                "--size or --rig-unit",
                options.size_m.x, options.size_m.z, forecast.middle_m.x, forecast.middle_m.y);
  }
  AddBlindCameras(options, forecast);
  const std::vector<double> errors = ErrorsWhere(forecast.places, forecast.places);
  constexpr double kMedian = 0.5, k95Percent = 0.95;
  forecast.median_mm = Quantile(errors, kMedian);
  forecast.p95_mm = Quantile(errors, k95Percent);
  forecast.worst = *std::ranges::max_element(forecast.places, {},
                                             [](const ForecastPlace& place) { return place.error_mm.value_or(-1); });
  // Compute the errors of a person who stands in the volume, and the gain from each change.
  RETURN_IF_ERROR(AddJoints(cameras, options, forecast));
  AddWorths(cameras, options, forecast);
  options.listener.print(
      fmt::format("{}{} cameras; the middle of the volume is at x {:.2f}, z {:.2f}, and the volume is {:g} m along x, "
                  "{:g} m along z, {:g} m high\n"
                  "{}\n"
                  "{}\n"
                  "{}{}",
                  CamerasText(forecast), cameras.size(), forecast.middle_m.x, forecast.middle_m.y, options.size_m.x,
                  options.size_m.z, options.size_m.y, AssumedWords(forecast, options), FoundWords(forecast),
                  JointsText(forecast), WorthsText(forecast)));
  const auto write = [&](const std::string& path, const auto& bytes) -> Result<void> {
    if (path.empty()) return {};
    RETURN_IF_ERROR(WriteFileAtomically(path, bytes()));
    TellWritten(options.listener, path);
    return {};
  };
  RETURN_IF_ERROR(write(options.picture, [&] { return ForecastPicture(forecast, options); }));
  RETURN_IF_ERROR(write(options.table, [&] { return PlacesCsv(forecast); }));
  RETURN_IF_ERROR(write(options.report, [&] { return ForecastPage(forecast, options); }));
  return forecast;
}

}  // namespace etude
