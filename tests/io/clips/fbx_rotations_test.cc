#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/clips/fbx_preparation.h"
#include "tests/io/clips/fbx_writer.h"

namespace etude {
namespace {

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
