#include "io/clips/fbx_rotations.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace etude {
namespace {

template <typename Number>
std::string NumberBytes(Number number) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return bytes;
}

std::string TextValue(const std::string& text) {
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

FbxWriter::Node Entry(const std::string& name, const std::vector<double>& numbers) {
  FbxWriter::Node node{"P", TextValue(name) + TextValue("Vector3D") + TextValue("Vector") + TextValue(""), 4};
  for (const double number : numbers) node.properties += "D" + NumberBytes(number);
  return node;
}
FbxWriter::Node Entry(const std::string& name, std::int32_t number) {
  return {"P", TextValue(name) + TextValue("int") + TextValue("") + TextValue("") + "I" + NumberBytes(number), 5};
}

/// Returns a file of three models. The middle one states `active`; `pre` is its PreRotation. The first one states
/// nothing, so the template's `by_template` holds; `first` is its PreRotation.
std::string Models(std::uint32_t version, std::int32_t active, const std::vector<double>& pre, std::int32_t order,
                   std::int32_t by_template = 1, const std::vector<double>& first = {0, 90, 0}) {
  const auto model = [](std::vector<FbxWriter::Node> entries) {
    return FbxWriter::Node{
        "Model",
        "L" + NumberBytes(std::int64_t{7}) + TextValue("Arm") + TextValue("LimbNode"),
        3,
        {{"Version", "I" + NumberBytes(std::int32_t{232}), 1}, {"Properties70", "", 0, std::move(entries)}}};
  };
  const std::vector<double> turn = {0, 90, 0};
  return FbxWriter(version).File(
      {{"Definitions",
        "",
        0,
        {{"Count", "I" + NumberBytes(std::int32_t{1}), 1},
         {"ObjectType",
          TextValue("Model"),
          1,
          {{"PropertyTemplate",
            TextValue("FbxNode"),
            1,
            {{"Properties70", "", 0, {Entry("RotationActive", by_template)}}}}}}}},
       {"Objects",
        "",
        0,
        {model({Entry("PreRotation", first)}),
         model({Entry("PreRotation", pre), Entry("RotationActive", active), Entry("RotationOrder", order),
                Entry("Lcl Rotation", turn)}),
         model({Entry("RotationActive", 1), Entry("PreRotation", turn), Entry("PostRotation", turn)})}}});
}

TEST(FbxRotations, AreZeroInBinaryFilesWhereTheyAreNotActive) {
  for (const std::uint32_t version : {7400u, 7700u}) {
    std::string changed;
    EXPECT_EQ(LeaveOutInactiveRotations(Models(version, 0, {10, 20, -30}, 5), changed), 1u);
    EXPECT_TRUE(changed == Models(version, 0, {0, 0, 0}, 0)) << version;
    EXPECT_EQ(LeaveOutInactiveRotations(Models(version, 1, {10, 20, -30}, 5), changed), 0u) << "the control";
    EXPECT_EQ(changed, "");
    EXPECT_EQ(LeaveOutInactiveRotations(Models(version, 0, {0, 0, 0}, 0), changed), 0u) << "nothing to leave out";
    EXPECT_EQ(LeaveOutInactiveRotations(Models(version, 1, {10, 20, -30}, 5, 0), changed), 1u) << "by the template";
    EXPECT_TRUE(changed == Models(version, 1, {10, 20, -30}, 5, 0, {0, 0, 0})) << version;
  }
}

TEST(FbxRotations, AreZeroInTextWhereTheyAreNotActive) {
  const auto told = [](int active) {
    return fmt::format("\t\t\tP: \"RotationActive\", \"bool\", \"\", \"\",{}\n", active);
  };
  const auto text = [](const std::string& by_template, const std::string& active, const char* pre, int order) {
    return fmt::format(
        "; FBX 7.4.0 project file\nDefinitions: {{\n\tObjectType: \"Model\" {{\n\t\tPropertyTemplate: \"FbxNode\" {{\n"
        "\t\tProperties70: {{\n{}\t\t}}\n\t}}\n\t}}\n}}\nObjects: {{\n\tModel: 7, \"Model::Arm\", \"LimbNode\" {{\n"
        "\t\tProperties70: {{\n\t\t\tP: \"PreRotation\", \"Vector3D\", \"Vector\", \"\",{}\n{}\t\t\tP: "
        "\"RotationOrder\", \"enum\", \"\", \"\",{}\n\t\t\tP: \"Lcl Rotation\", \"Lcl Rotation\", \"\", "
        "\"A\",1,2,3\n\t\t}}\n\t}}\n}}\n",
        by_template, pre, active, order);
  };
  std::string changed;
  // The model's own value counts; without it, the template's; without both, rotations are inactive, as in the FBX SDK.
  for (const auto& [by_template, active] : {std::pair(told(1), told(0)), {told(0), ""}, {"", ""}, {"", told(0)}}) {
    EXPECT_EQ(LeaveOutInactiveRotations(text(by_template, active, "0,90,0", 5), changed), 1u) << by_template << active;
    EXPECT_EQ(changed, text(by_template, active, "0,0,0", 0));
  }
  for (const auto& [by_template, active] : {std::pair(told(0), told(1)), {told(1), ""}, {"", told(1)}}) {
    EXPECT_EQ(LeaveOutInactiveRotations(text(by_template, active, "0,90,0", 5), changed), 0u) << by_template << active;
    EXPECT_EQ(changed, "");
  }
}

TEST(FbxRotations, OfDamagedFilesAreReadWithinTheirBytes) {
  const std::string good = Models(7400, 0, {10, 20, -30}, 5);
  std::string changed;
  for (std::size_t at = 0; at < good.size(); ++at) {
    LeaveOutInactiveRotations(std::string_view(good).substr(0, at), changed);
    for (const char value : {'\0', '\x7f', '\xff'}) {
      std::string bad = good;
      bad[at] = value;
      LeaveOutInactiveRotations(bad, changed);
      EXPECT_TRUE(changed.empty() || changed.size() == bad.size());
    }
  }
}

}  // namespace
}  // namespace etude
