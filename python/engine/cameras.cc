#include <etude/cameras.h>
#include <etude/capture.h>

#include <initializer_list>
#include <optional>

#include "python/engine/arrays.h"

namespace etude::engine {
namespace {

Array ProjectAll(const Camera& camera, const Array& points_m) {
  Expect("points_m", points_m, {kAny, 3});
  Array pixels({points_m.shape(0), py::ssize_t{2}});
  double* pixel = pixels.mutable_data();
  for (py::ssize_t i = 0; i < points_m.shape(0); ++i, pixel += 2) {
    const auto seen = Project(camera, Vector(points_m.data() + 3 * i));
    pixel[0] = seen ? seen->x : kNan;
    pixel[1] = seen ? seen->y : kNan;
  }
  return pixels;
}

CalibratedCamera CalibrateAll(const Array& points_m, const Array& pixels, int width, int height) {
  Expect("points_m", points_m, {kAny, 3});
  Expect("pixels", pixels, {points_m.shape(0), 2});
  ExpectFinite("points_m", points_m);
  ExpectFinite("pixels", pixels);
  std::vector<PointPair> pairs(static_cast<std::size_t>(points_m.shape(0)));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i] = {Vector(points_m.data() + 3 * i), {pixels.data()[2 * i], pixels.data()[2 * i + 1]}};
  }
  const py::gil_scoped_release free;
  return Calibrate(pairs, width, height);
}

py::tuple TriangulateAll(const std::vector<Camera>& cameras, const Array& pixels) {
  Expect("pixels", pixels, {static_cast<py::ssize_t>(cameras.size()), kAny, 2});
  const py::ssize_t count = pixels.shape(1);
  Array places({count, py::ssize_t{3}}), residuals(count);
  std::vector<std::optional<glm::dvec2>> seen(cameras.size());
  for (py::ssize_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      const double* pixel = pixels.data(static_cast<py::ssize_t>(c), i, 0);
      const bool is_seen = std::isfinite(pixel[0]) && std::isfinite(pixel[1]);
      seen[c] = is_seen ? std::optional(glm::dvec2(pixel[0], pixel[1])) : std::nullopt;
    }
    const auto point = Triangulate(cameras, seen);
    Put(point ? point->p_WQ : glm::dvec3(kNan), places.mutable_data(i, 0));
    residuals.mutable_data()[i] = point ? point->residual_px : kNan;
  }
  return py::make_tuple(places, residuals);
}

CapturedMotion CaptureAll(const std::vector<Camera>& cameras, const std::vector<std::vector<Array>>& keypoints,
                          const std::string& layout, double rate_hz, int person, double smooth_hz) {
  std::vector<SeenPeople> seen;
  for (const std::vector<Array>& frames : keypoints) {
    SeenPeople& camera = seen.emplace_back();
    for (const Array& people : frames) {
      Expect("keypoints", people, {kAny, kAny, 3});
      auto& persons = camera.emplace_back(static_cast<std::size_t>(people.shape(0)),
                                          SeenPerson(static_cast<std::size_t>(people.shape(1))));
      const double* value = people.data();
      for (SeenPerson& each : persons) {
        for (Keypoint& keypoint : each) {
          const bool is_seen = std::isfinite(value[0]) && std::isfinite(value[1]) && std::isfinite(value[2]);
          if (is_seen) keypoint = {{value[0], value[1]}, value[2]};
          value += 3;
        }
      }
    }
  }
  const py::gil_scoped_release free;
  return Capture(cameras, seen, {.layout = layout, .rate_hz = rate_hz, .person = person, .smooth_hz = smooth_hz});
}

}  // namespace

void AddCameras(py::module_& module) {
  py::class_<Camera> camera(module, "Camera",
                            "A camera with its lens (Brown-Conrady, OpenCV's coefficients); its axes are x "
                            "right, y down, z forward; the first pixel's centre is (0.5, 0.5).");
  camera.def(py::init<>())
      .def_readwrite("name", &Camera::name)
      .def_property("R_CW", ArrayOf(&Camera::R_CW), SetMatrix(&Camera::R_CW, "R_CW"),
                    "Rotation from the world's axes to the camera's.")
      .def_property("p_WC", ArrayOf(&Camera::p_WC), SetVector(&Camera::p_WC, "p_WC"),
                    "Position of the camera in the world, metres.")
      .def_readwrite("width", &Camera::width)
      .def_readwrite("height", &Camera::height);
  for (const auto& [name, member] :
       std::initializer_list<std::pair<const char*, double Camera::*>>{{"fx", &Camera::fx},
                                                                       {"fy", &Camera::fy},
                                                                       {"cx", &Camera::cx},
                                                                       {"cy", &Camera::cy},
                                                                       {"skew", &Camera::skew},
                                                                       {"k1", &Camera::k1},
                                                                       {"k2", &Camera::k2},
                                                                       {"p1", &Camera::p1},
                                                                       {"p2", &Camera::p2},
                                                                       {"k3", &Camera::k3}}) {
    camera.def_readwrite(name, member);
  }
  module.def(
      "read_rig", &ReadRig, "text"_a, "file"_a = "rig",
      "The cameras of a rig's text: Etude, OpenCV, Pose2Sim, Anipose or Qualisys. `file`: what complaints call it.");
  module.def("project", &ProjectAll, "camera"_a, "points_m"_a,
             "Pixels (n x 2) of points (n x 3); NaN for points that the camera cannot see.");
  module.def(
      "calibrate",
      [](const Array& points_m, const Array& pixels, int width, int height) {
        const CalibratedCamera found = CalibrateAll(points_m, pixels, width, height);
        return py::make_tuple(found.camera, found.rms_px);
      },
      "points_m"_a, "pixels"_a, "width"_a, "height"_a,
      "(Camera of least squared reprojection error, its root mean square in pixels). Raises BadInput where the points "
      "do not "
      "determine one.");
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
      "capture", &CaptureAll, "cameras"_a, "keypoints"_a, "layout"_a = CaptureOptions{}.layout,
      "rate_hz"_a = CaptureOptions{}.rate_hz, "person"_a = 0, "smooth_hz"_a = 0.0,
      "keypoints: of each camera, of each frame, people x keypoints x (u, v, confidence), NaN where not seen. layout: "
      "'coco', 'body_25', 'body_25b', 'halpe_26', 'halpe_26_hands'.");
}

}  // namespace etude::engine
