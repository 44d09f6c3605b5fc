#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

namespace etude::testing {

inline constexpr int kIntel = 84, kDec = 85, kMips = 86;

/// Writes C3D files. It is a second implementation of the format, made from the tables of the format's specification.
class C3dWriter {
 public:
  C3dWriter(int machine, bool floats) : machine_(machine), floats_(floats) {}

  std::string labels = "LSHORSHO";  ///< four letters per point
  std::size_t points = 2, frames = 3;
  double scale = 0.25;
  std::string unit = "mm";
  std::size_t second_labels_from = 0;  ///< points from this index on are named by LABELS2; 0 = none
  std::size_t analogue = 0;            ///< analogue values per frame
  std::size_t header_frames = 0;       ///< header's number of frames; 0 = the true number
  double long_frames = 0;              ///< POINT:LONG_FRAMES; 0 = none
  std::size_t told_frames = 0, trial_frames = 0;  ///< POINT:FRAMES, and the last frame in TRIAL; 0 = none
  /// Lists of labels of four letters in the group POINT: "ANGLES" and "LKNARKNA".
  std::vector<std::pair<std::string, std::string>> lists;
  std::string types;  ///< POINT:TYPE_GROUPS, eight letters each

  /// Returns the position of point p in frame f, in the file's unit; in frame 1, points with odd p are lost.
  static glm::dvec3 PlaceOf(std::size_t f, std::size_t p) {
    return glm::dvec3(100.0 * static_cast<double>(p), 10.0 * static_cast<double>(f), -50.5);
  }

  std::string Write() const {
    std::string parameters(4, '\0');
    parameters[2] = 3;
    parameters[3] = static_cast<char>(machine_);
    Group(parameters, 1, "POINT");
    Parameter(parameters, 1, "USED", 2, {}, Word(points));
    Parameter(parameters, 1, "SCALE", 4, {}, Float(floats_ ? -scale : scale));
    Parameter(parameters, 1, "RATE", 4, {}, Float(100));
    if (long_frames > 0) Parameter(parameters, 1, "LONG_FRAMES", 4, {}, Float(long_frames));
    Parameter(parameters, 1, "UNITS", -1, {unit.size()}, unit);
    Parameter(parameters, 1, "Y_SCREEN", -1, {2}, "+Z");
    const std::size_t first = second_labels_from == 0 ? points : second_labels_from;
    Parameter(parameters, 1, "LABELS", -1, {4, first}, labels.substr(0, 4 * first));
    if (first < points) Parameter(parameters, 1, "LABELS2", -1, {4, points - first}, labels.substr(4 * first));
    if (told_frames > 0) Parameter(parameters, 1, "FRAMES", 2, {}, Word(told_frames));
    for (const auto& [name, text] : lists) Parameter(parameters, 1, name, -1, {4, text.size() / 4}, text);
    if (!types.empty()) Parameter(parameters, 1, "TYPE_GROUPS", -1, {8, 2, types.size() / 16}, types);
    if (trial_frames > 0) {
      Group(parameters, 2, "TRIAL");
      Parameter(parameters, 2, "ACTUAL_START_FIELD", 2, {2}, Word(1) + Word(0));
      Parameter(parameters, 2, "ACTUAL_END_FIELD", 2, {2}, Word(trial_frames & 0xffff) + Word(trial_frames >> 16));
    }
    Parameter(parameters, 1, "DATA_START", 2, {}, Word(2 + kBlocks));
    parameters.resize(512 * kBlocks, '\0');

    std::string header(512, '\0');
    header[0] = 2;
    header[1] = 0x50;
    const auto put = [&](std::size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
    put(2, Word(points));
    put(4, Word(analogue));
    put(6, Word(1));
    put(8, Word(header_frames > 0 ? header_frames : frames));
    put(12, Float(floats_ ? -scale : scale));
    put(16, Word(2 + kBlocks));
    put(20, Float(100));
    std::string data;
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t p = 0; p < points; ++p) {
        const bool is_lost = f == 1 && p % 2 == 1;
        const glm::dvec3 place = is_lost ? glm::dvec3(0) : PlaceOf(f, p);
        for (int axis = 0; axis < 3; ++axis) data += Value(floats_ ? place[axis] : std::round(place[axis] / scale));
        data += Value(is_lost ? -1 : 0);
      }
      for (std::size_t a = 0; a < analogue; ++a) data += Value(7);
    }
    return header + parameters + data;
  }

 private:
  static constexpr std::size_t kBlocks = 3;

  std::string Word(std::size_t value) const {
    const char low = static_cast<char>(value & 0xff), high = static_cast<char>(value >> 8 & 0xff);
    return machine_ == kMips ? std::string{high, low} : std::string{low, high};
  }
  std::string Float(double value) const {
    // DEC's format has an exponent higher by two, and exchanges the two 16-bit halves of a number.
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(machine_ == kDec ? value * 4 : value));
    const std::size_t low = bits & 0xffff, high = bits >> 16;
    return machine_ == kIntel ? Word(low) + Word(high) : Word(high) + Word(low);
  }
  std::string Value(double value) const {
    return floats_ ? Float(value) : Word(static_cast<std::uint16_t>(static_cast<std::int16_t>(value)));
  }
  void Group(std::string& out, int id, const std::string& name) const {
    out += static_cast<char>(name.size());
    out += static_cast<char>(-id);
    out += name + Word(3) + '\0';
  }
  void Parameter(std::string& out, int id, const std::string& name, int type, const std::vector<std::size_t>& sizes,
                 const std::string& data) const {
    out += static_cast<char>(name.size());
    out += static_cast<char>(id);
    out += name + Word(2 + 2 + sizes.size() + data.size() + 1);
    out += static_cast<char>(type);
    out += static_cast<char>(sizes.size());
    for (const std::size_t size : sizes) out += static_cast<char>(size);
    out += data + '\0';
  }

  int machine_;
  bool floats_;
};

}  // namespace etude::testing
