#include "io/clips/fbx_preparation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "engine/base/names.h"
#include "io/clips/fbx_tree.h"

namespace etude {
namespace {

constexpr std::array<std::string_view, 3> kIgnored = {"PreRotation", "PostRotation", "RotationOrder"};
constexpr std::string_view kActive = "RotationActive";

bool IsIgnored(std::string_view name) { return std::ranges::find(kIgnored, name) != kIgnored.end(); }

bool IsZero(std::string_view bytes, const FbxProperty& property) {
  return std::ranges::all_of(property.numbers, [&](const FbxValue& number) { return FbxNumber(bytes, number) == 0; });
}

constexpr auto kMarginTicks = static_cast<std::int64_t>(kFbxMarginS * kFbxTicksPerSecond);
constexpr std::string_view kStart = "LocalStart", kStop = "LocalStop";

struct Layer {
  std::string_view name;
  bool is_muted = false, is_solo = false, overrides = false;
  double weight = 100;
};

/// The objects of a file, by their numbers.
struct Objects {
  std::set<std::int64_t> stacks, curves;
  std::set<std::int64_t> joints;  ///< models other than meshes, cameras and lights
  std::map<std::int64_t, Layer> layers;
  std::map<std::int64_t, std::string_view> names;
};

Layer ReadLayer(std::string_view bytes, const FbxNode& node, std::string_view name) {
  constexpr double kOverride = 1, kOverridePassThrough = 2;
  const std::vector<FbxProperty> properties = FbxProperties(bytes, node);
  const double mode = FbxNumberOf(bytes, properties, "BlendMode", 0);
  return {.name = name,
          .is_muted = FbxNumberOf(bytes, properties, "Mute", 0) != 0,
          .is_solo = FbxNumberOf(bytes, properties, "Solo", 0) != 0,
          .overrides = mode == kOverride || mode == kOverridePassThrough,
          .weight = FbxNumberOf(bytes, properties, "Weight", 100)};
}

Objects ReadObjects(std::string_view bytes, const FbxNode& part) {
  constexpr std::array<std::string_view, 4> kThings = {"Mesh", "Camera", "CameraSwitcher", "Light"};
  Objects objects;
  for (const FbxNode& node : FbxChildren(bytes, part)) {
    const std::vector<FbxValue> values = FbxValues(bytes, node);
    if (values.empty()) continue;
    const std::int64_t id = FbxInteger(bytes, values.front());
    objects.names[id] = FbxNameOf(values);
    if (node.name == "AnimationStack") objects.stacks.insert(id);
    if (node.name == "AnimationCurve") objects.curves.insert(id);
    if (node.name == "AnimationLayer") objects.layers[id] = ReadLayer(bytes, node, objects.names[id]);
    const std::string_view kind = values.size() > 2 ? values[2].text : "";
    if (node.name == "Model" && std::ranges::find(kThings, kind) == kThings.end()) objects.joints.insert(id);
  }
  return objects;
}

/// Finds the layers whose curves move joints, and removes the constant weight of layers whose weight has a curve.
std::set<std::int64_t> LayersOfJoints(const std::vector<FbxLink>& links, Objects& objects) {
  std::set<std::int64_t> with_curves, of_joints, layers;
  for (const FbxLink& link : links) {
    if (objects.curves.contains(link.from)) with_curves.insert(link.to);
  }
  for (const FbxLink& link : links) {
    const bool is_curve = with_curves.contains(link.from) || objects.curves.contains(link.from);
    if (!is_curve) continue;
    if (objects.joints.contains(link.to) && link.property.starts_with("Lcl ")) of_joints.insert(link.from);
    // A curve of the weight: the weight is neither always 0 nor always full.
    const auto layer = objects.layers.find(link.to);
    if (layer != objects.layers.end() && link.property == "Weight") layer->second.weight = 50;
  }
  for (const FbxLink& link : links) {
    if (of_joints.contains(link.from) && objects.layers.contains(link.to)) layers.insert(link.to);
  }
  return layers;
}

/// Takes the layers of one animation that assimp must not merge out of the animation; returns a remark about layers
/// that would change the motion, or "".
std::string UseBaseLayer(std::string_view clip, const std::vector<const FbxLink*>& to_stack, const Objects& objects,
                         const std::set<std::int64_t>& of_joints, FbxEdits& edits) {
  constexpr std::int64_t kRoot = 0;  // the scene's root, where an animation layer has no meaning
  const auto layer_of = [&](const FbxLink* link) -> const Layer& { return objects.layers.at(link->from); };
  const bool has_solo = std::ranges::any_of(to_stack, [&](const FbxLink* link) { return layer_of(link).is_solo; });
  std::optional<std::string_view> used;
  std::vector<std::string> left_out;
  bool is_alone = false;
  for (const FbxLink* link : to_stack) {
    const Layer& layer = layer_of(link);
    const bool is_base = link == to_stack.front();
    const bool is_full = layer.overrides && layer.weight >= 100;
    const bool is_silent = layer.is_muted || (has_solo && !layer.is_solo) || (!is_base && layer.weight == 0);
    if (!is_silent && !of_joints.contains(link->from)) continue;
    if (!is_silent && !used) {
      used = layer.name;
      is_alone = !is_base && !is_full;
    } else if (is_silent || !is_full) {
      edits.Set(link->to_value, kRoot);
      if (!is_silent) left_out.push_back(Quote(layer.name));
    }
  }
  if (left_out.empty() && !is_alone) return "";
  if (left_out.empty()) {
    return fmt::format("clip {}: Etude uses only the animation layer {}", Quote(clip), Quote(*used));
  }
  return fmt::format(
      "clip {}: Etude uses only the animation layer {} and leaves out the other layers ({}); bake the layers into one",
      Quote(clip), Quote(*used), Join(left_out));
}

/// Returns true if a time span's end can be a time: it is nearer than the margin.
bool IsTime(std::int64_t ticks) { return ticks > -kMarginTicks && ticks < kMarginTicks; }

void Widen(std::string_view bytes, const std::vector<FbxProperty>& properties, FbxEdits& edits) {
  const auto value_of = [&](std::string_view name) -> const FbxValue* {
    const auto found = std::ranges::find(properties, name, &FbxProperty::name);
    return found == properties.end() || found->numbers.empty() ? nullptr : &found->numbers.front();
  };
  const FbxValue *start = value_of(kStart), *stop = value_of(kStop);
  // An end beyond all times means "no span", as do two ends at 0.
  const auto ticks = [&](const FbxValue* value) { return value == nullptr ? 0 : FbxInteger(bytes, *value); };
  const bool is_span = IsTime(ticks(start)) && IsTime(ticks(stop));
  if (start != nullptr) edits.Set(*start, (is_span ? ticks(start) : 0) - kMarginTicks);
  if (stop != nullptr) edits.Set(*stop, (is_span ? ticks(stop) : 0) + kMarginTicks);
}

bool HasSpan(const std::vector<FbxProperty>& properties) {
  const auto has = [&](std::string_view name) {
    return std::ranges::find(properties, name, &FbxProperty::name) != properties.end();
  };
  return has(kStart) && has(kStop);
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

std::vector<std::string> PrepareTakes(std::string_view bytes, std::string& changed) {
  FbxEdits edits(bytes);
  Objects objects;
  std::vector<FbxLink> links;
  bool has_template = false;
  for (const FbxNode& part : FbxTopNodes(bytes)) {
    if (part.name == "Definitions") {
      // Objects without a time span of their own inherit the template's.
      const std::vector<FbxProperty> preset = FbxTemplate(bytes, part, "FbxAnimStack");
      has_template = HasSpan(preset);
      if (has_template) Widen(bytes, preset, edits);
    }
    if (part.name == "Objects") {
      objects = ReadObjects(bytes, part);
      for (const FbxNode& node : FbxChildren(bytes, part)) {
        if (node.name != "AnimationStack") continue;
        const std::vector<FbxProperty> properties = FbxProperties(bytes, node);
        if (has_template || HasSpan(properties)) Widen(bytes, properties, edits);
      }
    }
    if (part.name == "Connections") links = FbxLinks(bytes, part);
  }
  const std::set<std::int64_t> of_joints = LayersOfJoints(links, objects);
  std::map<std::int64_t, std::vector<const FbxLink*>> to_stacks;
  for (const FbxLink& link : links) {
    const bool is_layer = link.property.empty() && objects.layers.contains(link.from);
    if (is_layer && objects.stacks.contains(link.to)) to_stacks[link.to].push_back(&link);
  }
  std::vector<std::string> remarks;
  for (const auto& [stack, to_stack] : to_stacks) {
    if (to_stack.size() < 2) continue;
    std::string remark = UseBaseLayer(objects.names[stack], to_stack, objects, of_joints, edits);
    if (!remark.empty()) remarks.push_back(std::move(remark));
  }
  changed = edits.Apply();
  return remarks;
}

std::string DoubtOfScales(std::string_view bytes) {
  constexpr double kNoInheritance = 2, kSame = 1e-3;
  std::set<std::int64_t> scaled, without;
  std::map<std::int64_t, std::string_view> names;
  std::vector<FbxLink> links;
  double by_template = 0;
  for (const FbxNode& part : FbxTopNodes(bytes)) {
    if (part.name == "Definitions") {
      by_template = FbxNumberOf(bytes, FbxTemplate(bytes, part, "FbxNode"), "InheritType", 0);
    }
    if (part.name == "Connections") links = FbxLinks(bytes, part);
    if (part.name != "Objects") continue;
    const Objects objects = ReadObjects(bytes, part);
    names = objects.names;
    for (const FbxNode& node : FbxChildren(bytes, part)) {
      const std::vector<FbxValue> values = FbxValues(bytes, node);
      const std::int64_t id = values.empty() ? 0 : FbxInteger(bytes, values.front());
      if (node.name != "Model" || !objects.joints.contains(id)) continue;
      const std::vector<FbxProperty> properties = FbxProperties(bytes, node);
      if (FbxNumberOf(bytes, properties, "InheritType", by_template) == kNoInheritance) without.insert(id);
      const auto scale = std::ranges::find(properties, "Lcl Scaling", &FbxProperty::name);
      if (scale == properties.end()) continue;
      for (const FbxValue& factor : scale->numbers) {
        if (std::abs(FbxNumber(bytes, factor) - 1) > kSame) scaled.insert(id);
      }
    }
  }
  for (const FbxLink& link : links) {
    if (!link.property.empty() || !without.contains(link.from) || !scaled.contains(link.to)) continue;
    return fmt::format(
        "joint {} should not inherit the scale of its parent {} (InheritType 2), but Etude lets it inherit this scale, "
        "so limbs below the joint may have wrong lengths; freeze the scales, then export again",
        Quote(names[link.from]), Quote(names[link.to]));
  }
  return "";
}

}  // namespace etude
