#include "engine/keypoints/place_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/keypoints/find_up.h"
#include "engine/keypoints/resting_feet.h"

namespace etude {
namespace {

using enum Landmark;

struct LengthUnit {
  std::string_view name;
  double metres;
  double min_stature_m;  ///< smallest plausible stature in this unit; for the rare units, an adult's
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

std::optional<double> MetresOf(std::string_view unit) {
  for (const LengthUnit& one : kUnits) {
    if (one.name == unit) return one.metres;
  }
  const auto number = ParseFinite(unit);
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

// Drillis and Contini 1966: hip and ankle are at 0.53 and 0.039 of the stature.
constexpr double kStatureOfLeg = 2.0;

/// Returns the stature in the rig's lengths, estimated as twice the median leg (hip to knee to ankle); nullopt if no
/// frame shows a leg.
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

/// Returns the unit that gives an adult's stature, or else a unit that gives a plausible stature; null if no unit does.
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

/// Returns a text that states the leg length of a person of this stature. Messages state the leg length because only
/// the legs are measured. The stature may be 10 % wrong: keypoints are not exactly at the ends of the limbs, and the
/// ratio of stature to leg length differs between people.
std::string LegsText(double stature) {
  return fmt::format("legs of {:.3g} m from hip to ankle", stature / kStatureOfLeg);
}

/// @param file_units the person's stature, estimated from the legs, in the file's lengths
Result<double> UnitOf(const RigFile& rig, double file_units, const PlacementOptions& options, std::string& told) {
  constexpr double kUsualStature = 1.7;
  const LengthUnit* likely = rig.has_unit ? LikelyUnit(file_units) : nullptr;
  const std::string advice = likely != nullptr ? fmt::format("--rig-unit {} gives legs of {:.3g} m", likely->name,
                                                             likely->metres * file_units / kStatureOfLeg)
                                               : fmt::format("for a person of {:g} m, use about --rig-unit {:.2g}",
                                                             kUsualStature, kUsualStature / file_units);
  // A requested unit must give a plausible stature.
  if (options.unit != "auto") {
    const double metres = *MetresOf(options.unit);
    const double stature = metres * file_units;
    if (stature < kMinStature || stature > kMaxStature) {
      return Fail({}, "with lengths in {}, the person would have {}; allowed: {:g} to {:g} m; {}", UnitText(metres),
                  LegsText(stature), kMinStature / kStatureOfLeg, kMaxStature / kStatureOfLeg, advice);
    }
    told = fmt::format("lengths in {} (as given; {})", UnitText(metres), LegsText(stature));
    return metres;
  }
  if (!rig.has_unit) {
    return Fail({},
                "a calibration of the format {} has no unit of length; set the unit by --rig-unit: for a person of "
                "{:g} m, the unit is about {:.2g} m",
                rig.format, kUsualStature, kUsualStature / file_units);
  }
  // Keep the format's unit if it gives a plausible stature.
  const double usual = rig.unit_m * file_units;
  if (usual >= kMinStature && usual <= kMaxStature) {
    told = fmt::format("lengths in {} ({})", UnitText(rig.unit_m), LegsText(usual));
    return rig.unit_m;
  }
  // Otherwise look for a unit that gives a plausible stature.
  if (likely == nullptr) {
    return Fail({},
                "the legs are {:.3g} units long from hip to ankle, which is impossible for a person in each of the "
                "units {}; {}",
                file_units / kStatureOfLeg, RigUnits(), advice);
  }
  told = fmt::format("lengths in {} (this unit gives {}; in {} the legs would be {:.3g} m long)", likely->name,
                     LegsText(likely->metres * file_units), UnitText(rig.unit_m), usual / kStatureOfLeg);
  return likely->metres;
}

/// The up axis in the cameras' world.
struct ChosenUp {
  glm::dvec3 up;
  bool from_the_take = false;  ///< true if the person and the cameras determined `up`; false if the file did
  std::string told;
};

/// Returns true if most cameras take level pictures and do not look up steeply, with this direction up.
bool AreMostLevel(const RigFile& rig, const glm::dvec3& up) {
  constexpr double kMaxTilt = Radians(15), kMaxLookUp = Radians(45);
  const auto level = std::ranges::count_if(rig.cameras, [&](const NamedCamera& named) {
    const glm::dvec3 up_C = named.camera.R_CW * up;  // the camera's x is right, y down, z ahead
    return std::abs(up_C.x) < std::sin(kMaxTilt) && up_C.y < std::sin(kMaxTilt) && up_C.z < std::sin(kMaxLookUp);
  });
  return 2 * level > std::ssize(rig.cameras);
}

/// @param person the direction from the person's ankles to the shoulders; nullopt if there is no person
Result<ChosenUp> UpOf(const RigFile& rig, const std::optional<glm::dvec3>& person, const FoundUp& found,
                      const PlacementOptions& options) {
  const glm::dvec3 usual(0, 1, 0);
  constexpr double kUpsideDown = 100, kFar = 35, kAxisItself = 4, kStillAxis = 10;
  const auto usual_name = [&] {
    for (const FileAxis& axis : kAxes) {
      if (glm::dot(rig.R_WF * axis.direction, usual) > 0.999) return std::string(axis.name);
    }
    return std::string("y");
  };
  const auto reason = [&](const glm::dvec3& up, const std::string& given) {
    if (!person) return given.empty() ? std::string(", as in the format") : fmt::format(" ({})", given);
    return fmt::format(" ({}{}the person leans {:.0f}° from this axis)", given, given.empty() ? "" : "; ",
                       Degrees(AngleBetween(up, *person)));
  };
  // A requested axis must not put the pictures upside down.
  if (options.up != "auto" && options.up != "floor") {
    const glm::dvec3 up = rig.R_WF * AxisOf(options.up)->direction;
    const double off = Degrees(AngleBetween(up, found.up));
    if (person && off > kUpsideDown) {
      return Fail(
          {},
          "with {} up, everything would be upside down: this axis is {:.0f}° away from the up direction found from {}",
          options.up, off, found.by);
    }
    return ChosenUp{up, false, fmt::format("up is {}{}", options.up, reason(up, "as given"))};
  }
  const std::string camera = CameraOfTheWorld(rig);
  const double tilt = Degrees(AngleBetween(usual, found.up)), accuracy = Degrees(found.deviation);
  const double within = Degrees(found.within);
  constexpr double kTold = 3, kTilted = 8, kSure = 3;
  // If the format defines an up axis, feet that are not level (on a beam) are no reason to tilt the world. Caliscope's
  // axes are those of a calibration board, so they do not define an up axis.
  const bool is_level = rig.format != "Caliscope" || tilt < std::max(kSure * accuracy, kTilted);
  const bool is_usual = tilt < std::max(kFar, within) || (!person && AreMostLevel(rig, usual));
  if (options.up == "auto" && camera.empty() && rig.has_unit && is_usual && is_level) {
    std::string told = fmt::format("up is {}{}", usual_name(), reason(usual, ""));
    if (person && tilt > std::max(kSure * accuracy, kTold)) {
      told += fmt::format(
          "; according to {}, the up direction is {:.0f}° away from this axis; if the up direction is right, use "
          "--rig-up floor",
          found.by, tilt);
    }
    return ChosenUp{usual, false, told};
  }
  // If the file has an axis that is close to the direction found, take this axis.
  if (camera.empty() && options.up == "auto") {
    for (const FileAxis& axis : kAxes) {
      const glm::dvec3 up = rig.R_WF * axis.direction;
      if (Degrees(AngleBetween(up, found.up)) < std::max(kAxisItself, std::min(kStillAxis, within))) {
        return ChosenUp{up, true, fmt::format("up is {} (found: {})", axis.name, found.by)};
      }
    }
  }
  constexpr double kMaxDoubt = 35;
  const std::string world = camera.empty() ? "" : fmt::format(" (the world frame was that of camera {})", camera);
  if (within > kMaxDoubt) {
    return Fail({},
                "from {}, the up direction is known only to within {:.0f}°{}; use --rig-up to set the file's up axis "
                "(for level cameras: -y)",
                found.by, within, world);
  }
  return ChosenUp{found.up, true,
                  fmt::format("the up direction is found from {}, to within {:.1f}°{}", found.by, within, world)};
}

/// Returns a text that names the file's axis for each of our axes: "; x is the file's y, z its x, up its z". Returns
/// "" if our axes have the same names in the file, or if one of our axes lies along no axis of the file.
std::string AxesTold(const glm::dmat3& R_OF) {
  std::array<std::string, 3> names;
  bool is_same = true;
  for (int i = 0; i < 3; ++i) {
    constexpr double kAlong = 0.999;
    const auto axis = std::ranges::find_if(
        kAxes, [&](const FileAxis& one) { return glm::dot(glm::transpose(R_OF)[i], one.direction) > kAlong; });
    if (axis == kAxes.end()) return "";
    names[i] = axis->name;
    is_same = is_same && axis == kAxes.begin() + i;
  }
  return is_same ? ""
                 : fmt::format("; Etude's x is the file's {}, Etude's z is the file's {}, and up is the file's {}",
                               names[0], names[2], names[1]);
}

/// Fails if the largest distance between two cameras is impossible for a rig in the unit of its format *(ours)*.
Result<void> CheckDistances(const RigFile& rig) {
  constexpr double kMinApart = 0.03, kMaxApart = 100, kMinUsual = 1, kMaxUsual = 30;
  double apart = 0;
  for (const NamedCamera& a : rig.cameras) {
    for (const NamedCamera& b : rig.cameras) apart = std::max(apart, glm::distance(a.camera.p_WC, b.camera.p_WC));
  }
  if (apart == 0 || (apart >= kMinApart && apart <= kMaxApart)) return {};
  std::string usual;
  for (const LengthUnit& unit : kUnits) {
    const double metres = unit.metres * apart / rig.unit_m;
    if (metres < kMinUsual || metres > kMaxUsual) continue;
    usual += fmt::format("{} {:.3g} m apart with {}", usual.empty() ? ":" : ",", metres, unit.name);
  }
  return Fail({},
              "with lengths in {}, the rig's cameras are {:.4g} m apart; allowed: {:g} to {:g} m; use --rig-unit to "
              "set the unit{}",
              UnitText(rig.unit_m), apart, kMinApart, kMaxApart, usual);
}

/// Returns a sentence that names the cameras below the floor; "" if there are none.
std::string DoubtOnFloor(const RigFile& rig, const RigPlacement& place) {
  constexpr double kBelow_m = 0.1;  // more than the error of a calibration, or of a floor under the feet
  std::string names;
  for (const NamedCamera& named : rig.cameras) {
    const double height = place(named.camera.p_WC).y;
    if (height >= -kBelow_m) continue;
    names += fmt::format("{}{} by {:.2f} m", names.empty() ? "" : ", ", named.name, -height);
  }
  if (names.empty()) return "";
  return fmt::format(
      "cameras are below the floor: {}; use --rig-up to set the rig's up axis, and --floor to set the height of the "
      "floor",
      names);
}

}  // namespace

std::string RigUnits() {
  std::string names;
  for (const LengthUnit& unit : kUnits) names += (names.empty() ? "" : ", ") + std::string(unit.name);
  return names;
}

Result<void> CheckPlace(const PlacementOptions& options) {
  if (options.unit != "auto" && !MetresOf(options.unit)) {
    return Fail({}, "--rig-unit is {}; allowed: auto, {}, or the metres in one unit", options.unit, RigUnits());
  }
  if (options.up != "auto" && options.up != "floor" && AxisOf(options.up) == nullptr) {
    return Fail({}, "--rig-up is {}; allowed: auto, floor, x, y, z, -x, -y, -z", options.up);
  }
  if (options.floor != "auto" && options.floor != "keep" && options.floor != "feet" && !ParseFinite(options.floor)) {
    return Fail({}, "--floor is {}; allowed: auto, keep, feet, or the height of the floor in metres", options.floor);
  }
  return {};
}

Result<RigPlacement> PlaceRig(const RigFile& rig, std::span<const LandmarkPositions> points, double rate_hz,
                              const PlacementOptions& options) {
  RETURN_IF_ERROR(CheckPlace(options));
  const auto stature = StatureOf(points);
  const auto person = PersonsUp(points);
  if (!stature || !person)
    return Fail(
        {"keypoints"},
        "Etude cannot find the rig's unit and up axis, because no frame shows hips, knees, ankles and shoulders");
  RigPlacement place;
  // Choose the unit, then the up axis.
  std::string unit_told;
  ASSIGN_OR_RETURN(const double unit, UnitOf(rig, *stature / rig.unit_m, options, unit_told));
  place.scale = unit == rig.unit_m ? 1 : unit / rig.unit_m;
  const FoundUp found = FindUp(rig.cameras, points, rate_hz, *stature, 1 / place.scale);
  ASSIGN_OR_RETURN(const ChosenUp chosen, UpOf(rig, *person, found, options));
  place.R = Upright(chosen.up);
  place.stature_m = place.scale * *stature;
  // Choose the floor.
  std::string floor_told = "; the floor is as in the file";
  const bool at_feet = options.floor == "feet" || (options.floor == "auto" && chosen.from_the_take);
  if (const auto height = ParseFinite(options.floor)) {
    place.shift.y = -*height;
    floor_told = fmt::format("; the floor is at height {:g} m", *height);
  } else if (at_feet) {
    place.shift.y = -place.scale * FloorUnder(FeetAtRest(points, rate_hz, *stature), chosen.up, *stature);
    floor_told = "; the floor is under the feet";
  }
  place.told = unit_told + "; " + chosen.told + floor_told + AxesTold(place.R * rig.R_WF);
  place.doubt = DoubtOnFloor(rig, place);
  return place;
}

Result<RigPlacement> PlaceRig(const RigFile& rig, const PlacementOptions& options) {
  RETURN_IF_ERROR(CheckPlace(options));
  RigPlacement place;
  if (options.unit != "auto") {
    place.scale = *MetresOf(options.unit) / rig.unit_m;
  } else if (!rig.has_unit) {
    return Fail({},
                "a calibration of the format {} has no unit of length; use --rig-unit to set the metres in one unit",
                rig.format);
  } else {
    RETURN_IF_ERROR(CheckDistances(rig));
  }
  // Choose the up axis. Without feet, the floor of a camera's own frame is not known either.
  const std::string camera = CameraOfTheWorld(rig);
  if (AxisOf(options.up) == nullptr && (!camera.empty() || options.up == "floor")) {
    return Fail({}, "the rig does not show which direction is up{}; use --rig-up to set the file's up axis",
                camera.empty() ? "" : fmt::format(", because the world frame is that of camera {}", camera));
  }
  constexpr double kNoRate = 1, kNoStature = 1, kNoMetre = 1;  // these matter only for a person's points
  const FoundUp found = FindUp(rig.cameras, {}, kNoRate, kNoStature, kNoMetre);
  ASSIGN_OR_RETURN(const ChosenUp chosen, UpOf(rig, std::nullopt, found, options));
  place.R = Upright(chosen.up);
  place.told = fmt::format("lengths in {}; {}", UnitText(place.scale * rig.unit_m), chosen.told);
  if (const auto height = ParseFinite(options.floor)) {
    place.shift.y = -*height;
    place.told += fmt::format("; the floor is at height {:g} m", *height);
  }
  place.told += AxesTold(place.R * rig.R_WF);
  place.doubt = DoubtOnFloor(rig, place);
  return place;
}

Camera Placed(const RigPlacement& place, Camera camera) {
  if (place.IsNone()) return camera;
  camera.R_CW = camera.R_CW * glm::transpose(place.R);
  camera.p_WC = place(camera.p_WC);
  return camera;
}

}  // namespace etude
