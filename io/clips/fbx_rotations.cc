#include "io/clips/fbx_rotations.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "io/clips/fbx_tree.h"

namespace etude {
namespace {

constexpr std::array<std::string_view, 3> kIgnored = {"PreRotation", "PostRotation", "RotationOrder"};
constexpr std::string_view kActive = "RotationActive";

bool IsIgnored(std::string_view name) { return std::ranges::find(kIgnored, name) != kIgnored.end(); }

bool IsZero(std::string_view bytes, const FbxProperty& property) {
  return std::ranges::all_of(property.numbers, [&](const FbxValue& number) { return FbxNumber(bytes, number) == 0; });
}

}  // namespace

std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed) {
  std::size_t models = 0;
  bool active_by_template = false;
  FbxEdits edits(bytes);
  for (const FbxNode& part : FbxTopNodes(bytes)) {
    if (part.name == "Definitions") {
      for (const FbxProperty& property : FbxTemplate(bytes, part, "FbxNode")) {
        if (property.name == kActive) active_by_template = !IsZero(bytes, property);
      }
    }
    if (part.name != "Objects") continue;
    for (const FbxNode& model : FbxChildren(bytes, part)) {
      if (model.name != "Model") continue;
      // Collect the model's own properties.
      std::vector<FbxProperty> ignored;
      bool is_active = active_by_template;
      for (FbxProperty& property : FbxProperties(bytes, model)) {
        if (property.name == kActive) is_active = !IsZero(bytes, property);
        if (IsIgnored(property.name) && !IsZero(bytes, property)) ignored.push_back(std::move(property));
      }
      if (is_active || ignored.empty()) continue;
      for (const FbxProperty& property : ignored) {
        for (const FbxValue& number : property.numbers) edits.Set(number, 0);
      }
      ++models;
    }
  }
  changed = edits.Apply();
  return models;
}

}  // namespace etude
