#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// An array of numbers in C order (the last index varies fastest).
struct NumberArray {
  std::vector<std::size_t> shape;  ///< size of each dimension; empty for a single number
  std::vector<double> values;
};

/// The arrays of an .npz file (NumPy's format: a ZIP of .npy files), by name.
struct Npz {
  std::map<std::string, NumberArray> arrays;
  std::map<std::string, std::vector<std::string>> texts;  ///< lists of texts, '?' for each letter beyond ASCII
  std::vector<std::string> skipped;  ///< names of members without plain numbers: texts, pickled objects

  /// Returns the array of that name, or null.
  const NumberArray* Find(const std::string& name) const;
  /// Returns true if there is an array with this name, of any type.
  bool Contains(const std::string& name) const;
};

/// Returns the names of the first twenty arrays as text for messages; "none" without any.
std::string NamesOfArrays(const Npz& npz);

/// Returns the shape as text for messages: "3 × 20 × 3".
std::string ShapeText(const NumberArray& array);

/// The frame rate that arrays state, and the name of the array that states it.
struct ArrayRate {
  double rate_hz = 0;
  std::string name;
};
/// Finds the frame rate in one of the arrays rate_hz, fps, framerate, frame_rate, mocap_framerate and mocap_frame_rate;
/// nullopt if there is none. Fails if such an array is not one number, or if two of them differ.
Result<std::optional<ArrayRate>> RateOfArrays(const Npz& arrays, const std::string& file);

/// Returns true if bytes begin like a ZIP file.
bool IsZip(std::string_view bytes);

/// Reads an .npz file, stored or deflated, also ZIP64, with floats and whole numbers of any size and byte order.
/// Returns an error if the file is damaged, has more than 1,000 members, or has more than 512 MiB in total when
/// unpacked.
Result<Npz> ReadNpz(std::string_view bytes, const std::string& file);

/// Returns true if bytes begin like an .npy file.
bool IsNpy(std::string_view bytes);
/// Reads an .npy file of plain numbers. Returns an error for other types, and for anything that ReadNpz refuses.
Result<NumberArray> ReadNpy(std::string_view bytes, const std::string& file);

/// Writes an .npz file, stored: numbers as 8-byte floats, lists of texts in ASCII. The same arrays give the same bytes.
std::string WriteNpz(const std::map<std::string, NumberArray>& numbers,
                     const std::map<std::string, std::vector<std::string>>& texts);

}  // namespace etude
