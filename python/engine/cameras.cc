#include <etude/cameras.h>
#include <etude/capture.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

/// Converts an optional pixel: nullopt becomes NaN.
glm::dvec2 PixelOf(const std::optional<glm::dvec2>& pixel) { return pixel.value_or(glm::dvec2(kNan)); }

bool IsFinite(const double* numbers, int count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

Array ProjectAll(const NamedCamera& camera, const Array& points_m) {
  std::vector<glm::dvec2> pixels;
  for (const glm::dvec3& point : FromArrays<glm::dvec3>("points_m", points_m)) {
    pixels.push_back(PixelOf(Project(camera.camera, point)));
  }
  return ToArrays(pixels);
}

py::tuple CalibrateAll(const Array& points_m, const Array& pixels, int width, int height) {
  const auto points = FromArrays<glm::dvec3>("points_m", points_m);
  Expect("pixels", pixels, {points_m.shape(0), 2});
  ExpectFinite("points_m", points_m);
  ExpectFinite("pixels", pixels);
  std::vector<PointPair> pairs;
  for (const glm::dvec2& pixel : FromArrays<glm::dvec2>("pixels", pixels))
    pairs.push_back({points[pairs.size()], pixel});
  const CalibratedCamera found = Unlocked([&] { return Calibrate(pairs, width, height); });
  return py::make_tuple(NamedCamera{"", found.camera}, found.rms_px);
}

py::tuple TriangulateAll(const std::vector<NamedCamera>& cameras, const Array& pixels) {
  Expect("pixels", pixels, {static_cast<py::ssize_t>(cameras.size()), kAny, 2});
  const py::ssize_t count = pixels.shape(1);
  Array places({count, py::ssize_t{3}}), residuals(count);
  std::vector<std::optional<glm::dvec2>> seen(cameras.size());
  for (py::ssize_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      const double* pixel = pixels.data(static_cast<py::ssize_t>(c), i, 0);
      seen[c] = IsFinite(pixel, 2) ? std::optional(Get<glm::dvec2>(pixel)) : std::nullopt;
    }
    const TriangulatedPoint point = Triangulate(cameras, seen);
    const bool is_found = point.status == PointStatus::kOk;
    Put(is_found ? point.position : glm::dvec3(kNan), places.mutable_data(i, 0));
    residuals.mutable_data()[i] = is_found ? point.residual_px : kNan;
  }
  return py::make_tuple(places, residuals);
}

CapturedMotion CaptureAll(const std::vector<NamedCamera>& cameras, const std::vector<std::vector<Array>>& keypoints,
                          const std::string& layout_name, double rate_hz, int person, double smooth_hz) {
  const KeypointLayout* layout = FindKeypointLayout(layout_name);
  if (layout == nullptr) {
    throw BadInput(fmt::format("layout '{}'; allowed: {}", layout_name, fmt::join(KeypointLayoutNames(), ", ")));
  }
  const auto points = static_cast<py::ssize_t>(layout->landmarks.size());
  std::vector<SeenPeople> seen;
  for (const std::vector<Array>& frames : keypoints) {
    SeenPeople& camera = seen.emplace_back();
    for (const Array& people : frames) {
      Expect("keypoints", people, {kAny, kAny, 3});
      if (people.shape(0) > 0 && people.shape(1) != points) {
        throw BadInput(
            fmt::format("{} keypoints; allowed: those of layout {}, {}", people.shape(1), layout_name, points));
      }
      std::vector<SeenPerson>& persons = camera.emplace_back(static_cast<std::size_t>(people.shape(0)));
      const double* value = people.data();
      for (SeenPerson& each : persons) {
        for (const Landmark landmark : layout->landmarks) {
          if (landmark != Landmark::kNoLandmark && IsFinite(value, 3))
            each[landmark] = {{value[0], value[1]}, value[2]};
          value += 3;
        }
      }
    }
  }
  const py::gil_scoped_release free;
  return Capture(cameras, seen, {.rate_hz = rate_hz, .person = person, .smooth_hz = smooth_hz});
}

}  // namespace

void AddCameras(py::module_& module) {
  py::class_<NamedCamera> camera(module, "Camera",
                                 "A camera with its lens (OpenCV's models and coefficients); its axes are x right, y "
                                 "down, z forward; the first pixel's centre is (0.5, 0.5).");
  const auto add = [&](const char* name, auto part, auto member) {
    using Value = std::decay_t<decltype(std::declval<NamedCamera>().camera.*part.*member)>;
    camera.def_property(
        name, [=](const NamedCamera& of) { return of.camera.*part.*member; },
        [=](NamedCamera& of, Value value) { of.camera.*part.*member = value; });
  };
  camera.def(py::init<>())
      .def_readwrite("name", &NamedCamera::name)
      .def_property(
          "R_CW", [](const NamedCamera& of) { return ToArray(of.camera.R_CW); },
          [](NamedCamera& of, const Array& value) { of.camera.R_CW = FromArray<glm::dmat3>("R_CW", value); },
          "Rotation from the world's axes to the camera's.")
      .def_property(
          "p_WC", [](const NamedCamera& of) { return ToArray(of.camera.p_WC); },
          [](NamedCamera& of, const Array& value) { of.camera.p_WC = FromArray<glm::dvec3>("p_WC", value); },
          "Position of the camera in the world, metres.");
  for (const auto& [name, member] : {std::pair{"width", &Intrinsics::width}, {"height", &Intrinsics::height}}) {
    add(name, &Camera::intrinsics, member);
  }
  for (const auto& [name, member] : {std::pair{"fx", &Intrinsics::fx},
                                     {"fy", &Intrinsics::fy},
                                     {"cx", &Intrinsics::cx},
                                     {"cy", &Intrinsics::cy},
                                     {"skew", &Intrinsics::skew}}) {
    add(name, &Camera::intrinsics, member);
  }
  for (const auto& [name, member] : {std::pair{"k1", &Distortion::k1},
                                     {"k2", &Distortion::k2},
                                     {"p1", &Distortion::p1},
                                     {"p2", &Distortion::p2},
                                     {"k3", &Distortion::k3},
                                     {"k4", &Distortion::k4},
                                     {"k5", &Distortion::k5},
                                     {"k6", &Distortion::k6},
                                     {"s1", &Distortion::s1},
                                     {"s2", &Distortion::s2},
                                     {"s3", &Distortion::s3},
                                     {"s4", &Distortion::s4},
                                     {"tau_x", &Distortion::tau_x},
                                     {"tau_y", &Distortion::tau_y}}) {
    add(name, &Camera::distortion, member);
  }
  add("is_fisheye", &Camera::distortion, &Distortion::is_fisheye);
  module.def(
      "read_rig", &ReadRig, "text"_a, "file"_a = "rig",
      "The cameras of a rig's text: Etude, OpenCV, Pose2Sim, Anipose or Qualisys. `file`: what complaints call it.");
  module.def("project", &ProjectAll, "camera"_a, "points_m"_a,
             "Pixels (n x 2) of points (n x 3); NaN for points that the camera cannot see.");
  module.def("calibrate", &CalibrateAll, "points_m"_a, "pixels"_a, "width"_a, "height"_a,
             "(Camera of least squared reprojection error, its root mean square in pixels). Raises BadInput where the "
             "points do not determine one.");
  module.def("triangulate", &TriangulateAll, "cameras"_a, "pixels"_a,
             "(n x 3 metres, n residuals in pixels) of pixels: cameras x n x 2, NaN where a camera does not see a "
             "point; the result is NaN for points that fewer than two cameras see.");
  py::class_<CapturedMotion>(module, "CapturedMotion", "A person's motion, recovered from keypoints.")
      .def_readonly("motion", &CapturedMotion::motion)
      .def_readonly("bvh", &CapturedMotion::bvh, "The motion as a BVH file in metres, with the person's own skeleton.")
      .def_readonly("is_held", &CapturedMotion::is_held,
                    "Per frame, whether nothing could be recovered; it then shows the last pose.")
      .def_readonly("residual_px", &CapturedMotion::residual_px);
  module.def(
      "capture", &CaptureAll, "cameras"_a, "keypoints"_a, "layout"_a = "coco", "rate_hz"_a = CaptureOptions{}.rate_hz,
      "person"_a = 0, "smooth_hz"_a = 0.0,
      "keypoints: of each camera, of each frame, people x keypoints x (u, v, confidence), NaN where not seen. layout: "
      "'coco', 'coco_18', 'body_25', 'body_25b', 'halpe_26', 'halpe_26_hands', 'mediapipe', ….");
}

}  // namespace etude::engine
