#include "engine/cameras/pose2sim_file.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>

#include "engine/cameras/opencv_file.h"

namespace etude {
namespace {

/// From our world (Y up) to Pose2Sim's (Z up): (z, x, y).
const glm::dmat3 kZUpOfYUp = glm::transpose(glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0));

std::string Vector(std::span<const double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "[ " : ", ") + RealText(value);
  return text + "]";
}

/// The axis of a rotation, as long as its angle.
glm::dvec3 RodriguesOf(const glm::dmat3& R) {
  glm::dquat q = glm::normalize(glm::quat_cast(R));
  if (q.w < 0) q = -q;
  const glm::dvec3 axis(q.x, q.y, q.z);
  const double sine = glm::length(axis);
  return sine > 0 ? 2 * std::atan2(sine, q.w) / sine * axis : glm::dvec3(0);
}

glm::dmat3 MatrixOfRodrigues(const glm::dvec3& vector) {
  const double angle = glm::length(vector);
  return angle > 0 ? glm::mat3_cast(glm::angleAxis(angle, vector / angle)) : glm::dmat3(1);
}

std::string Table(const NamedCamera& named) {
  const OpenCvParameters p = ParametersOf(named.camera);
  const std::vector<double>& K = p.camera_matrix;
  const std::size_t coefficients = p.distortion[4] == 0 ? 4 : 5;
  const glm::dvec3 rotation = RodriguesOf(p.R * glm::transpose(kZUpOfYUp));
  const auto row = [&](std::size_t i) { return Vector(std::span(K).subspan(3 * i, 3)); };
  return fmt::format("[{0}]\nname = \"{0}\"\nsize = {1}\nmatrix = [ {2}, {3}, {4}]\n", named.name,
                     Vector(std::array{p.width, p.height}), row(0), row(1), row(2)) +
         fmt::format("distortions = {}\nrotation = {}\ntranslation = {}\nfisheye = false\n\n",
                     Vector(std::span(p.distortion).first(coefficients)),
                     Vector(std::array{rotation.x, rotation.y, rotation.z}), Vector(std::array{p.T.x, p.T.y, p.T.z}));
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t\r"), to = text.find_last_not_of(" \t\r");
  return from == std::string_view::npos ? std::string_view{} : text.substr(from, to - from + 1);
}

using Keys = std::map<std::string, std::string, std::less<>>;

Result<NamedCamera> ReadTable(const std::string& name, const Keys& keys, int line) {
  const Place place{.file = {}, .line = line, .column = 1};
  std::map<std::string, std::vector<double>> values;
  for (const auto& [key, count] : std::map<std::string, std::size_t>{
           {"size", 2}, {"matrix", 9}, {"distortions", 0}, {"rotation", 3}, {"translation", 3}}) {
    const auto found = keys.find(key);
    if (found == keys.end()) return Fail(place, "camera {} has no {}", name, key);
    const auto numbers = NumbersOf(found->second);
    if (!numbers) return Fail(place, "camera {}: {} is no list of numbers: {}", name, key, found->second);
    if (count != 0 && numbers->size() != count) {
      return Fail(place, "camera {}: {} has {} numbers; allowed: {}", name, key, numbers->size(), count);
    }
    values[key] = *numbers;
  }
  if (const auto fisheye = keys.find("fisheye"); fisheye != keys.end() && fisheye->second != "false") {
    return Fail(place, "camera {} is a fisheye; allowed: fisheye = false", name);
  }
  const auto& r = values["rotation"];
  const auto& t = values["translation"];
  const OpenCvParameters p{.width = values["size"][0],
                           .height = values["size"][1],
                           .camera_matrix = values["matrix"],
                           .distortion = values["distortions"],
                           .R = MatrixOfRodrigues({r[0], r[1], r[2]}) * kZUpOfYUp,
                           .T = {t[0], t[1], t[2]}};
  const auto camera = CameraOf(p);
  if (!camera) return Fail(place, "camera {}: {}", name, camera.error().message);
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
  const auto finish = [&]() -> Result<void> {
    if (keys.contains("matrix") || keys.contains("rotation")) {
      ASSIGN_OR_RETURN(auto camera, ReadTable(name, keys, table_line));
      cameras.push_back(std::move(camera));
    }
    keys.clear();
    return {};
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view here = Trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (here.empty() || here.front() == '#') continue;
    if (here.front() == '[' && here.back() == ']') {
      RETURN_IF_ERROR(finish());
      name = here.substr(1, here.size() - 2);
      table_line = line;
      continue;
    }
    const std::size_t equals = here.find('=');
    if (equals == std::string_view::npos) return Fail({{}, line, 1}, "neither a table nor a key: {}", here);
    keys[std::string(Trimmed(here.substr(0, equals)))] = Trimmed(here.substr(equals + 1));
  }
  RETURN_IF_ERROR(finish());
  if (cameras.empty()) return Fail({}, "no camera");
  return cameras;
}

}  // namespace etude
