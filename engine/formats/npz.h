#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// An array of numbers, in C's order.
struct NumberArray {
  std::vector<std::size_t> shape;  ///< empty = one number
  std::vector<double> values;
};

/// The arrays of an .npz file (NumPy's format: a ZIP of .npy files), by name.
struct Npz {
  std::map<std::string, NumberArray> arrays;
  std::vector<std::string> skipped;  ///< members that hold no plain numbers: texts, pickled objects
};

/// Tells whether bytes begin as a ZIP file does.
bool IsZip(std::string_view bytes);

/// Reads an .npz file, stored or deflated, ZIP64, too: floats and whole numbers of any size, little-endian. Refused: a
/// damaged file, more than 1,000 members, members of more than 512 MiB together once unpacked.
Result<Npz> ReadNpz(std::string_view bytes, const std::string& file);

/// Tells whether bytes begin as an .npy file does.
bool IsNpy(std::string_view bytes);
/// Reads an .npy file of plain numbers. Refused: others, and what ReadNpz refuses.
Result<NumberArray> ReadNpy(std::string_view bytes, const std::string& file);

/// Writes an .npz file, stored: numbers as 8-byte floats, and lists of texts in ASCII. The same bytes for the same
/// arrays.
std::string WriteNpz(const std::map<std::string, NumberArray>& numbers,
                     const std::map<std::string, std::vector<std::string>>& texts);

}  // namespace etude
