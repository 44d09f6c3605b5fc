#include "engine/cameras/rig_pairs.h"

#include <glm/gtc/quaternion.hpp>
#include <map>
#include <set>
#include <span>
#include <string>

#include "engine/base/text.h"
#include "engine/cameras/opencv_file.h"
#include "engine/document/fields.h"

namespace etude {

Result<std::vector<double>> MatrixAt(const Node& camera, std::string_view key, std::size_t rows, std::size_t columns) {
  const Node* matrix = camera.Find(key);
  if (matrix == nullptr) return Fail(camera.place, "no {}", key);
  const Node* data = matrix->Find("data");
  if (data == nullptr || data->kind != Node::Kind::kSequence) {
    return Fail(matrix->place, "{} is {}; allowed: a matrix as OpenCV writes it, with the keys rows, cols, dt, data",
                key, Describe(*matrix));
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

namespace {

// All these files are read as if they had Z up (kYUpOfZUp). This is false for OpenCV's stereo pair and COLMAP; their up
// axis must be found separately (PlacementOptions::up).

/// Makes the camera in our world; the picture size is 0 × 0 if the file states none.
Result<NamedCamera> CameraIn(const std::string& name, OpenCvParameters p, const glm::dmat3& R_WF, const Place& place) {
  p.R = p.R * glm::transpose(R_WF);
  const bool is_sizeless = p.width == 0 && p.height == 0;
  if (is_sizeless) p.width = p.height = 1;
  auto camera = CameraOf(p);
  if (!camera) return Fail(place, "camera {}: {}", name, camera.error().message);
  if (is_sizeless) camera->intrinsics.width = camera->intrinsics.height = 0;
  return NamedCamera{name, *camera};
}

}  // namespace

Result<RigFile> ReadEasyMocap(const Node& intrinsics, const Node& extrinsics) {
  const Node* names = intrinsics.Find("names");
  if (names == nullptr) return Fail(intrinsics.place, "no list 'names'");
  ASSIGN_OR_RETURN(const auto listed, AsTexts(*names));
  RigFile rig{.cameras = {}, .format = "EasyMocap", .R_WF = kYUpOfZUp};
  for (const std::string& name : listed) {
    OpenCvParameters p;
    ASSIGN_OR_RETURN(p.camera_matrix, MatrixAt(intrinsics, "K_" + name, 3, 3));
    ASSIGN_OR_RETURN(p.distortion, MatrixAt(intrinsics, "dist_" + name, 0, 0));
    for (const auto& [key, side] : {std::pair("W_", &p.width), {"H_", &p.height}}) {
      const Node* node = intrinsics.Find(key + name);
      if (node == nullptr) continue;
      ASSIGN_OR_RETURN(*side, AsNumber(*node));
    }
    const std::string as_matrix = "Rot_" + name;
    const bool has_matrix = extrinsics.Find(as_matrix) != nullptr;
    ASSIGN_OR_RETURN(const auto rotation, MatrixAt(extrinsics, has_matrix ? as_matrix : "R_" + name, 0, 0));
    ASSIGN_OR_RETURN(p.R, RotationOf(rotation, "R_" + name));
    ASSIGN_OR_RETURN(const auto T, MatrixAt(extrinsics, "T_" + name, 3, 1));
    p.T = {T[0], T[1], T[2]};
    ASSIGN_OR_RETURN(auto camera, CameraIn(name, std::move(p), rig.R_WF, names->place));
    rig.cameras.push_back(std::move(camera));
  }
  if (rig.cameras.empty()) return Fail(names->place, "no camera");
  return rig;
}

Result<RigFile> ReadOpenCvStereo(const Node& intrinsics, const Node& extrinsics) {
  RigFile rig{.cameras = {}, .format = "OpenCV stereo", .R_WF = kYUpOfZUp};
  for (const char* number : {"1", "2"}) {
    OpenCvParameters p;
    ASSIGN_OR_RETURN(p.camera_matrix, MatrixAt(intrinsics, std::string("M") + number, 3, 3));
    ASSIGN_OR_RETURN(p.distortion, MatrixAt(intrinsics, std::string("D") + number, 0, 0));
    if (*number == '2') {
      ASSIGN_OR_RETURN(const auto rotation, MatrixAt(extrinsics, "R", 0, 0));
      ASSIGN_OR_RETURN(p.R, RotationOf(rotation, "R"));
      ASSIGN_OR_RETURN(const auto T, MatrixAt(extrinsics, "T", 3, 1));
      p.T = {T[0], T[1], T[2]};
    }
    ASSIGN_OR_RETURN(auto camera,
                     CameraIn(*number == '1' ? "left" : "right", std::move(p), rig.R_WF, intrinsics.place));
    rig.cameras.push_back(std::move(camera));
  }
  return rig;
}

namespace {

struct ColmapLine {
  int number = 0;
  std::vector<std::string> words;
};

/// Returns the lines that are not comments. Empty lines are kept, because the second line of an image without points is
/// empty.
std::vector<ColmapLine> LinesOf(std::string_view text) {
  std::vector<ColmapLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view here = TakeLine(text);
    if (here.starts_with('#')) continue;
    ColmapLine line{number, {}};
    while (true) {
      const std::size_t from = here.find_first_not_of(" \t\r");
      if (from == std::string_view::npos) break;
      const std::size_t to = std::min(here.find_first_of(" \t\r", from), here.size());
      line.words.emplace_back(here.substr(from, to - from));
      here.remove_prefix(to);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

// Parses the words [first, last) of a line as numbers.
Result<std::vector<double>> NumbersFrom(const ColmapLine& line, std::size_t first, std::size_t last,
                                        const Place& place) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < last; ++i) {
    const auto value = ParseFinite(line.words[i]);
    if (!value) return Fail(place, "'{}' is not a number", line.words[i]);
    numbers.push_back(*value);
  }
  return numbers;
}

/// The order of a model's parameters: `focal` is "f" (one focal length) or "xy" (two); then the principal point u, v;
/// then the distortion.
struct ColmapModel {
  std::string_view focal;
  std::vector<std::size_t> distortion;  ///< for each coefficient: its index in OpenCV's list
  bool is_fisheye = false;
};

const std::map<std::string, ColmapModel, std::less<>>& ColmapModels() {
  static const std::map<std::string, ColmapModel, std::less<>> models = {
      {"SIMPLE_PINHOLE", {"f", {}}},
      {"PINHOLE", {"xy", {}}},
      {"SIMPLE_RADIAL", {"f", {0}}},
      {"RADIAL", {"f", {0, 1}}},
      {"OPENCV", {"xy", {0, 1, 2, 3}}},
      {"FULL_OPENCV", {"xy", {0, 1, 2, 3, 4, 5, 6, 7}}},
      {"OPENCV_FISHEYE", {"xy", {0, 1, 2, 3}, true}},
      {"SIMPLE_RADIAL_FISHEYE", {"f", {0}, true}},
      {"RADIAL_FISHEYE", {"f", {0, 1}, true}}};
  return models;
}

// Reads one camera's line of cameras.txt.
Result<OpenCvParameters> InsideOf(const ColmapLine& line) {
  const Place place{{}, line.number, 0};
  constexpr std::size_t kBefore = 4;
  if (line.words.size() < kBefore)
    return Fail(place, "this line does not describe a camera; allowed: CAMERA_ID MODEL WIDTH HEIGHT PARAMS");
  const auto model = ColmapModels().find(line.words[1]);
  if (model == ColmapModels().end()) {
    std::string names;
    for (const auto& [name, one] : ColmapModels()) names += (names.empty() ? "" : ", ") + name;
    return Fail(place, "camera model {}; allowed: {}", line.words[1], names);
  }
  const ColmapModel& of = model->second;
  const std::size_t wanted = of.focal.size() + 2 + of.distortion.size();
  if (line.words.size() != kBefore + wanted) {
    return Fail(place, "{} parameters of {}; allowed: {}", line.words.size() - kBefore, model->first, wanted);
  }
  ASSIGN_OR_RETURN(const auto n, NumbersFrom(line, 2, line.words.size(), place));
  if (n[0] == 0 || n[1] == 0) {  // unlike EasyMocap, COLMAP always knows the pictures' size
    return Fail(place, "camera {}: the picture has {:g} x {:g} pixels; allowed: whole numbers from 1 to 65536",
                line.words[0], n[0], n[1]);
  }
  const std::size_t at = 2 + of.focal.size();
  constexpr double kPixelCentre = 0.5;
  OpenCvParameters p{.width = n[0], .height = n[1]};
  p.camera_matrix = {n[2], 0, n[at] - kPixelCentre, 0, n[at - 1], n[at + 1] - kPixelCentre, 0, 0, 1};
  p.is_fisheye = of.is_fisheye;
  p.distortion.resize(of.is_fisheye ? 4 : 8);
  for (std::size_t i = 0; i < of.distortion.size(); ++i) p.distortion[of.distortion[i]] = n[at + 2 + i];
  return p;
}

/// Returns a part of a path, counted from its end: 0 is the file's name without its extension, 1 the name of the folder
/// that contains it. Returns "" if there is no such part.
std::string PartOf(std::string_view path, std::size_t from_end) {
  const auto parts = SplitAt(path, '/');
  if (from_end >= parts.size()) return "";
  const std::string_view part = parts[parts.size() - 1 - from_end];
  return std::string(from_end == 0 ? part.substr(0, part.find_last_of('.')) : part);
}

/// Names the cameras after their images or, if two of these have the same name, after the images' folders.
Result<void> NameCameras(std::span<const std::string> paths, std::vector<NamedCamera>& cameras, const Place& place) {
  constexpr std::size_t kMaxDepth = 8;
  for (std::size_t part = 0; part < kMaxDepth; ++part) {
    std::set<std::string> names;
    for (const std::string& path : paths) names.insert(PartOf(path, part));
    if (names.size() < paths.size() || (part > 0 && names.contains(""))) continue;
    for (std::size_t i = 0; i < paths.size(); ++i) cameras[i].name = PartOf(paths[i], part);
    return {};
  }
  return Fail(place,
              "{} images do not have different file names or different folder names; allowed: one image for each "
              "camera, in a file or folder named after the camera",
              paths.size());
}

}  // namespace

Result<RigFile> ReadColmap(std::string_view cameras, std::string_view images, const std::string& images_file) {
  // Read the intrinsics, by camera, and the lines that state them.
  std::map<std::string, OpenCvParameters> inside;
  std::map<std::string, int> lines;
  for (const ColmapLine& line : LinesOf(cameras)) {
    if (line.words.empty()) continue;
    ASSIGN_OR_RETURN(inside[line.words.front()], InsideOf(line));
    lines[line.words.front()] = line.number;
  }
  RigFile rig{.cameras = {}, .format = "COLMAP", .R_WF = kYUpOfZUp, .has_unit = false};
  std::vector<std::string> paths;
  // Each image has two lines; the second one lists its points and is skipped.
  bool is_points = false;
  for (const ColmapLine& line : LinesOf(images)) {
    if (is_points || line.words.empty()) {
      is_points = false;
      continue;
    }
    is_points = true;
    const Place place{images_file, line.number, 0};
    constexpr std::size_t kWords = 10;
    if (line.words.size() < kWords) {
      return Fail(place,
                  "this line does not describe an image; allowed: IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME, "
                  "followed by a line with the image's points");
    }
    // Combine the pose of the image with the intrinsics of its camera.
    const auto camera = inside.find(line.words[8]);
    if (camera == inside.end()) return Fail(place, "camera {} is not in cameras.txt", line.words[8]);
    ASSIGN_OR_RETURN(const auto n, NumbersFrom(line, 1, 8, place));
    OpenCvParameters p = camera->second;
    const glm::dquat turn(n[0], n[1], n[2], n[3]);
    if (!(glm::length(turn) > 0))
      return Fail(place, "the quaternion QW QX QY QZ is 0 0 0 0; allowed: a quaternion of length above 0");
    p.R = glm::mat3_cast(glm::normalize(turn));
    p.T = {n[4], n[5], n[6]};
    const Place in_cameras{{}, lines[camera->first], 0};
    ASSIGN_OR_RETURN(auto named, CameraIn(camera->first, std::move(p), rig.R_WF, in_cameras));
    rig.cameras.push_back(std::move(named));
    paths.push_back(line.words[9]);
  }
  if (rig.cameras.empty()) return Fail({images_file}, "images.txt contains no image");
  RETURN_IF_ERROR(NameCameras(paths, rig.cameras, {images_file}));
  return rig;
}

}  // namespace etude
