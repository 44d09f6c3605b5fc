#include "io/clips/assimp/own_keys.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "io/clips/fbx_preparation.h"
#include "io/clips/fbx_tree.h"

namespace etude {
namespace {

template <typename Number>
std::vector<double> NumbersIn(std::string_view bytes) {
  std::vector<double> numbers;
  for (; bytes.size() >= sizeof(Number); bytes.remove_prefix(sizeof(Number))) {
    Number number;
    std::memcpy(&number, bytes.data(), sizeof number);
    const auto value = static_cast<double>(number);
    numbers.push_back(std::isfinite(value) ? value : 0);
  }
  return numbers;
}

/// Reads a node's array of numbers. The times of a file are whole numbers below 2⁵³, so a double holds them exactly.
std::vector<double> ReadNumbers(std::string_view bytes, const FbxNode& node) {
  const auto array = FbxArrayOf(bytes, node);
  if (!array) {
    std::vector<double> numbers;
    for (const FbxNode& child : FbxChildren(bytes, node)) {
      for (const FbxValue& value : FbxValues(bytes, child)) numbers.push_back(FbxNumber(bytes, value));
    }
    return numbers;
  }
  constexpr std::uint64_t kMaxDeflateRatio = 1032;  // DEFLATE expands one byte to at most this many
  const bool is_wide = array->type == 'l' || array->type == 'd';
  std::string unpacked;
  std::string_view raw = array->bytes;
  if (array->is_deflated) {
    uLongf size =
        std::min<std::uint64_t>(std::uint64_t{array->count} * (is_wide ? 8 : 4), kMaxDeflateRatio * raw.size());
    unpacked.resize(size);
    const auto* from = reinterpret_cast<const Bytef*>(raw.data());
    if (uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &size, from, raw.size()) != Z_OK) return {};
    raw = std::string_view(unpacked).substr(0, size);
  }
  if (array->type == 'l') return NumbersIn<std::int64_t>(raw);
  if (array->type == 'i') return NumbersIn<std::int32_t>(raw);
  return array->type == 'd' ? NumbersIn<double>(raw) : NumbersIn<float>(raw);
}

/// A curve: the keys of one axis of one property.
struct Curve {
  std::vector<double> times_s, values;
  std::vector<std::int64_t> flags;  ///< KeyAttrFlags, one per key; empty if the file states none
};

Curve ReadCurve(std::string_view bytes, const FbxNode& node) {
  Curve curve;
  std::vector<double> flags, counts;
  for (const FbxNode& part : FbxChildren(bytes, node)) {
    if (part.name == "KeyTime") curve.times_s = ReadNumbers(bytes, part);
    if (part.name == "KeyValueFloat") curve.values = ReadNumbers(bytes, part);
    if (part.name == "KeyAttrFlags") flags = ReadNumbers(bytes, part);
    if (part.name == "KeyAttrRefCount") counts = ReadNumbers(bytes, part);
  }
  for (double& time : curve.times_s) time /= kFbxTicksPerSecond;
  curve.values.resize(curve.times_s.size());
  // Each flag holds for a number of keys.
  for (std::size_t i = 0; i < std::min(flags.size(), counts.size()); ++i) {
    constexpr double kMaxFlags = 1e9;
    const auto left = static_cast<double>(curve.times_s.size() - curve.flags.size());
    curve.flags.insert(curve.flags.end(), static_cast<std::size_t>(std::clamp(counts[i], 0.0, left)),
                       static_cast<std::int64_t>(std::clamp(flags[i], 0.0, kMaxFlags)));
  }
  return curve;
}

/// A clip: its name, and its time span by the file, seconds.
struct Stack {
  std::string name;
  bool has_span = false;  ///< false: assimp counts from the first key
  double start_s = 0, stop_s = 0;
  double first_s = std::numeric_limits<double>::infinity();  ///< the time of the first key
};

Stack ReadStack(std::string_view bytes, const FbxNode& node, std::string_view name,
                const std::vector<FbxProperty>& preset) {
  const std::vector<FbxProperty> properties = FbxProperties(bytes, node);
  const auto seconds = [&](std::string_view end) {
    return FbxNumberOf(bytes, properties, end, FbxNumberOf(bytes, preset, end, 0)) / kFbxTicksPerSecond;
  };
  const double start_s = seconds("LocalStart"), stop_s = seconds("LocalStop");
  return {.name = std::string(name), .has_span = start_s != 0 || stop_s != 0, .start_s = start_s, .stop_s = stop_s};
}

/// The property of a model that a curve moves, in a clip.
struct Target {
  std::string_view joint, property;
  std::int64_t stack = 0;
};

/// Sets the facts that depend on one curve. Two keys differ if they are farther apart than `same`, in the file's unit
/// or in degrees. Keys outside of the clip's time span do not count.
void Measure(const Curve& curve, const Stack& stack, double same, bool is_angle, FbxKeyFacts& facts) {
  constexpr std::int64_t kConstant = 2, kCubic = 8;
  constexpr double kHalfTurn_deg = 180, kMinSpan_s = 1e-6;
  const double begin = stack.start_s + kFbxMarginS, end = stack.stop_s - kFbxMarginS;
  const bool has_span = stack.has_span && end - begin > kMinSpan_s;
  for (std::size_t i = 0; i + 1 < curve.times_s.size(); ++i) {
    const double change = std::abs(curve.values[i + 1] - curve.values[i]);
    double from = curve.times_s[i], to = curve.times_s[i + 1];
    if (has_span) from = std::max(from, begin), to = std::min(to, end);
    const double gap = to - from;
    if (!(change > same) || !(gap > 0)) continue;
    const std::int64_t flags = i < curve.flags.size() ? curve.flags[i] : 0;
    if ((flags & kCubic) != 0) facts.longest_s = std::max(facts.longest_s, gap);
    if ((flags & kConstant) != 0) facts.step_s = std::max(facts.step_s, gap);
    if (is_angle && change >= kHalfTurn_deg && gap > kFbxNearKeys_s) facts.turn_deg = std::max(facts.turn_deg, change);
  }
}

/// The objects of a file that the curves need, by their numbers.
struct Objects {
  std::map<std::int64_t, FbxNode> curves;
  std::map<std::int64_t, Stack> stacks;
  std::map<std::int64_t, std::string_view> models;
  std::vector<FbxLink> links;
  double unit_cm = 1;
};

Objects ReadObjects(std::string_view bytes, FbxOwnKeys& own) {
  Objects objects;
  std::vector<FbxProperty> preset;
  for (const FbxNode& part : FbxTopNodes(bytes)) {
    if (part.name == "GlobalSettings") {
      objects.unit_cm = FbxNumberOf(bytes, FbxProperties(bytes, part), "UnitScaleFactor", 1);
    }
    if (part.name == "Definitions") preset = FbxTemplate(bytes, part, "FbxAnimStack");
    if (part.name == "Connections") objects.links = FbxLinks(bytes, part);
    if (part.name != "Objects") continue;
    for (const FbxNode& node : FbxChildren(bytes, part)) {
      const std::vector<FbxValue> values = FbxValues(bytes, node);
      if (values.empty()) continue;
      const std::int64_t id = FbxInteger(bytes, values.front());
      const std::string_view name = FbxNameOf(values);
      if (node.name == "AnimationCurve") objects.curves.emplace(id, node);
      if (node.name == "AnimationStack") objects.stacks[id] = ReadStack(bytes, node, name, preset);
      if (node.name == "Model") objects.models[id] = name;
      if (node.name == "Model" && values.size() > 2 && values[2].text == "LimbNode") own.limbs.emplace(name);
    }
  }
  return objects;
}

/// Finds what the curve nodes of a file move, by the numbers of these nodes.
std::multimap<std::int64_t, Target> FindTargets(const Objects& objects) {
  std::multimap<std::int64_t, std::int64_t> stacks_of;  // of layers, then of curve nodes
  for (const FbxLink& link : objects.links) {
    if (objects.stacks.contains(link.to)) stacks_of.emplace(link.from, link.to);
  }
  std::multimap<std::int64_t, std::int64_t> of_nodes;
  for (const FbxLink& link : objects.links) {
    const auto [first, last] = stacks_of.equal_range(link.to);
    for (auto layer = first; layer != last; ++layer) of_nodes.emplace(link.from, layer->second);
  }
  std::multimap<std::int64_t, Target> targets;
  for (const FbxLink& link : objects.links) {
    const auto model = objects.models.find(link.to);
    if (model == objects.models.end() || !link.property.starts_with("Lcl ")) continue;
    const auto [first, last] = of_nodes.equal_range(link.from);
    for (auto stack = first; stack != last; ++stack) {
      targets.emplace(link.from, Target{model->second, link.property, stack->second});
    }
  }
  return targets;
}

}  // namespace

FbxOwnKeys ReadOwnKeys(std::string_view bytes, FbxKeyFacts& facts) {
  FbxOwnKeys own;
  Objects objects = ReadObjects(bytes, own);
  const std::multimap<std::int64_t, Target> targets = FindTargets(objects);
  // Collect the times of all curves.
  for (const FbxLink& link : objects.links) {
    const auto node = objects.curves.find(link.from);
    const auto [first, last] = targets.equal_range(link.to);
    if (node == objects.curves.end() || first == last) continue;
    const Curve curve = ReadCurve(bytes, node->second);
    for (auto target = first; target != last; ++target) {
      const auto& [joint, property, stack_id] = target->second;
      Stack& stack = objects.stacks.at(stack_id);
      for (const std::string& name : {std::string(joint), std::string()}) {
        auto& times = own.times_s[{stack.name, name}];
        times.insert(times.end(), curve.times_s.begin(), curve.times_s.end());
      }
      if (!curve.times_s.empty()) stack.first_s = std::min(stack.first_s, curve.times_s.front());
      // A centimetre, a degree, or a hundredth of the size.
      const bool is_angle = property == "Lcl Rotation";
      const double same = is_angle ? 1 : property == "Lcl Scaling" ? 0.01 : 1 / objects.unit_cm;
      Measure(curve, stack, same, is_angle, facts);
    }
  }
  // Count them as assimp does.
  std::map<std::string, double> starts_s;
  for (const auto& [id, stack] : objects.stacks) starts_s[stack.name] = stack.has_span ? stack.start_s : stack.first_s;
  for (auto& [names, times] : own.times_s) {
    for (double& time : times) time -= starts_s[names.first];
    std::ranges::sort(times);
  }
  return own;
}

void TakeOutInserted(aiAnimation& animation, const FbxOwnKeys& own) {
  constexpr double kSame_s = 1e-6;
  const double rate = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1;
  const auto take_out = [&](const std::vector<double>& times, auto* keys, unsigned& count) {
    // Returns the file's first key that is not before this one.
    const auto after = [&](const auto& key) { return std::ranges::lower_bound(times, key.mTime / rate - kSame_s); };
    const auto is_own = [&](const auto& key) {
      const auto next = after(key);
      return next != times.end() && *next <= key.mTime / rate + kSame_s;
    };
    const auto is_inserted = [&](const auto& key) {
      const auto next = after(key);
      return !is_own(key) && next != times.begin() && next != times.end() && *next - *(next - 1) <= kFbxNearKeys_s;
    };
    // assimp inserts keys between two keys of the file. Other ends show that the times are counted in another way.
    if (count < 2 || !is_own(keys[0]) || !is_own(keys[count - 1])) return;
    count = static_cast<unsigned>(std::remove_if(keys, keys + count, is_inserted) - keys);
  };
  for (unsigned i = 0; i < animation.mNumChannels; ++i) {
    aiNodeAnim& moved = *animation.mChannels[i];
    const std::string name = moved.mNodeName.C_Str(), clip = animation.mName.C_Str();
    // assimp changes the second of two equal names.
    auto found = own.times_s.find({clip, name.substr(0, name.find("_$AssimpFbx$_"))});
    if (found == own.times_s.end()) found = own.times_s.find({clip, ""});
    if (found == own.times_s.end()) continue;
    take_out(found->second, moved.mPositionKeys, moved.mNumPositionKeys);
    take_out(found->second, moved.mRotationKeys, moved.mNumRotationKeys);
    take_out(found->second, moved.mScalingKeys, moved.mNumScalingKeys);
  }
}

}  // namespace etude
