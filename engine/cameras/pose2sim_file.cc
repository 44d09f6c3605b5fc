#include "engine/cameras/pose2sim_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <sstream>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/names.h"
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

/// Returns a value as TOML writes it.
std::string TextOf(const toml::node& value) {
  std::ostringstream text;
  text << toml::toml_formatter(value, toml::format_flags::none);
  return text.str();
}

/// Returns a text in TOML's quotes.
std::string Quoted(const std::string& text) { return TextOf(toml::value<std::string>(text)); }

/// Returns the name of a table: without quotes if TOML allows that.
std::string KeyOf(const std::string& name) {
  constexpr const char* kBare = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  return !name.empty() && name.find_first_not_of(kBare) == std::string::npos ? name : Quoted(name);
}

std::string Table(const NamedCamera& named) {
  const OpenCvParameters p = ParametersOf(named.camera);
  const std::vector<double>& K = p.camera_matrix;
  const std::size_t all = p.distortion.size(), coefficients = all == 5 && p.distortion[4] == 0 ? 4 : all;
  const glm::dvec3 rotation = RodriguesOf(p.R * kYUpOfZUp);
  const auto row = [&](std::size_t i) { return Vector(std::span(K).subspan(3 * i, 3)); };
  return fmt::format("[{}]\nname = {}\nsize = {}\nmatrix = [ {}, {}, {}]\n", KeyOf(named.name), Quoted(named.name),
                     Vector(std::array{p.width, p.height}), row(0), row(1), row(2)) +
         fmt::format("distortions = {}\nrotation = {}\ntranslation = {}\nfisheye = {}\n\n",
                     Vector(std::span(p.distortion).first(coefficients)),
                     Vector(std::array{rotation.x, rotation.y, rotation.z}), Vector(std::array{p.T.x, p.T.y, p.T.z}),
                     p.is_fisheye);
}

Place PlaceOf(const toml::source_region& region) {
  return {.file = {}, .line = static_cast<int>(region.begin.line), .column = static_cast<int>(region.begin.column)};
}
Place PlaceOf(const toml::node& node) { return PlaceOf(node.source()); }

/// Returns the beginning of a value, for messages.
std::string Shown(const toml::node& value) {
  constexpr std::size_t kMaxShown = 40;
  const std::string text = TextOf(value);
  return fmt::format("{:.{}}{}", text, kMaxShown, text.size() > kMaxShown ? "…" : "");
}

/// Adds the numbers of a value, which is a number or a list of lists of numbers. Returns false if it has anything else.
bool AddNumbers(const toml::node& value, std::vector<double>& numbers) {
  if (const auto number = value.value<double>()) {
    numbers.push_back(*number);
    return true;
  }
  const toml::array* list = value.as_array();
  return list != nullptr && std::ranges::all_of(*list, [&](const auto& one) { return AddNumbers(one, numbers); });
}

using Values = std::map<std::string, std::vector<double>>;

/// Returns a key of the table that may be a misspelling of `wanted`: a key near it or its beginning; "" if there is
/// none.
std::string MisspeltKey(const toml::table& keys, const std::string& wanted) {
  std::vector<std::string> others;
  for (const auto& [key, value] : keys) others.emplace_back(key.str());
  const auto beginning =
      std::ranges::find_if(others, [&](const std::string& key) { return key.size() >= 3 && wanted.starts_with(key); });
  return beginning != others.end() ? *beginning : NearestName(wanted, others);
}

/// Returns the lists of numbers that a camera's table must have. A count of 0 allows lists of any length.
Result<Values> ValuesOf(const std::string& name, const toml::table& keys,
                        const std::map<std::string, std::size_t>& counts) {
  Values values;
  for (const auto& [key, count] : counts) {
    const toml::node* value = keys.get(key);
    if (value == nullptr) {
      const std::string near = MisspeltKey(keys, key);
      return Fail(PlaceOf(keys), "camera {} has no {}{}", name, key,
                  near.empty() ? "" : fmt::format("; is '{}' a misspelling of it?", near));
    }
    std::vector<double>& numbers = values[key];
    if (!AddNumbers(*value, numbers)) {
      return Fail(PlaceOf(*value), "camera {}: '{}' must be a list of numbers, found {}", name, key, Shown(*value));
    }
    if (count != 0 && numbers.size() != count) {
      return Fail(PlaceOf(*value), "camera {}: {} has {} numbers; allowed: {}", name, key, numbers.size(), count);
    }
  }
  return values;
}

/// Returns true if a table describes a camera that is only planned.
bool IsPlanned(const toml::table& keys) {
  const bool is_calibrated = keys.contains("matrix") || keys.contains("rotation");
  return keys.contains("look_at") || (keys.contains("fov_deg") && !is_calibrated);
}

/// Returns the value of a key that is true or false; `otherwise` if the table does not have the key.
Result<bool> TruthOf(const std::string& name, const toml::table& keys, const char* key, bool otherwise) {
  const toml::node* value = keys.get(key);
  if (value == nullptr) return otherwise;
  if (const auto truth = value->value_exact<bool>()) return *truth;
  return Fail(PlaceOf(*value), "camera {}: '{}' must be true or false, found {}", name, key, Shown(*value));
}

/// Reads the table of a planned camera: its lens has no distortion, and its picture is upright.
Result<OpenCvParameters> ReadPlanned(const std::string& name, const toml::table& keys) {
  ASSIGN_OR_RETURN(Values values, ValuesOf(name, keys, {{"size", 2}, {"fov_deg", 1}, {"position", 3}, {"look_at", 3}}));
  // The user wrote this table, so a further key is a mistake. Tables of calibrated cameras come from other programs.
  const std::vector<std::string> known = {"name", "size", "fov_deg", "position", "look_at", "ignore"};
  for (const auto& [key, value] : keys) {
    if (std::ranges::find(known, key.str()) != known.end()) continue;
    return Fail(PlaceOf(key.source()), "camera {}: {}", name, UnknownName("key of a planned camera", key.str(), known));
  }
  const auto point = [&](const char* key) {
    const auto& v = values[key];
    return kYUpOfZUp * glm::dvec3(v[0], v[1], v[2]);
  };
  const glm::dvec3 p_WC = point("position"), p_WT = point("look_at");
  const double fov = values["fov_deg"][0], width = values["size"][0], height = values["size"][1];
  constexpr double kMinFov = 1, kMaxFov = 170, kVertical = 1e-6;
  if (!(fov >= kMinFov && fov <= kMaxFov)) {
    return Fail(PlaceOf(keys), "camera {}: 'fov_deg' is {:g}; allowed: {:g} to {:g}", name, fov, kMinFov, kMaxFov);
  }
  if (!(glm::length(glm::cross(p_WT - p_WC, glm::dvec3(0, 1, 0))) > kVertical)) {
    return Fail(PlaceOf(keys),
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
Result<OpenCvParameters> ReadCalibrated(const std::string& name, const toml::table& keys) {
  ASSIGN_OR_RETURN(
      Values values,
      ValuesOf(name, keys, {{"size", 2}, {"matrix", 9}, {"distortions", 0}, {"rotation", 0}, {"translation", 3}}));
  ASSIGN_OR_RETURN(const bool is_fisheye, TruthOf(name, keys, "fisheye", false));
  const auto R = RotationOf(values["rotation"], "rotation");
  if (!R) return Fail(PlaceOf(*keys.get("rotation")), "camera {}: {}", name, R.error().message);
  const auto& t = values["translation"];
  return OpenCvParameters{.width = values["size"][0],
                          .height = values["size"][1],
                          .camera_matrix = values["matrix"],
                          .distortion = values["distortions"],
                          .R = *R * glm::transpose(kYUpOfZUp),
                          .T = {t[0], t[1], t[2]},
                          .is_fisheye = is_fisheye};
}

struct CameraTable {
  std::string name;
  const toml::table* keys;
};

/// Adds the tables that describe cameras, at any depth. `name` is the path of `node` in the file.
void AddCameraTables(const toml::node& node, const std::string& name, std::vector<CameraTable>& tables) {
  const auto below = [&](const auto& key) {
    return name.empty() ? fmt::format("{}", key) : fmt::format("{}.{}", name, key);
  };
  if (const toml::table* keys = node.as_table()) {
    if (keys->contains("matrix") || keys->contains("rotation") || IsPlanned(*keys)) {
      // Caliscope's tables are named cameras.0, cameras.1, …
      constexpr std::string_view kOf = "cameras.";
      tables.push_back({name.starts_with(kOf) ? "cam_" + name.substr(kOf.size()) : name, keys});
      return;
    }
    for (const auto& [key, value] : *keys) AddCameraTables(value, below(key.str()), tables);
  } else if (const toml::array* list = node.as_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) AddCameraTables((*list)[i], below(i), tables);
  }
}

Result<NamedCamera> ReadTable(const CameraTable& table) {
  const auto& [name, keys] = table;
  ASSIGN_OR_RETURN(const OpenCvParameters p, IsPlanned(*keys) ? ReadPlanned(name, *keys) : ReadCalibrated(name, *keys));
  const auto camera = CameraOf(p);
  if (!camera) return Fail(PlaceOf(*keys), "camera {}: {}", name, camera.error().message);
  // Prefer the name under the table's own key `name`.
  const toml::node* own = keys->get("name");
  if (own == nullptr) return NamedCamera{name, *camera};
  const auto shown = own->value_exact<std::string>();
  if (!shown) return Fail(PlaceOf(*own), "camera {}: 'name' must be a text in quotes, found {}", name, Shown(*own));
  return NamedCamera{*shown, *camera};
}

}  // namespace

std::string WritePose2SimCalibration(std::span<const NamedCamera> cameras) {
  std::string text;
  for (const NamedCamera& camera : cameras) text += Table(camera);
  return text + "[metadata]\nadjusted = false\nerror = 0.0\n";
}

Result<std::vector<NamedCamera>> ReadPose2SimCalibration(std::string_view text) {
  toml::table file;
  try {
    file = toml::parse(text);
  } catch (const toml::parse_error& error) {
    return Fail(PlaceOf(error.source()), "is not valid TOML: {}", error.description());
  }
  std::vector<CameraTable> tables;
  AddCameraTables(file, "", tables);
  // The library sorts tables by their names; restore their order in the file.
  std::ranges::stable_sort(tables, {}, [](const CameraTable& one) {
    const toml::source_position at = one.keys->source().begin;
    return std::pair(at.line, at.column);
  });
  std::vector<NamedCamera> cameras;
  for (const CameraTable& table : tables) {
    ASSIGN_OR_RETURN(const bool is_ignored, TruthOf(table.name, *table.keys, "ignore", false));  // Caliscope's key
    if (is_ignored) continue;
    ASSIGN_OR_RETURN(cameras.emplace_back(), ReadTable(table));
  }
  if (cameras.empty()) return Fail({}, "no camera");
  return cameras;
}

}  // namespace etude
