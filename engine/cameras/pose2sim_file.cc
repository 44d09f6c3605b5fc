#include "engine/cameras/pose2sim_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "engine/base/angles.h"
#include "engine/base/text.h"
#include "engine/cameras/opencv_file.h"

namespace etude {
namespace {

std::string Vector(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[ " : ", ") + RealText(value, ".0");
  return text + "]";
}

/// Returns Rodrigues' vector of a rotation.
glm::dvec3 RodriguesOf(const glm::dmat3& R) {
  glm::dquat q = glm::normalize(glm::quat_cast(R));
  if (q.w < 0) q = -q;
  const glm::dvec3 axis(q.x, q.y, q.z);
  const double sine = glm::length(axis);
  return sine > 0 ? 2 * std::atan2(sine, q.w) / sine * axis : glm::dvec3(0);
}

std::string Table(const NamedCamera& named) {
  const OpenCvParameters p = ParametersOf(named.camera);
  const std::vector<double>& K = p.camera_matrix;
  const std::size_t all = p.distortion.size(), coefficients = all == 5 && p.distortion[4] == 0 ? 4 : all;
  const glm::dvec3 rotation = RodriguesOf(p.R * kYUpOfZUp);
  const auto row = [&](std::size_t i) { return Vector(std::span(K).subspan(3 * i, 3)); };
  return fmt::format("[{0}]\nname = \"{0}\"\nsize = {1}\nmatrix = [ {2}, {3}, {4}]\n", named.name,
                     Vector(std::array{p.width, p.height}), row(0), row(1), row(2)) +
         fmt::format("distortions = {}\nrotation = {}\ntranslation = {}\nfisheye = {}\n\n",
                     Vector(std::span(p.distortion).first(coefficients)),
                     Vector(std::array{rotation.x, rotation.y, rotation.z}), Vector(std::array{p.T.x, p.T.y, p.T.z}),
                     p.is_fisheye);
}

/// Returns the rotation nearest to `R`, by Newton's iteration, if `R` is a rotation but for rounding of its numbers.
/// Otherwise returns `R` unchanged.
glm::dmat3 Orthonormal(const glm::dmat3& R) {
  const glm::dmat3 off = R * glm::transpose(R) - glm::dmat3(1);
  constexpr double kRounded = 1e-3;
  for (int i = 0; i < 3; ++i) {
    if (!(glm::length(off[i]) < kRounded)) return R;
  }
  glm::dmat3 near = R;
  for (int step = 0; step < 3; ++step) near = 0.5 * (near + glm::transpose(glm::inverse(near)));
  return near;
}

/// Returns a line without its comment.
std::string_view WithoutComment(std::string_view line) {
  bool in_string = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') in_string = !in_string;
    if (line[i] == '#' && !in_string) return line.substr(0, i);
  }
  return line;
}

/// Reads all numbers of a text such as "[ [1., 0], [2e-3]]"; returns nullopt if it contains anything else.
std::optional<std::vector<double>> NumbersOf(std::string_view text) {
  constexpr std::string_view kBetween = " \t\r\n,[]";
  std::vector<double> numbers;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kBetween), text.size()));
    if (text.empty()) return numbers;
    const auto value = TakeNumber(text);
    if (!value || !(text.empty() || kBetween.find(text.front()) != std::string_view::npos)) return std::nullopt;
    numbers.push_back(*value);
  }
}

using Keys = std::map<std::string, std::string, std::less<>>;

using Values = std::map<std::string, std::vector<double>>;

/// Parses the lists of numbers that a camera's table must have. A count of 0 allows lists of any length.
Result<Values> ValuesOf(const std::string& name, const Keys& keys, const std::map<std::string, std::size_t>& counts,
                        const Place& place) {
  Values values;
  for (const auto& [key, count] : counts) {
    const auto found = keys.find(key);
    if (found == keys.end()) return Fail(place, "camera {} has no {}", name, key);
    const auto numbers = NumbersOf(found->second);
    if (!numbers) return Fail(place, "camera {}: '{}' must be a list of numbers, found {}", name, key, found->second);
    if (count != 0 && numbers->size() != count) {
      return Fail(place, "camera {}: {} has {} numbers; allowed: {}", name, key, numbers->size(), count);
    }
    values[key] = *numbers;
  }
  return values;
}

/// Reads the table of a planned camera: its lens has no distortion, and its picture is upright.
Result<OpenCvParameters> ReadPlanned(const std::string& name, const Keys& keys, const Place& place) {
  ASSIGN_OR_RETURN(Values values,
                   ValuesOf(name, keys, {{"size", 2}, {"fov_deg", 1}, {"position", 3}, {"look_at", 3}}, place));
  const auto point = [&](const char* key) {
    const auto& v = values[key];
    return kYUpOfZUp * glm::dvec3(v[0], v[1], v[2]);
  };
  const glm::dvec3 p_WC = point("position"), p_WT = point("look_at");
  const double fov = values["fov_deg"][0], width = values["size"][0], height = values["size"][1];
  constexpr double kMinFov = 1, kMaxFov = 170, kVertical = 1e-6;
  if (!(fov >= kMinFov && fov <= kMaxFov)) {
    return Fail(place, "camera {}: 'fov_deg' is {:g}; allowed: {:g} to {:g}", name, fov, kMinFov, kMaxFov);
  }
  if (!(glm::length(glm::cross(p_WT - p_WC, glm::dvec3(0, 1, 0))) > kVertical)) {
    return Fail(place,
                "camera {}: 'look_at' is at, above or below the camera's position; allowed: a point at another "
                "horizontal position",
                name);
  }
  const double focal = width / 2 / std::tan(Radians(fov / 2));
  const glm::dmat3 R_CW = LookAt({}, p_WC, p_WT).R_CW;
  // The picture's centre, in OpenCV's pixels.
  return OpenCvParameters{.width = width,
                          .height = height,
                          .camera_matrix = {focal, 0, (width - 1) / 2, 0, focal, (height - 1) / 2, 0, 0, 1},
                          .R = R_CW,
                          .T = -(R_CW * p_WC)};
}

/// Reads the table of a calibrated camera.
Result<OpenCvParameters> ReadCalibrated(const std::string& name, const Keys& keys, const Place& place) {
  ASSIGN_OR_RETURN(
      Values values,
      ValuesOf(name, keys, {{"size", 2}, {"matrix", 9}, {"distortions", 0}, {"rotation", 0}, {"translation", 3}},
               place));
  const auto& t = values["translation"];
  const auto fisheye = keys.find("fisheye");
  if (fisheye != keys.end() && fisheye->second != "true" && fisheye->second != "false") {
    return Fail(place, "camera {}: 'fisheye' is {}; allowed: true, false", name, fisheye->second);
  }
  const auto R = RotationOf(values["rotation"], "rotation");
  if (!R) return Fail(place, "camera {}: {}", name, R.error().message);
  return OpenCvParameters{.width = values["size"][0],
                          .height = values["size"][1],
                          .camera_matrix = values["matrix"],
                          .distortion = values["distortions"],
                          .R = Orthonormal(*R) * glm::transpose(kYUpOfZUp),
                          .T = {t[0], t[1], t[2]},
                          .is_fisheye = fisheye != keys.end() && fisheye->second == "true"};
}

// Reads one camera's table, which began at `line`.
Result<NamedCamera> ReadTable(const std::string& name, const Keys& keys, int line) {
  const Place place{.file = {}, .line = line, .column = 1};
  const bool is_planned = keys.contains("look_at");
  ASSIGN_OR_RETURN(const OpenCvParameters p,
                   is_planned ? ReadPlanned(name, keys, place) : ReadCalibrated(name, keys, place));
  const auto camera = CameraOf(p);
  if (!camera) return Fail(place, "camera {}: {}", name, camera.error().message);
  // Prefer the name under the table's own key `name`.
  std::string shown = name;
  if (const auto own = keys.find("name"); own != keys.end() && own->second.size() >= 2 && own->second.front() == '"') {
    shown = own->second.substr(1, own->second.size() - 2);
  }
  return NamedCamera{shown, *camera};
}

}  // namespace

std::string WritePose2SimCalibration(std::span<const NamedCamera> cameras) {
  std::string text;
  for (const NamedCamera& camera : cameras) text += Table(camera);
  return text + "[metadata]\nadjusted = false\nerror = 0.0\n";
}

Result<std::vector<NamedCamera>> ReadPose2SimCalibration(std::string_view text) {
  std::vector<NamedCamera> cameras;
  std::string name;
  Keys keys;
  int line = 0, table_line = 0;
  // Ends a table; if the table describes a camera, adds the camera.
  const auto finish = [&]() -> Result<void> {
    const auto ignored = keys.find("ignore");  // a key that Caliscope writes
    const bool is_ignored = ignored != keys.end() && ignored->second == "true";
    if (!is_ignored && (keys.contains("matrix") || keys.contains("rotation") || keys.contains("look_at"))) {
      ASSIGN_OR_RETURN(auto camera, ReadTable(name, keys, table_line));
      cameras.push_back(std::move(camera));
    }
    keys.clear();
    return {};
  };
  const auto next_line = [&] { return Trimmed(WithoutComment(TakeLine(text, line))); };
  while (!text.empty()) {
    const std::string_view here = next_line();
    if (here.empty()) continue;
    const std::size_t equals = here.find('=');
    if (here.front() == '[' && here.back() == ']' && equals == std::string_view::npos) {
      RETURN_IF_ERROR(finish());
      name = here.substr(1, here.size() - 2);
      // Caliscope's tables are named cameras.0, cameras.1, …
      if (constexpr std::string_view kOf = "cameras."; name.starts_with(kOf)) name = "cam_" + name.substr(kOf.size());
      table_line = line;
      continue;
    }
    if (equals == std::string_view::npos)
      return Fail({{}, line, 1}, "found {}; allowed: a table ([name]) or a key (name = value)", here);
    std::string& value = keys[std::string(Trimmed(here.substr(0, equals)))];
    value = Trimmed(here.substr(equals + 1));
    // A list may continue over several lines.
    while (value.starts_with('[') && std::ranges::count(value, '[') > std::ranges::count(value, ']') && !text.empty()) {
      value += std::string(" ").append(next_line());
    }
  }
  RETURN_IF_ERROR(finish());
  if (cameras.empty()) return Fail({}, "no camera");
  return cameras;
}

}  // namespace etude
