#pragma once

#include <etude/base.h>
#include <etude/motion.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <utility>
#include <vector>

/// The module `etude_engine`: libetude's functions (docs/library.md) and simulated sensors on numpy arrays. Lists,
/// other number types and views are converted, and shapes are checked. The interpreter's lock is released while the
/// engine works.
namespace etude::engine {

namespace py = pybind11;
using py::literals::operator""_a;

void AddMotions(py::module_& module);
void AddKinematics(py::module_& module);
void AddCameras(py::module_& module);
void AddStreams(py::module_& module);
void AddVision(py::module_& module);

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr py::ssize_t kAny = -1;

inline std::string ShapeText(const std::vector<py::ssize_t>& shape) {
  std::string text = "(";
  for (const py::ssize_t size : shape) {
    text += (text.size() > 1 ? ", " : "") + (size == kAny ? std::string("any") : std::to_string(size));
  }
  return text + ")";
}

inline std::vector<py::ssize_t> ShapeOf(const Array& array) { return {array.shape(), array.shape() + array.ndim()}; }

/// Throws BadInput unless an array has this shape; kAny stands for any size.
inline void Expect(const char* name, const Array& array, const std::vector<py::ssize_t>& shape) {
  const std::vector<py::ssize_t> found = ShapeOf(array);
  bool fits = found.size() == shape.size();
  for (std::size_t i = 0; fits && i < shape.size(); ++i) fits = shape[i] == kAny || shape[i] == found[i];
  if (!fits) {
    throw BadInput(std::string(name) + ": has the shape " + ShapeText(found) + ", allowed: " + ShapeText(shape));
  }
}

inline void ExpectFinite(const char* name, const Array& array) {
  for (py::ssize_t i = 0; i < array.size(); ++i) {
    if (!std::isfinite(array.data()[i])) {
      throw BadInput(std::string(name) + ": value " + std::to_string(i) + " is not finite");
    }
  }
}

inline glm::dvec3 Vector(const double* values) { return {values[0], values[1], values[2]}; }
/// Returns the matrix that numpy stores row by row.
inline glm::dmat3 Matrix(const double* rows) {
  return {{rows[0], rows[3], rows[6]}, {rows[1], rows[4], rows[7]}, {rows[2], rows[5], rows[8]}};
}
inline void Put(const glm::dvec3& vector, double* values) {
  for (int i = 0; i < 3; ++i) values[i] = vector[i];
}
inline void Put(const glm::dmat3& matrix, double* rows) {
  for (int i = 0; i < 9; ++i) rows[i] = matrix[i % 3][i / 3];
}

inline Array ToArray(const glm::dvec3& vector) {
  Array array(3);
  Put(vector, array.mutable_data());
  return array;
}
inline Array ToArray(const glm::dmat3& matrix) {
  Array array({3, 3});
  Put(matrix, array.mutable_data());
  return array;
}

inline Array ToArray(const std::vector<double>& values, std::vector<py::ssize_t> shape) {
  Array array(std::move(shape));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}

/// Returns the getter of a class's matrix or vector as an array.
template <typename Class, typename Value>
auto ArrayOf(Value Class::*member) {
  return [member](const Class& of) { return ToArray(of.*member); };
}
template <typename Class>
auto SetVector(glm::dvec3 Class::*member, const char* name) {
  return [member, name](Class& of, const Array& value) {
    Expect(name, value, {3});
    of.*member = Vector(value.data());
  };
}
template <typename Class>
auto SetMatrix(glm::dmat3 Class::*member, const char* name) {
  return [member, name](Class& of, const Array& value) {
    Expect(name, value, {3, 3});
    of.*member = Matrix(value.data());
  };
}

inline Pose ToPose(const char* name, const Array& positions_m) {
  Expect(name, positions_m, {kRoleCount, 3});
  Pose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = Vector(positions_m.data() + 3 * i);
  return pose;
}

inline Array FromPose(const Pose& pose) {
  Array places({static_cast<py::ssize_t>(kRoleCount), py::ssize_t{3}});
  for (std::size_t i = 0; i < kRoleCount; ++i) Put(pose.joints[i], places.mutable_data() + 3 * i);
  return places;
}

}  // namespace etude::engine
