#include "engine/cameras/rig_file.h"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <memory>
#include <string>

#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/rig_pairs.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

const xmlChar* Bytes(const char* text) { return reinterpret_cast<const xmlChar*>(text); }

bool IsNamed(const xmlNode* node, const char* name) {
  return node->type == XML_ELEMENT_NODE && xmlStrEqual(node->name, Bytes(name)) == 1;
}

const xmlNode* Child(const xmlNode* parent, const char* name) {
  for (const xmlNode* node = parent->children; node != nullptr; node = node->next) {
    if (IsNamed(node, name)) return node;
  }
  return nullptr;
}

Place PlaceOfNode(const xmlNode* node) { return {{}, static_cast<int>(xmlGetLineNo(node)), 0}; }

std::string Text(const xmlNode* node, const char* attribute) {
  const std::unique_ptr<xmlChar, void (*)(void*)> value(xmlGetProp(node, Bytes(attribute)), xmlFree);
  return value ? reinterpret_cast<const char*>(value.get()) : "";
}

/// Reads attributes of an element as numbers; remembers the first one that is not a number.
class Numbers {
 public:
  explicit Numbers(const xmlNode* node) : node_(node) {}

  double operator[](const char* attribute) {
    const std::string text = Text(node_, attribute);
    const auto value = ParseFinite(text);
    if (!value && complaint_.empty()) complaint_ = fmt::format("{}=\"{}\" is not a number", attribute, text);
    return value.value_or(0);
  }
  Result<void> Finish() const {
    if (!complaint_.empty()) return Fail(PlaceOfNode(node_), "{}", complaint_);
    return {};
  }

 private:
  const xmlNode* node_;
  std::string complaint_;
};

struct Window {
  double left = 0, top = 0, width = 0, height = 0;
};

Result<Window> WindowOf(const xmlNode* camera, const Window& sensor) {
  const xmlNode* fov = Child(camera, "fov_video");
  if (fov == nullptr) return sensor;
  Numbers of(fov);
  const Window window{of["left"], of["top"], of["right"] - of["left"] + 1, of["bottom"] - of["top"] + 1};
  RETURN_IF_ERROR(of.Finish());
  return window;
}

Result<OpenCvParameters> InsideOf(const xmlNode* camera, const xmlNode* intrinsic) {
  Numbers of(intrinsic);
  constexpr double kMaxPixelRange = 16384;
  const double unit = of["sensorMaxU"] > kMaxPixelRange ? 64 : 1;  // units of the file per pixel
  const auto side = [&](const char* low, const char* high) { return std::round((of[high] - of[low]) / unit); };
  const Window sensor{0, 0, side("sensorMinU", "sensorMaxU"), side("sensorMinV", "sensorMaxV")};
  ASSIGN_OR_RETURN(const Window window, WindowOf(camera, sensor));
  OpenCvParameters p{
      .width = window.width,
      .height = window.height,
      .camera_matrix = {of["focalLengthU"] / unit, of["skew"] / unit, of["centerPointU"] / unit - window.left, 0,
                        of["focalLengthV"] / unit, of["centerPointV"] / unit - window.top, 0, 0, 1},
      .distortion = {of["radialDistortion1"], of["radialDistortion2"], of["tangentalDistortion1"],
                     of["tangentalDistortion2"], of["radialDistortion3"]}};
  RETURN_IF_ERROR(of.Finish());
  return p;
}

Result<NamedCamera> ReadCamera(const xmlNode* node) {
  const std::string name = Text(node, "serial");
  const Place place = PlaceOfNode(node);
  const xmlNode *transform = Child(node, "transform"), *intrinsic = Child(node, "intrinsic");
  if (name.empty()) return Fail(place, "a camera without a serial number");
  if (transform == nullptr) return Fail(place, "camera {} has no element <transform>", name);
  if (intrinsic == nullptr) return Fail(place, "camera {} has no element <intrinsic>", name);
  ASSIGN_OR_RETURN(OpenCvParameters p, InsideOf(node, intrinsic));
  Numbers of(transform);
  // The rows of the matrix are the camera's axes (x right, y up, z backwards) in QTM's world, which has Z up.
  const glm::dvec3 right(of["r11"], of["r12"], of["r13"]), up(of["r21"], of["r22"], of["r23"]),
      behind(of["r31"], of["r32"], of["r33"]);
  constexpr double kMetresPerMm = 0.001;
  const glm::dvec3 centre = kMetresPerMm * glm::dvec3(of["x"], of["y"], of["z"]);
  RETURN_IF_ERROR(of.Finish());
  const auto y_up = [](const glm::dvec3& v) { return glm::dvec3(v.y, v.z, v.x); };
  p.R = glm::transpose(glm::dmat3(y_up(right), -y_up(up), -y_up(behind)));
  p.T = -(p.R * y_up(centre));
  const auto camera = CameraOf(p);
  if (!camera) return Fail(place, "camera {}: {}", name, camera.error().message);
  return NamedCamera{name, *camera};
}

}  // namespace

Result<std::vector<NamedCamera>> ReadQualisysCalibration(std::string_view text) {
  // Parse without substituting entities, using the network, or printing to the terminal.
  const std::unique_ptr<xmlDoc, void (*)(xmlDoc*)> document(
      xmlReadMemory(text.data(), static_cast<int>(text.size()), nullptr, nullptr,
                    XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING),
      xmlFreeDoc);
  if (!document) {
    const xmlError* const error = xmlGetLastError();
    return Fail({{}, error != nullptr ? error->line : 0, 0}, "no XML");
  }
  const xmlNode* root = xmlDocGetRootElement(document.get());
  if (!IsNamed(root, "calibration")) {
    return Fail(PlaceOfNode(root),
                "found the element <{}>; allowed: <calibration>, as Qualisys Track Manager writes it",
                reinterpret_cast<const char*>(root->name));
  }
  const xmlNode* cameras = Child(root, "cameras");
  std::vector<NamedCamera> rig;
  for (const xmlNode* node = cameras != nullptr ? cameras->children : nullptr; node != nullptr; node = node->next) {
    if (!IsNamed(node, "camera")) continue;
    ASSIGN_OR_RETURN(auto camera, ReadCamera(node));
    rig.push_back(std::move(camera));
  }
  if (rig.empty()) return Fail(PlaceOfNode(root), "no camera");
  return rig;
}

namespace {

constexpr std::size_t kMaxRigBytes = std::size_t{1} << 20;
constexpr std::size_t kMaxRigCameras = 64;
constexpr std::string_view kYamlDirective = "%YAML:1.0\n---\n";

/// Returns the text of a camera's own file without its first two lines, indented.
std::string Indented(std::string_view text) {
  text.remove_prefix(kYamlDirective.size());
  std::string out;
  while (!text.empty()) out.append("   ").append(TakeLine(text)).append("\n");
  return out;
}

/// Makes a valid key of FileStorage: a word that begins with a letter.
std::string FileStorageName(std::string name) {
  const auto is_letter = [](char c) { return IsLower(c) || IsUpper(c) || c == '_'; };
  for (char& c : name) {
    if (!is_letter(c) && !IsDigit(c)) c = '_';
  }
  if (name.empty() || !is_letter(name.front()) || name == "cameras") name.insert(0, "camera_");
  return name;
}

Result<double> NumberAt(const Node& camera, std::string_view key) {
  const Node* number = camera.Find(key);
  if (number == nullptr) return Fail(camera.place, "no {}", key);
  return AsNumber(*number);
}

/// Reads one camera. A camera in a file of its own may lack the distortion; it may also lack R and T, in which case the
/// world is the camera's frame.
Result<Camera> ReadCamera(const Node& node, bool is_alone) {
  OpenCvParameters p;
  const auto is_given = [&](const char* key) { return !is_alone || node.Find(key) != nullptr; };
  ASSIGN_OR_RETURN(p.width, NumberAt(node, "image_width"));
  ASSIGN_OR_RETURN(p.height, NumberAt(node, "image_height"));
  ASSIGN_OR_RETURN(p.camera_matrix, MatrixAt(node, "camera_matrix", 3, 3));
  if (is_given("distortion_coefficients")) {
    ASSIGN_OR_RETURN(p.distortion, MatrixAt(node, "distortion_coefficients", 0, 0));
  }
  if (is_given("R")) {
    ASSIGN_OR_RETURN(const auto R, MatrixAt(node, "R", 3, 3));
    p.R = glm::transpose(glm::make_mat3(R.data()));
  }
  if (is_given("T")) {
    ASSIGN_OR_RETURN(const auto T, MatrixAt(node, "T", 3, 1));
    p.T = glm::make_vec3(T.data());
  }
  if (const Node* fisheye = node.Find("fisheye")) {
    ASSIGN_OR_RETURN(const double flag, AsNumber(*fisheye));
    p.is_fisheye = flag != 0;
  }
  auto camera = CameraOf(p);
  if (!camera) return Fail(node.place, "{}", camera.error().message);
  return camera;
}

Result<std::vector<NamedCamera>> ReadOwnRig(const Node& root) {
  const Node* names = root.Find("cameras");
  ASSIGN_OR_RETURN(const auto cameras, AsTexts(*names));
  if (cameras.empty() || cameras.size() > kMaxRigCameras) {
    return Fail(names->place, "found {} cameras; allowed: 1 to {}", cameras.size(), kMaxRigCameras);
  }
  std::vector<NamedCamera> rig;
  for (const std::string& name : cameras) {
    const Node* node = root.Find(name);
    if (node == nullptr) return Fail(names->place, "camera {} is in the list, but the file has no entry for it", name);
    const auto camera = ReadCamera(*node, false);
    if (!camera) return Fail(camera.error().place, "camera {}: {}", name, camera.error().message);
    rig.push_back({name, *camera});
  }
  return rig;
}

/// Replaces OpenCV's first line, which other YAML readers reject as a directive, by a comment.
std::string WithoutDirective(std::string_view text) {
  std::string plain(text);
  if (plain.starts_with("%YAML:")) plain.replace(0, std::min(plain.find('\n'), plain.size()), "#");
  return plain;
}

// Recognises the format of `text` by its first characters or by its keys, and reads the rig.
Result<RigFile> Read(std::string_view text, const std::string& file) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return Fail({}, "nothing in it");
  // An XML file is from Qualisys.
  if (text[first] == '<') {
    ASSIGN_OR_RETURN(auto cameras, ReadQualisysCalibration(text));
    return RigFile{std::move(cameras), "Qualisys", kYUpOfZUp, 0.001};
  }
  // OpenCV's YAML holds a rig or one camera.
  if (text.starts_with("%YAML") || text.find("opencv-matrix") != std::string_view::npos) {
    ASSIGN_OR_RETURN(const Node root, ParseYaml(WithoutDirective(text), file));
    if (root.Find("cameras") != nullptr) {
      ASSIGN_OR_RETURN(auto cameras, ReadOwnRig(root));
      return RigFile{std::move(cameras), "OpenCV's YAML"};
    }
    for (const char* key : {"names", "M1", "R1"}) {
      if (root.Find(key) == nullptr) continue;
      return Fail({},
                  "this file has only one half of a calibration; give both files: intri.yml and extri.yml (EasyMocap), "
                  "or intrinsics.yml and extrinsics.yml (OpenCV)");
    }
    ASSIGN_OR_RETURN(const Camera camera, ReadCamera(root, true));
    return RigFile{{{"camera", camera}}, "OpenCV's YAML"};
  }
  // A TOML file is from Pose2Sim or a program with the same format.
  auto toml = ReadPose2SimCalibration(text);
  const bool has_camera = toml || toml.error().message.starts_with("camera ");
  if (has_camera || text[first] == '[' || text.find("\n[") != std::string_view::npos) {
    if (!toml) return tl::unexpected(toml.error());
    return RigFile{
        *std::move(toml),
        text.find("[cameras.") != std::string_view::npos ? "Caliscope" : "TOML of Pose2Sim, Anipose or FreeMoCap",
        kYUpOfZUp};
  }
  return Fail({},
              "this is not a calibration; allowed: a rig file written by `etude calibrate`, YAML of OpenCV, TOML of "
              "Pose2Sim, Anipose, FreeMoCap or Caliscope, XML of Qualisys, or both files of a calibration by "
              "EasyMocap, OpenCV or COLMAP");
}

/// Applies the checks that all formats share.
Result<RigFile> Checked(Result<RigFile> rig, const std::string& file) {
  if (!rig) {
    Error error = rig.error();
    if (error.place.file.empty()) error.place.file = file;
    return tl::unexpected(std::move(error));
  }
  const std::vector<NamedCamera>& cameras = rig->cameras;
  if (cameras.size() > kMaxRigCameras)
    return Fail({file}, "found {} cameras; allowed: at most {}", cameras.size(), kMaxRigCameras);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (cameras[i].name == cameras[j].name) return Fail({file}, "two cameras are named {}", cameras[i].name);
    }
  }
  return rig;
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

Result<RigFile> ReadRigFile(std::string_view text, const std::string& file) {
  if (text.size() > kMaxRigBytes) return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxRigBytes);
  return Checked(Read(WithoutByteOrderMark(text), file), file);
}

Result<RigFile> ReadRigPair(std::string_view inside, std::string_view outside, const std::string& file,
                            const std::string& outside_file) {
  // The maximum size of a pair of files, larger than the limit for one file, because COLMAP's files also list points.
  constexpr std::size_t kMaxPairBytes = 64 * kMaxRigBytes;
  if (inside.size() + outside.size() > kMaxPairBytes) {
    return Fail({file}, "found {} bytes; allowed: at most {}", inside.size() + outside.size(), kMaxPairBytes);
  }
  if (inside.find("opencv-matrix") == std::string_view::npos) {
    return Checked(ReadColmap(inside, outside, outside_file), file);
  }
  ASSIGN_OR_RETURN(const Node intrinsics, ParseYaml(WithoutDirective(inside), file));
  ASSIGN_OR_RETURN(const Node extrinsics, ParseYaml(WithoutDirective(outside), outside_file));
  return Checked(intrinsics.Find("M1") != nullptr ? ReadOpenCvStereo(intrinsics, extrinsics)
                                                  : ReadEasyMocap(intrinsics, extrinsics),
                 file);
}

Result<std::vector<NamedCamera>> ReadRig(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(RigFile rig, ReadRigFile(text, file));
  return std::move(rig.cameras);
}

}  // namespace etude
