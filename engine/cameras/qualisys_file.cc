#include "engine/cameras/qualisys_file.h"

#include <libxml/parser.h>
#include <libxml/tree.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <string>

#include "engine/cameras/calibration_text.h"

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

Place PlaceOf(const xmlNode* node) { return {{}, static_cast<int>(xmlGetLineNo(node)), 0}; }

std::string Text(const xmlNode* node, const char* attribute) {
  const std::unique_ptr<xmlChar, void (*)(void*)> value(xmlGetProp(node, Bytes(attribute)), xmlFree);
  return value ? reinterpret_cast<const char*>(value.get()) : "";
}

/// The attributes of an element as numbers; the first one that is none is kept as a complaint.
class Numbers {
 public:
  explicit Numbers(const xmlNode* node) : node_(node) {}

  double operator[](const char* attribute) {
    const std::string text = Text(node_, attribute);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
    if (!is_number && complaint_.empty()) complaint_ = fmt::format("{}=\"{}\" is no number", attribute, text);
    return value;
  }
  Result<void> Finish() const {
    if (!complaint_.empty()) return Fail(PlaceOf(node_), "{}", complaint_);
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
  constexpr double kLargestPixelRange = 16384;
  const double unit = of["sensorMaxU"] > kLargestPixelRange ? 64 : 1;  // of a pixel
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
  const Place place = PlaceOf(node);
  const xmlNode *transform = Child(node, "transform"), *intrinsic = Child(node, "intrinsic");
  if (name.empty()) return Fail(place, "a camera without a serial number");
  if (transform == nullptr) return Fail(place, "camera {} has no transform", name);
  if (intrinsic == nullptr) return Fail(place, "camera {} has no intrinsic", name);
  if (const std::string turned = Text(node, "viewrotation"); !turned.empty() && turned != "0") {
    return Fail(place, "camera {}: its pictures are turned (viewrotation=\"{}\"); allowed: 0", name, turned);
  }
  ASSIGN_OR_RETURN(OpenCvParameters p, InsideOf(node, intrinsic));
  Numbers of(transform);
  // By rows: the camera's axes (x right, y up, z behind) in QTM's world, whose z is up.
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
  // No entities, no network, no words on the terminal.
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
    return Fail(PlaceOf(root), "<{}>; allowed: <calibration> of Qualisys Track Manager",
                reinterpret_cast<const char*>(root->name));
  }
  const xmlNode* cameras = Child(root, "cameras");
  std::vector<NamedCamera> rig;
  for (const xmlNode* node = cameras != nullptr ? cameras->children : nullptr; node != nullptr; node = node->next) {
    if (!IsNamed(node, "camera")) continue;
    ASSIGN_OR_RETURN(auto camera, ReadCamera(node));
    rig.push_back(std::move(camera));
  }
  if (rig.empty()) return Fail(PlaceOf(root), "no camera");
  return rig;
}

}  // namespace etude
