#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace etude {

/// The unit of times in FBX files.
inline constexpr double kFbxTicksPerSecond = 46'186'158'000;

/// A range of the file's bytes.
struct FbxRange {
  std::size_t begin = 0, end = 0;
};

/// A value of a node: a number or a text. Arrays are left out.
struct FbxValue {
  FbxRange range;              ///< the bytes or digits of a number
  char type = 0;               ///< the type of a number in a binary file; 0 in a text file
  bool is_text = false;        ///< true for a text
  std::string_view text = "";  ///< the characters of a text
};

/// A node of an FBX file of version 7, binary or text: its name, values and children.
struct FbxNode {
  std::string_view name;
  FbxRange values, children;
};

/// A property of an object: the name, and the numbers.
struct FbxProperty {
  std::string_view name;
  std::vector<FbxValue> numbers;
};

/// Reads the nodes of the highest level. Here and below, a node whose end lies outside its parent ends the level.
std::vector<FbxNode> FbxTopNodes(std::string_view bytes);

/// Reads the children of a node.
std::vector<FbxNode> FbxChildren(std::string_view bytes, const FbxNode& node);

/// Reads the values of a node; an array ends them.
std::vector<FbxValue> FbxValues(std::string_view bytes, const FbxNode& node);

/// Returns a number; 0 if the value is none.
double FbxNumber(std::string_view bytes, const FbxValue& value);
std::int64_t FbxInteger(std::string_view bytes, const FbxValue& value);

/// Reads an object's table of properties (Properties70).
std::vector<FbxProperty> FbxProperties(std::string_view bytes, const FbxNode& node);

/// Reads the properties of a template ("FbxNode", "FbxAnimStack"), whose values hold where an object states none.
/// `definitions` is the node Definitions.
std::vector<FbxProperty> FbxTemplate(std::string_view bytes, const FbxNode& definitions, std::string_view name);

/// Returns the first number of a property, or `otherwise`.
double FbxNumberOf(std::string_view bytes, const std::vector<FbxProperty>& properties, std::string_view name,
                   double otherwise);

/// A connection from one object to another object, or to a property of this object.
struct FbxLink {
  std::int64_t from = 0, to = 0;
  std::string_view property;  ///< "" for the object itself
  FbxValue to_value;
};

/// Reads the connections of the node Connections.
std::vector<FbxLink> FbxLinks(std::string_view bytes, const FbxNode& connections);

/// The array of a node in a binary file, as it is stored.
struct FbxArray {
  char type = 0;  ///< 'b', 'i', 'l', 'f' or 'd'
  std::uint32_t count = 0;
  bool is_deflated = false;
  std::string_view bytes;
};

/// Finds the array that a node of a binary file begins with; nullopt if it begins with another value. The array of a
/// text file is the values of its child "a".
std::optional<FbxArray> FbxArrayOf(std::string_view bytes, const FbxNode& node);

/// Returns the name of an object, whose values are `values`: "Hips" for "Model::Hips"; "" if it has none.
std::string_view FbxNameOf(const std::vector<FbxValue>& values);

/// New values for numbers of a file.
class FbxEdits {
 public:
  explicit FbxEdits(std::string_view bytes) : bytes_(bytes) {}
  /// Replaces a number, in its own type; a text stays as it is.
  void Set(const FbxValue& value, std::int64_t number);
  /// Returns the whole file with the new values; "" if there are none.
  std::string Apply();

 private:
  std::string_view bytes_;
  std::vector<std::pair<FbxRange, std::string>> edits_;
};

}  // namespace etude
