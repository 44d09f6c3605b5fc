#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace etude {

template <typename Number>
std::string NumberBytes(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

inline std::string TextValue(const std::string& text) {
  return "S" + NumberBytes(static_cast<std::uint32_t>(text.size())) + text;
}

/// A second implementation that writes binary FBX nodes by the format's description.
class FbxWriter {
 public:
  explicit FbxWriter(std::uint32_t version) : version_(version) {}

  struct Node {
    std::string name, properties;
    std::uint64_t count = 0;
    std::vector<Node> children = {};
  };

  std::string File(const std::vector<Node>& nodes) const {
    std::string bytes("Kaydara FBX Binary  \0\x1a\0", 23);
    bytes += NumberBytes(version_);
    for (const Node& node : nodes) bytes += Record(node, bytes.size());
    return bytes + std::string(Null(), '\0');
  }

 private:
  std::size_t Null() const { return version_ >= 7500 ? 25 : 13; }
  std::string Offset(std::uint64_t offset) const {
    return version_ >= 7500 ? NumberBytes(offset) : NumberBytes(static_cast<std::uint32_t>(offset));
  }
  std::string Record(const Node& node, std::size_t at) const {
    const std::size_t head = Null() + node.name.size();
    std::string body = node.properties;
    for (const Node& child : node.children) body += Record(child, at + head + body.size());
    if (!node.children.empty()) body += std::string(Null(), '\0');
    return Offset(at + head + body.size()) + Offset(node.count) + Offset(node.properties.size()) +
           static_cast<char>(node.name.size()) + node.name + body;
  }

  std::uint32_t version_;
};

inline FbxWriter::Node Entry(const std::string& name, const std::vector<double>& numbers) {
  FbxWriter::Node node{"P", TextValue(name) + TextValue("Vector3D") + TextValue("Vector") + TextValue(""), 4};
  for (const double number : numbers) node.properties += "D" + NumberBytes(number);
  return node;
}
inline FbxWriter::Node Entry(const std::string& name, std::int32_t number) {
  return {"P", TextValue(name) + TextValue("int") + TextValue("") + TextValue("") + "I" + NumberBytes(number), 5};
}
inline FbxWriter::Node Entry(const std::string& name, std::int64_t number) {
  return {"P", TextValue(name) + TextValue("KTime") + TextValue("Time") + TextValue("") + "L" + NumberBytes(number), 5};
}

}  // namespace etude
