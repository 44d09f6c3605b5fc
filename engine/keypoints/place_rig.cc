#include "engine/keypoints/place_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

using enum Landmark;

struct LengthUnit {
  std::string_view name;
  double metres;
  double min_stature_m;  ///< rare units must give an adult
};
constexpr double kMinStature = 0.5, kMaxStature = 2.2, kAdult = 1.2;
constexpr std::array kUnits = {LengthUnit{"m", 1, kMinStature}, LengthUnit{"cm", 0.01, kMinStature},
                               LengthUnit{"mm", 0.001, kMinStature}, LengthUnit{"inch", 0.0254, kAdult},
                               LengthUnit{"foot", 0.3048, kAdult}};

struct FileAxis {
  std::string_view name;
  glm::dvec3 direction;
};
constexpr std::array kAxes = {FileAxis{"x", {1, 0, 0}},   FileAxis{"y", {0, 1, 0}},   FileAxis{"z", {0, 0, 1}},
                              FileAxis{"-x", {-1, 0, 0}}, FileAxis{"-y", {0, -1, 0}}, FileAxis{"-z", {0, 0, -1}}};

std::optional<double> WholeNumber(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<double> MetresOf(std::string_view unit) {
  for (const LengthUnit& one : kUnits) {
    if (one.name == unit) return one.metres;
  }
  const auto number = WholeNumber(unit);
  return number && *number > 0 ? number : std::nullopt;
}

const FileAxis* AxisOf(std::string_view name) {
  const auto found = std::ranges::find(kAxes, name, &FileAxis::name);
  return found == kAxes.end() ? nullptr : &*found;
}

std::string UnitText(double metres) {
  for (const LengthUnit& one : kUnits) {
    if (one.metres == metres) return std::string(one.name);
  }
  return fmt::format("units of {:g} m", metres);
}

/// Returns the smallest rotation that maps `up` to our y axis.
glm::dmat3 Upright(const glm::dvec3& up) {
  const glm::dvec3 y(0, 1, 0);
  const glm::dvec3 axis = glm::cross(up, y);
  const double sine = glm::length(axis);
  constexpr double kSame = 1e-12;
  if (sine < kSame) return up.y > 0 ? glm::dmat3(1) : glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1);
  return glm::mat3_cast(glm::angleAxis(std::atan2(sine, up.y), axis / sine));
}

double AngleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Returns the name of the camera whose frame is the file's world; "" if there is none.
std::string CameraOfTheWorld(const RigFile& rig) {
  for (const NamedCamera& named : rig.cameras) {
    const glm::dmat3 R_CF = named.camera.R_CW * rig.R_WF;
    double off = glm::length(named.camera.p_WC);
    for (int i = 0; i < 3; ++i) off += glm::length(R_CF[i] - glm::dmat3(1)[i]);
    constexpr double kSame = 1e-5;
    if (off < kSame) return named.name;
  }
  return {};
}

/// Returns twice the median leg (hip to knee to ankle) in the rig's lengths; nullopt if no frame shows one.
std::optional<double> StatureOf(std::span<const LandmarkPositions> points) {
  std::vector<double> thighs, shanks;
  for (const LandmarkPositions& at : points) {
    for (const auto& [hip, knee, ankle] :
         {std::array{kLeftHip, kLeftKnee, kLeftAnkle}, {kRightHip, kRightKnee, kRightAnkle}}) {
      const auto &h = at[Index(hip)], &k = at[Index(knee)], &a = at[Index(ankle)];
      if (h && k) thighs.push_back(glm::distance(*h, *k));
      if (k && a) shanks.push_back(glm::distance(*k, *a));
    }
  }
  if (thighs.empty() || shanks.empty()) return std::nullopt;
  constexpr double kStatureOfLeg = 2.0;  // Drillis and Contini 1966: hip 0.53, ankle 0.039 of the stature
  return kStatureOfLeg * (UpperMedian(thighs) + UpperMedian(shanks));
}

/// Returns the mean direction from the ankles to the shoulders.
std::optional<glm::dvec3> PersonsUp(std::span<const LandmarkPositions> points) {
  glm::dvec3 sum(0);
  for (const LandmarkPositions& at : points) {
    const auto &a = at[Index(kLeftAnkle)], &b = at[Index(kRightAnkle)], &c = at[Index(kLeftShoulder)],
               &d = at[Index(kRightShoulder)];
    if (a && b && c && d) sum += *c + *d - *a - *b;
  }
  const double length = glm::length(sum);
  if (!(length > 0)) return std::nullopt;
  return sum / length;
}

/// The floor as estimated from resting feet.
struct FeetPlane {
  glm::dvec3 up;
  double accuracy = 0;  ///< standard deviation in the worse direction, radians
  double height = 0;    ///< of the floor along `up`
};

/// The landmarks of a foot, and the height of each above the sole, metres.
constexpr std::array<std::pair<std::array<Landmark, 2>, double>, 4> kFeet = {{{{kLeftAnkle, kRightAnkle}, 0.08},
                                                                              {{kLeftHeel, kRightHeel}, 0.03},
                                                                              {{kLeftBigToe, kRightBigToe}, 0.02},
                                                                              {{kLeftSmallToe, kRightSmallToe}, 0.02}}};

/// Returns the positions of a foot landmark while it rests on the floor: its speed is below a fifth of the stature per
/// second, and its height within a twentieth of the stature of the lowest tenth along `up`.
std::vector<glm::dvec3> Resting(std::span<const LandmarkPositions> points, const std::array<Landmark, 2>& kind,
                                const glm::dvec3& up, double rate_hz, double stature) {
  std::vector<glm::dvec3> slow;
  std::vector<double> heights;
  for (const Landmark landmark : kind) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto &before = points[i - 1][Index(landmark)], &now = points[i][Index(landmark)];
      if (!before || !now || glm::distance(*before, *now) * rate_hz > 0.2 * stature) continue;
      slow.push_back(*now);
      heights.push_back(glm::dot(up, *now));
    }
  }
  if (slow.empty()) return slow;
  const double lowest = LowerPercentile(heights, 0.1);
  std::erase_if(slow, [&](const glm::dvec3& p) { return glm::dot(up, p) > lowest + 0.05 * stature; });
  return slow;
}

/// Refines `person_up` by the feet: finds the direction n that minimises Σ (n · q)² / σ² + |n − person_up|² / 0.1². The
/// q are the positions of one kind of landmark relative to their mean (their total weight is limited to that of
/// twenty), and the means of the kinds, corrected for their height above the sole, relative to the mean of the means. σ
/// is 0.6 % of the stature.
FeetPlane PlaneOfFeet(std::span<const LandmarkPositions> points, const glm::dvec3& person_up, double rate_hz,
                      double stature) {
  constexpr double kPersonLeans = 0.1, kMaxCounted = 20;
  const double sigma = 0.006 * stature;
  const double metre = stature / 1.7;
  FeetPlane plane{person_up, kPersonLeans};
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    // Normal equations for a small tilt in the tangent plane of `up`, with the prior.
    const glm::dvec3 side = glm::normalize(std::abs(plane.up.x) < 0.6 ? glm::cross(plane.up, glm::dvec3(1, 0, 0))
                                                                      : glm::cross(plane.up, glm::dvec3(0, 1, 0)));
    const glm::dmat2x3 tangent(side, glm::cross(plane.up, side));
    const glm::dvec3 lean = person_up - plane.up;
    glm::dmat2 information(1 / (kPersonLeans * kPersonLeans));
    glm::dvec2 right = glm::transpose(tangent) * lean / (kPersonLeans * kPersonLeans);
    std::vector<double> floors;
    std::vector<std::pair<glm::dvec3, double>> means;  // of each kind, and how far it is above the sole
    // Add the positions of each kind of landmark.
    for (const auto& [kind, above] : kFeet) {
      const auto resting = Resting(points, kind, plane.up, rate_hz, stature);
      if (resting.empty()) continue;
      glm::dvec3 mean(0);
      for (const glm::dvec3& p : resting) mean += p / static_cast<double>(resting.size());
      const double weight = std::min(1.0, kMaxCounted / static_cast<double>(resting.size())) / (sigma * sigma);
      for (const glm::dvec3& p : resting) {
        const glm::dvec2 q = glm::transpose(tangent) * (p - mean);
        information += weight * glm::outerProduct(q, q);
        right -= weight * glm::dot(plane.up, p - mean) * q;
      }
      floors.push_back(glm::dot(plane.up, mean) - above * metre);
      means.emplace_back(mean, above * metre);
    }
    // Add the means of the kinds.
    glm::dvec3 middle(0);
    double middle_above = 0;
    for (const auto& [mean, above] : means) {
      middle += mean / static_cast<double>(means.size());
      middle_above += above / static_cast<double>(means.size());
    }
    for (const auto& [mean, above] : means) {
      const glm::dvec2 q = glm::transpose(tangent) * (mean - middle);
      information += glm::outerProduct(q, q) / (sigma * sigma);
      right -= (glm::dot(plane.up, mean - middle) - (above - middle_above)) / (sigma * sigma) * q;
    }
    // Tilt `up` by the solution; the smaller eigenvalue gives the accuracy.
    plane.up = glm::normalize(plane.up + tangent * (glm::inverse(information) * right));
    const double half = 0.5 * (information[0][0] + information[1][1]);
    const double least = half - std::sqrt(std::max(0.0, half * half - glm::determinant(information)));
    plane.accuracy = 1 / std::sqrt(least);
    if (!floors.empty()) plane.height = UpperMedian(floors);
  }
  return plane;
}

/// Returns the unit that gives an adult's stature, or else a plausible one; null if there is none.
const LengthUnit* LikelyUnit(double file_units) {
  for (const LengthUnit& unit : kUnits) {
    const double stature = unit.metres * file_units;
    if (stature >= kAdult && stature <= kMaxStature) return &unit;
  }
  for (const LengthUnit& unit : kUnits) {
    const double stature = unit.metres * file_units;
    if (stature >= unit.min_stature_m && stature <= kMaxStature) return &unit;
  }
  return nullptr;
}

constexpr double kUsualStature = 1.7;

Result<double> UnitOf(const RigFile& rig, double file_units, const PlacementOptions& options, std::string& told) {
  const double factor = kUsualStature / file_units;
  // A requested unit must give a plausible stature.
  if (options.unit != "auto") {
    const double metres = *MetresOf(options.unit);
    const double stature = metres * file_units;
    if (stature < kMinStature || stature > kMaxStature) {
      return Fail(
          {}, "in {} the person would be {:.3g} m tall; allowed: {:g} to {:g} m; for one of {:g} m: --rig-unit {:.4g}",
          UnitText(metres), stature, kMinStature, kMaxStature, kUsualStature, factor);
    }
    told = fmt::format("lengths in {} (as you say: a person of {:.2f} m)", UnitText(metres), stature);
    return metres;
  }
  if (!rig.has_unit) {
    return Fail({}, "{}'s lengths have no unit; tell one by --rig-unit: for a person of {:g} m it is {:.4g} m",
                rig.format, kUsualStature, factor);
  }
  // Keep the format's unit if it gives a plausible stature.
  const double usual = rig.unit_m * file_units;
  if (usual >= kMinStature && usual <= kMaxStature) {
    told = fmt::format("lengths in {} (a person of {:.2f} m)", UnitText(rig.unit_m), usual);
    return rig.unit_m;
  }
  // Otherwise look for another unit.
  const LengthUnit* likely = LikelyUnit(file_units);
  if (likely == nullptr) {
    return Fail({},
                "the person is {:.4g} units tall: no person in m, cm, mm, inch or foot; for one of {:g} m tell "
                "--rig-unit {:.4g}",
                file_units, kUsualStature, factor);
  }
  told = fmt::format("lengths in {} (found: a person of {:.2f} m; in {} it were {:.4g} m)", likely->name,
                     likely->metres * file_units, UnitText(rig.unit_m), usual);
  return likely->metres;
}

double Degrees(double radians) { return radians * 180 / kPi; }

/// Returns the up axis in the cameras' world, and true if the feet determined it.
Result<std::pair<glm::dvec3, bool>> UpOf(const RigFile& rig, const glm::dvec3& person, const FeetPlane& plane,
                                         const PlacementOptions& options, std::string& told) {
  const glm::dvec3 usual(0, 1, 0);
  constexpr double kUpsideDown = 100, kFar = 35, kAxisItself = 4;
  const auto usual_name = [&] {
    for (const FileAxis& axis : kAxes) {
      if (glm::dot(rig.R_WF * axis.direction, usual) > 0.999) return std::string(axis.name);
    }
    return std::string("y");
  };
  // A requested axis must not put the person upside down.
  if (options.up != "auto" && options.up != "floor") {
    const glm::dvec3 up = rig.R_WF * AxisOf(options.up)->direction;
    const double off = Degrees(AngleBetween(up, person));
    if (off > kUpsideDown) {
      return Fail({}, "with {} up the person hangs head down ({:.0f}° off); ankles to shoulders lead up", options.up,
                  off);
    }
    told = fmt::format("up is {} (as you say; the person leans {:.0f}° from it)", options.up, off);
    return std::pair(up, false);
  }
  const std::string camera = CameraOfTheWorld(rig);
  const double off = Degrees(AngleBetween(usual, person));
  const double tilt = Degrees(AngleBetween(usual, plane.up)), accuracy = Degrees(plane.accuracy);
  constexpr double kTold = 3, kTilted = 8, kSure = 3;
  // Caliscope's axes are those of a calibration board. For formats that define an up axis, feet that are not level (on
  // a beam) are no reason to tilt the world.
  const bool is_level = rig.format != "Caliscope" || tilt < std::max(kSure * accuracy, kTilted);
  if (options.up == "auto" && camera.empty() && rig.has_unit && off < kFar && is_level) {
    told = fmt::format("up is {} (the person leans {:.0f}° from it)", usual_name(), off);
    if (tilt > std::max(kSure * accuracy, kTold)) {
      told += fmt::format(
          ", though the floor under the feet is {:.0f}° off level; if they stood on a level floor, give --rig-up floor",
          tilt);
    }
    return std::pair(usual, false);
  }
  // Prefer an axis of the file that is close to the normal of the feet's plane.
  if (camera.empty() && options.up == "auto") {
    for (const FileAxis& axis : kAxes) {
      const glm::dvec3 up = rig.R_WF * axis.direction;
      if (Degrees(AngleBetween(up, plane.up)) < std::max(kAxisItself, 2 * accuracy)) {
        told = fmt::format("up is {} (found: feet and person)", axis.name);
        return std::pair(up, true);
      }
    }
  }
  told = fmt::format("up is square to the floor under the feet, to about {:.1f}°{}", Degrees(plane.accuracy),
                     camera.empty() ? "" : fmt::format(" (the world was {}'s own frame)", camera));
  return std::pair(plane.up, true);
}

}  // namespace

std::string RigUnits() {
  std::string names;
  for (const LengthUnit& unit : kUnits) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

Result<void> CheckPlace(const PlacementOptions& options) {
  if (options.unit != "auto" && !MetresOf(options.unit)) {
    return Fail({}, "--rig-unit {}; allowed: auto, {}, or metres in one unit", options.unit, RigUnits());
  }
  if (options.up != "auto" && options.up != "floor" && AxisOf(options.up) == nullptr) {
    return Fail({}, "--rig-up {}; allowed: auto, floor, x, y, z, -x, -y, -z", options.up);
  }
  if (options.floor != "auto" && options.floor != "keep" && options.floor != "feet" && !WholeNumber(options.floor)) {
    return Fail({}, "--floor {}; allowed: auto, keep, feet, or its height in metres", options.floor);
  }
  return {};
}

Result<RigPlacement> PlaceRig(const RigFile& rig, std::span<const LandmarkPositions> points, double rate_hz,
                          const PlacementOptions& options) {
  RETURN_IF_ERROR(CheckPlace(options));
  const auto stature = StatureOf(points);
  const auto person = PersonsUp(points);
  if (!stature || !person)
    return Fail({}, "no frame shows hips, knees, ankles and shoulders: nothing tells the rig's unit and up");
  RigPlacement place;
  // Unit, then up axis.
  std::string unit_told, up_told;
  ASSIGN_OR_RETURN(const double unit, UnitOf(rig, *stature / rig.unit_m, options, unit_told));
  const FeetPlane plane = PlaneOfFeet(points, *person, rate_hz, *stature);
  ASSIGN_OR_RETURN(const auto up, UpOf(rig, *person, plane, options, up_told));
  place.scale = unit == rig.unit_m ? 1 : unit / rig.unit_m;
  place.R = Upright(up.first);
  place.stature_m = place.scale * *stature;
  // The floor.
  std::string floor_told = ", the floor as the file has it";
  const bool at_feet = options.floor == "feet" || (options.floor == "auto" && up.second);
  if (const auto height = WholeNumber(options.floor)) {
    place.shift.y = -*height;
    floor_told = fmt::format(", the floor at {:g} m of it", *height);
  } else if (at_feet) {
    // Along the chosen axis, which may differ from the normal of the feet's plane.
    const FeetPlane level = PlaneOfFeet(points, up.first, rate_hz, *stature);
    place.shift.y = -place.scale * level.height;
    floor_told = ", the floor under the feet";
  }
  place.told = unit_told + "; " + up_told + floor_told;
  return place;
}

Result<RigPlacement> PlaceRig(const RigFile& rig, const PlacementOptions& options) {
  RETURN_IF_ERROR(CheckPlace(options));
  RigPlacement place;
  if (options.unit != "auto") {
    place.scale = *MetresOf(options.unit) / rig.unit_m;
  } else if (!rig.has_unit) {
    return Fail({}, "{}'s lengths have no unit; tell metres in one unit by --rig-unit", rig.format);
  }
  if (const FileAxis* axis = AxisOf(options.up)) {
    place.R = Upright(rig.R_WF * axis->direction);
  } else if (const std::string camera = CameraOfTheWorld(rig); !camera.empty() || options.up == "floor") {
    return Fail({}, "no keypoints tell which way is up{}; tell the file's axis by --rig-up",
                camera.empty() ? "" : fmt::format(" in {}'s own frame", camera));
  }
  if (const auto height = WholeNumber(options.floor)) place.shift.y = -*height;
  return place;
}

Camera Placed(const RigPlacement& place, Camera camera) {
  if (place.IsNone()) return camera;
  camera.R_CW = camera.R_CW * glm::transpose(place.R);
  camera.p_WC = place(camera.p_WC);
  return camera;
}

}  // namespace etude
