#include "engine/cameras/rig_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/cameras/calibration_text.h"
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/qualisys_file.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr std::size_t kLargestText = std::size_t{1} << 20;
constexpr std::size_t kMostCamerasRead = 64;
constexpr std::string_view kYamlDirective = "%YAML:1.0\n---\n";

/// Every line of a camera's own file, moved in; without its first two.
std::string Indented(std::string text) {
  text.erase(0, kYamlDirective.size());
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    out += "   " + text.substr(at, end - at) + "\n";
    at = end + 1;
  }
  return out;
}

/// FileStorage's names are words that begin with a letter.
std::string FileStorageName(std::string name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  for (char& c : name) {
    if (!is_letter(c) && !(c >= '0' && c <= '9')) c = '_';
  }
  if (name.empty() || !is_letter(name.front()) || name == "cameras") name.insert(0, "camera_");
  return name;
}

Result<std::vector<double>> MatrixAt(const Node& camera, std::string_view key, std::size_t rows, std::size_t columns) {
  const Node* matrix = camera.Find(key);
  if (matrix == nullptr) return Fail(camera.place, "no {}", key);
  const Node* data = matrix->Find("data");
  if (data == nullptr || data->kind != Node::Kind::kSequence) {
    return Fail(matrix->place, "{} is {}; allowed: a matrix of OpenCV with rows, cols, dt, data", key,
                Describe(*matrix));
  }
  std::vector<double> values;
  for (const Node& item : data->items) {
    ASSIGN_OR_RETURN(const double value, AsNumber(item));
    values.push_back(value);
  }
  if (rows != 0 && values.size() != rows * columns) {
    return Fail(data->place, "{} has {} numbers; allowed: {}", key, values.size(), rows * columns);
  }
  return values;
}

Result<double> NumberAt(const Node& camera, std::string_view key) {
  const Node* number = camera.Find(key);
  if (number == nullptr) return Fail(camera.place, "no {}", key);
  return AsNumber(*number);
}

Result<Camera> ReadCamera(const Node& node) {
  OpenCvParameters p;
  ASSIGN_OR_RETURN(p.width, NumberAt(node, "image_width"));
  ASSIGN_OR_RETURN(p.height, NumberAt(node, "image_height"));
  ASSIGN_OR_RETURN(p.camera_matrix, MatrixAt(node, "camera_matrix", 3, 3));
  ASSIGN_OR_RETURN(p.distortion, MatrixAt(node, "distortion_coefficients", 0, 0));
  ASSIGN_OR_RETURN(const auto R, MatrixAt(node, "R", 3, 3));
  ASSIGN_OR_RETURN(const auto T, MatrixAt(node, "T", 3, 1));
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) p.R[column][row] = R[static_cast<std::size_t>(3 * row + column)];
    p.T[row] = T[static_cast<std::size_t>(row)];
  }
  auto camera = CameraOf(p);
  if (!camera) return Fail(node.place, "{}", camera.error().message);
  return camera;
}

Result<std::vector<NamedCamera>> ReadOwnRig(const Node& root) {
  const Node* names = root.Find("cameras");
  ASSIGN_OR_RETURN(const auto cameras, AsTexts(*names));
  if (cameras.empty() || cameras.size() > kMostCamerasRead) {
    return Fail(names->place, "{} cameras; allowed: 1 to {}", cameras.size(), kMostCamerasRead);
  }
  std::vector<NamedCamera> rig;
  for (const std::string& name : cameras) {
    const Node* node = root.Find(name);
    if (node == nullptr) return Fail(names->place, "camera {} is listed, and not told of below", name);
    const auto camera = ReadCamera(*node);
    if (!camera) return Fail(camera.error().place, "camera {}: {}", name, camera.error().message);
    rig.push_back({name, *camera});
  }
  return rig;
}

/// OpenCV's first line is no YAML directive to YAML's own readers.
std::string WithoutDirective(std::string_view text) {
  std::string plain(text);
  if (plain.starts_with("%YAML:")) plain.replace(0, std::min(plain.find('\n'), plain.size()), "#");
  return plain;
}

Result<std::vector<NamedCamera>> Read(std::string_view text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Fail({}, "nothing in it");
  if (text[first] == '<') return ReadQualisysCalibration(text);
  if (text.starts_with("%YAML") || text.find("opencv-matrix") != std::string_view::npos) {
    ASSIGN_OR_RETURN(const Node root, ParseYaml(WithoutDirective(text), file));
    if (root.Find("cameras") != nullptr) return ReadOwnRig(root);
    ASSIGN_OR_RETURN(const Camera camera, ReadOpenCvCamera(text));
    return std::vector<NamedCamera>{{"camera", camera}};
  }
  if (text[first] == '[' || text.find("\n[") != std::string_view::npos) return ReadPose2SimCalibration(text);
  return Fail({},
              "no calibration; allowed: a rig of etude calibrate, YAML of OpenCV, TOML of Pose2Sim or Anipose, XML "
              "of Qualisys");
}

}  // namespace

std::string WriteRig(std::span<const NamedCamera> cameras) {
  std::string names, bodies;
  for (const NamedCamera& named : cameras) {
    const std::string name = FileStorageName(named.name);
    names += (names.empty() ? "" : ", ") + fmt::format("\"{}\"", name);
    bodies += fmt::format("{}:\n{}", name, Indented(WriteOpenCvCamera(named.camera)));
  }
  return fmt::format("{}cameras: [ {} ]\n{}", kYamlDirective, names, bodies);
}

Result<std::vector<NamedCamera>> ReadRig(std::string_view text, const std::string& file) {
  if (text.size() > kLargestText) return Fail({file}, "{} bytes; allowed: {}", text.size(), kLargestText);
  auto rig = Read(text, file);
  if (!rig) {
    Error error = rig.error();
    error.place.file = file;
    return tl::unexpected(std::move(error));
  }
  if (rig->size() > kMostCamerasRead) return Fail({file}, "{} cameras; allowed: {}", rig->size(), kMostCamerasRead);
  for (std::size_t i = 0; i < rig->size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((*rig)[i].name == (*rig)[j].name) return Fail({file}, "two cameras of the name {}", (*rig)[i].name);
    }
  }
  return rig;
}

}  // namespace etude
