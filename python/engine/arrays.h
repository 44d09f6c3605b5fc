#pragma once

#include <etude/base.h>
#include <etude/motion.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/fuzzy/features.h"

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

}  // namespace etude::engine

namespace pybind11::detail {

/// Converts any array, or a list or tuple of arrays, to doubles. Masked entries of a numpy.ma.MaskedArray, whose
/// numbers mean nothing, become NaN.
template <>
struct pyobject_caster<etude::engine::Array> {
  using type = etude::engine::Array;

  bool load(handle source, bool convert) {
    if (!convert && !type::check_(source)) return false;
    object array = reinterpret_borrow<object>(source);
    try {
      const auto is_masked = [](handle one) { return hasattr(one, "filled"); };
      if ((isinstance<list>(array) || isinstance<tuple>(array)) && std::any_of(array.begin(), array.end(), is_masked))
        array = module_::import("numpy").attr("ma").attr("array")(array);  // numpy.array would forget the masks
      if (isinstance<pybind11::array>(array) && hasattr(array, "filled"))
        array = array.attr("astype")("float64").attr("filled")(std::numeric_limits<double>::quiet_NaN());
    } catch (const error_already_set&) {
      return false;
    }
    value = type::ensure(array);
    return static_cast<bool>(value);
  }
  static handle cast(const handle& source, return_value_policy, handle) { return source.inc_ref(); }
  PYBIND11_TYPE_CASTER(type, handle_type_name<type>::name);
};

}  // namespace pybind11::detail

namespace etude::engine {

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

/// The shape of one value of type T in an array. The numbers of the value are stored row by row.
template <typename T>
const std::vector<py::ssize_t> kShape{};
template <>
inline const std::vector<py::ssize_t> kShape<glm::dvec2>{2};
template <>
inline const std::vector<py::ssize_t> kShape<glm::dvec3>{3};
template <>
inline const std::vector<py::ssize_t> kShape<glm::dmat3>{3, 3};
template <>
inline const std::vector<py::ssize_t> kShape<BodyPose>{kRoleCount, 3};
template <>
inline const std::vector<py::ssize_t> kShape<PoseFeatures>{kFeatureCount};
template <typename T>
constexpr py::ssize_t kNumbers = sizeof(T) / sizeof(double);

template <typename T>
std::vector<py::ssize_t> ShapeOfMany(py::ssize_t count) {
  std::vector<py::ssize_t> shape = kShape<T>;
  shape.insert(shape.begin(), count);
  return shape;
}

template <typename T>
T Get(const double* numbers) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(static_cast<void*>(&value), numbers, sizeof(T));
  if constexpr (std::is_same_v<T, glm::dmat3>) return glm::transpose(value);
  return value;
}
template <typename T>
void Put(T value, double* numbers) {
  if constexpr (std::is_same_v<T, glm::dmat3>) value = glm::transpose(value);
  std::memcpy(numbers, &value, sizeof(T));
}

template <typename T>
T FromArray(const char* name, const Array& array) {
  Expect(name, array, kShape<T>);
  return Get<T>(array.data());
}
template <typename T>
std::vector<T> FromArrays(const char* name, const Array& array) {
  Expect(name, array, ShapeOfMany<T>(kAny));
  std::vector<T> values;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) values.push_back(Get<T>(array.data() + i * kNumbers<T>));
  return values;
}

template <typename T>
Array ToArray(const T& value) {
  Array array(kShape<T>);
  Put(value, array.mutable_data());
  return array;
}
template <typename T>
Array ToArrays(const std::vector<T>& values) {
  Array array(ShapeOfMany<T>(static_cast<py::ssize_t>(values.size())));
  for (std::size_t i = 0; i < values.size(); ++i) Put(values[i], array.mutable_data() + i * kNumbers<T>);
  return array;
}

/// Makes a getter for Python: a function that returns a member of an object as an array.
template <typename Class, typename Value>
auto ArrayOf(Value Class::*member) {
  return [member](const Class& of) { return ToArray(of.*member); };
}
template <typename Class, typename Value>
auto ArraysOf(std::vector<Value> Class::*member) {
  return [member](const Class& of) { return ToArrays(of.*member); };
}

/// Calls `work` without the interpreter's lock, and returns its result.
auto Unlocked(const auto& work) {
  const py::gil_scoped_release free;
  return work();
}

}  // namespace etude::engine
