#include "engine/formats/bvh_hierarchy.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "engine/base/names.h"
#include "engine/formats/unique_names.h"

namespace etude {
namespace {

constexpr int kDeepestNesting = 128;
constexpr std::size_t kMostJoints = 1024;
constexpr std::size_t kLongestName = 500;
constexpr int kMostChannels = 6;

constexpr std::array<std::string_view, kMostChannels> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                                       "Xrotation", "Yrotation", "Zrotation"};

char Lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

class HierarchyReader {
 public:
  explicit HierarchyReader(TextScanner& scanner) : scanner_(scanner) {}

  Result<BvhHierarchy> Read() {
    RETURN_IF_ERROR(Expect("HIERARCHY"));
    RETURN_IF_ERROR(Expect("ROOT"));
    RETURN_IF_ERROR(ReadJoint(-1, 1));
    const Token after = scanner_.Next();
    if (SameWord(after.text, "ROOT")) {
      return Fail(scanner_.At(after), "found a second ROOT; allowed: one skeleton per file");
    }
    if (!SameWord(after.text, "MOTION")) return Unexpected(after, "MOTION after the root's closing '}'");
    if (hierarchy_.channels.empty()) {
      return Fail(scanner_.At(after), "no joint has channels; at least one is needed");
    }
    return std::move(hierarchy_);
  }

 private:
  tl::unexpected<Error> Unexpected(const Token& token, std::string_view allowed) const {
    return Fail(scanner_.At(token), "found {}; expected {}", Quote(token.text), allowed);
  }

  Result<void> Expect(std::string_view word) {
    const Token token = scanner_.Next();
    if (!SameWord(token.text, word)) return Unexpected(token, word);
    return {};
  }

  /// A joint's name and its block; `parent` is −1 for the root.
  Result<void> ReadJoint(int parent, int depth) {
    const Token name = scanner_.NameInLine();
    if (name.text.empty()) return Unexpected(name, "a joint's name");
    if (name.text.size() > kLongestName) {
      return Fail(scanner_.At(name), "a joint's name of {} bytes; allowed: {}", name.text.size(), kLongestName);
    }
    ASSIGN_OR_RETURN(auto index, AddJoint(std::string(name.text), parent, name, depth));
    RETURN_IF_ERROR(Expect("{"));

    bool has_offset = false;
    bool has_channels = false;
    bool has_children = false;
    for (;;) {
      const Token token = scanner_.Next();
      Result<void> ok;
      if (token.text == "}") {
        if (!has_offset) return Unexpected(token, "OFFSET: every joint has one");
        return {};
      } else if (SameWord(token.text, "OFFSET") && !has_offset) {
        has_offset = true;
        ok = ReadOffset(index);
      } else if (SameWord(token.text, "CHANNELS") && !has_channels && !has_children) {
        has_channels = true;
        ok = ReadChannels(index);
      } else if (SameWord(token.text, "JOINT")) {
        has_children = true;
        ok = ReadJoint(index, depth + 1);
      } else if (SameWord(token.text, "End")) {
        has_children = true;
        ok = ReadEndSite(index, token, depth + 1);
      } else {
        return Unexpected(token, "OFFSET and CHANNELS (once each, before any child), JOINT, End Site or '}'");
      }
      if (!ok) return ok;
    }
  }

  Result<void> ReadEndSite(int parent, const Token& start, int depth) {
    RETURN_IF_ERROR(Expect("Site"));
    scanner_.NameInLine();  // some exporters name the site; nobody reads it
    ASSIGN_OR_RETURN(auto index, AddJoint(hierarchy_.skeleton.joints[parent].name + "_End", parent, start, depth));
    hierarchy_.skeleton.joints[index].is_end_site = true;
    RETURN_IF_ERROR(Expect("{"));
    RETURN_IF_ERROR(Expect("OFFSET"));
    RETURN_IF_ERROR(ReadOffset(index));
    return Expect("}");
  }

  Result<int> AddJoint(const std::string& name, int parent, const Token& place, int depth) {
    auto& joints = hierarchy_.skeleton.joints;
    if (depth > kDeepestNesting) {
      return Fail(scanner_.At(place), "joints nested deeper than {} levels", kDeepestNesting);
    }
    if (joints.size() >= kMostJoints) {
      return Fail(scanner_.At(place), "more than {} joints and end sites", kMostJoints);
    }
    joints.push_back({.name = names_.Add(name), .parent = parent, .rest = {}});
    return static_cast<int>(joints.size()) - 1;
  }

  Result<void> ReadOffset(int joint) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSIGN_OR_RETURN(auto value, scanner_.Number(scanner_.Next(), "one of an OFFSET's three numbers"));
      hierarchy_.skeleton.joints[joint].rest.translation[axis] = value;
    }
    return {};
  }

  Result<void> ReadChannels(int joint) {
    const Token count_token = scanner_.Next();
    ASSIGN_OR_RETURN(auto count, scanner_.Number(count_token, "the number of channels"));
    if (count < 0 || count > kMostChannels || count != static_cast<int>(count)) {
      return Fail(scanner_.At(count_token), "found {} channels; allowed: a whole number from 0 to {}",
                  Quote(count_token.text), kMostChannels);
    }
    std::array<bool, kMostChannels> seen{};
    for (int i = 0; i < count; ++i) {
      const Token token = scanner_.Next();
      const auto known =
          std::ranges::find_if(kChannelNames, [&](std::string_view name) { return SameWord(name, token.text); });
      if (known == kChannelNames.end()) {
        return Unexpected(token, fmt::format("{} channels out of {}", count, fmt::join(kChannelNames, ", ")));
      }
      const int kind = static_cast<int>(known - kChannelNames.begin());
      if (seen[kind]) return Fail(scanner_.At(token), "channel {} stands twice in one joint", *known);
      seen[kind] = true;
      hierarchy_.channels.push_back({.joint = joint, .is_rotation = kind >= 3, .axis = kind % 3});
    }
    return {};
  }

  TextScanner& scanner_;
  BvhHierarchy hierarchy_;
  UniqueNames names_;
};

}  // namespace

bool SameWord(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return Lower(x) == Lower(y); });
}

Result<BvhHierarchy> ReadBvhHierarchy(TextScanner& scanner) { return HierarchyReader(scanner).Read(); }

}  // namespace etude
