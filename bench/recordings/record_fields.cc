#include "bench/recordings/record_fields.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>

#include "engine/fuzzy/distance.h"

namespace etude {
namespace {

/// A JSON type: a function that recognises it, and its name in error messages.
struct JsonKind {
  bool (Json::*is)() const noexcept;
  const char* complaint;
};
template <typename Value>
constexpr JsonKind kKind = {};
template <>
constexpr JsonKind kKind<bool> = {&Json::is_boolean, "is neither true nor false"};
template <>
constexpr JsonKind kKind<double> = {&Json::is_number, "is not a number"};
template <>
constexpr JsonKind kKind<std::int64_t> = {&Json::is_number_integer, "is not a whole number"};
template <>
constexpr JsonKind kKind<std::string> = {&Json::is_string, "is not a text"};

template <typename Value>
struct Codec {
  static_assert(kKind<Value>.complaint != nullptr);
  static void Encode(const Value& value, Json& json) { json = value; }
  static Result<void> Decode(const Json& json, Value& value) {
    if (!(json.*kKind<Value>.is)()) return Fail({}, ": {} {}", ShowJson(json), kKind<Value>.complaint);
    json.get_to(value);
    return {};
  }
};

template <>
struct Codec<int> {
  static void Encode(int value, Json& json) { json = value; }
  static Result<void> Decode(const Json& json, int& value) {
    // The largest allowed number; sums of a few such numbers fit into an int.
    constexpr std::int64_t kMaxMagnitude = 1'000'000'000;
    const auto whole = json.is_number_integer() ? json.get<std::int64_t>() : kMaxMagnitude + 1;
    if (whole < -kMaxMagnitude || whole > kMaxMagnitude) {
      return Fail({}, ": {} is not a whole number; allowed: {}…{}", ShowJson(json), -kMaxMagnitude, kMaxMagnitude);
    }
    value = static_cast<int>(whole);
    return {};
  }
};

Result<std::vector<double>> NumbersIn(const Json& json, std::size_t count) {
  std::vector<double> numbers;
  RETURN_IF_ERROR(DecodeValue(json, numbers));
  if (numbers.size() != count) return Fail({}, ": {} numbers; allowed: {}", numbers.size(), count);
  return numbers;
}

template <>
struct Codec<glm::dvec3> {
  static void Encode(const glm::dvec3& value, Json& json) { json = {value.x, value.y, value.z}; }
  static Result<void> Decode(const Json& json, glm::dvec3& value) {
    ASSIGN_OR_RETURN(const auto numbers, NumbersIn(json, 3));
    value = {numbers[0], numbers[1], numbers[2]};
    return {};
  }
};

template <>
struct Codec<BodyPose> {
  static void Encode(const BodyPose& pose, Json& json) {
    json = Json::array();
    for (const glm::dvec3& joint : pose.joints) {
      for (int axis = 0; axis < 3; ++axis) json.push_back(joint[axis]);
    }
  }
  static Result<void> Decode(const Json& json, BodyPose& pose) {
    ASSIGN_OR_RETURN(const auto numbers, NumbersIn(json, 3 * kRoleCount));
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      pose.joints[j] = {numbers[3 * j], numbers[3 * j + 1], numbers[3 * j + 2]};
    }
    return {};
  }
};

template <>
struct Codec<PerFeature> {
  static void Encode(const PerFeature& values, Json& json) {
    for (std::size_t k = 0; k < kFeatureCount; ++k) json[std::string(FeatureName(AllFeatures()[k]))] = values[k];
  }
  static Result<void> Decode(const Json& json, PerFeature& values) {
    if (!json.is_object()) return Fail({}, ": {} is not an object", ShowJson(json));
    for (std::size_t k = 0; k < kFeatureCount; ++k) {
      const std::string name(FeatureName(AllFeatures()[k]));
      const auto found = json.find(name);
      if (found == json.end() || !found->is_number()) return Fail({}, ".{}: a number is missing", name);
      values[k] = found->get<double>();
    }
    return {};
  }
};

template <typename Value>
struct Codec<std::vector<Value>> {
  static void Encode(const std::vector<Value>& values, Json& json) {
    json = Json::array();
    for (const Value& value : values) Codec<Value>::Encode(value, json.emplace_back());
  }
  static Result<void> Decode(const Json& json, std::vector<Value>& values) {
    if (!json.is_array()) return Fail({}, ": {} is not a list", ShowJson(json));
    values.clear();
    for (const Json& entry : json) {
      Value value{};
      if (auto read = Codec<Value>::Decode(entry, value); !read) {
        return Fail({}, "[{}]{}", values.size(), read.error().message);
      }
      values.push_back(std::move(value));
    }
    return {};
  }
};

template <typename Value>
struct Codec<std::optional<Value>> {
  static void Encode(const std::optional<Value>& value, Json& json) {
    json = nullptr;
    if (value) Codec<Value>::Encode(*value, json);
  }
  static Result<void> Decode(const Json& json, std::optional<Value>& value) {
    value.reset();
    return json.is_null() ? Result<void>() : Codec<Value>::Decode(json, value.emplace());
  }
};

}  // namespace

template <typename Value>
void EncodeValue(const Value& value, Json& json) {
  Codec<Value>::Encode(value, json);
}

template <typename Value>
Result<void> DecodeValue(const Json& json, Value& value) {
  return Codec<Value>::Decode(json, value);
}

#define ETUDE_RECORDED(...)                             \
  template void EncodeValue(const __VA_ARGS__&, Json&); \
  template Result<void> DecodeValue(const Json&, __VA_ARGS__&)
ETUDE_RECORDED(bool);
ETUDE_RECORDED(int);
ETUDE_RECORDED(double);
ETUDE_RECORDED(std::string);
ETUDE_RECORDED(BodyPose);
ETUDE_RECORDED(std::vector<double>);
ETUDE_RECORDED(std::vector<int>);
ETUDE_RECORDED(std::vector<std::optional<glm::dvec3>>);
ETUDE_RECORDED(std::optional<int>);
ETUDE_RECORDED(std::optional<std::int64_t>);
ETUDE_RECORDED(std::optional<double>);
ETUDE_RECORDED(std::optional<PerFeature>);
#undef ETUDE_RECORDED

void RecordFields::Format(std::string_view name, int version) {
  const auto constant = [&](const char* key, const Json& value) {
    Document(key, ("always " + value.dump()).c_str());
    if (written_ != nullptr) Added(key) = value;
    const Json* found = Find(key, /*must=*/true, "of the recording");
    if (found != nullptr && *found != value) {
      Note(key, Fail({}, ": {}; allowed: {}", ShowJson(*found), value.dump()),
           "the only version that this program reads");
    }
  };
  constant("format", name);
  constant("version", version);
}

JsonPtr RecordFields::NewObject() { return std::make_unique<Json>(Json::object()); }

std::string RecordFields::TextOf(const Json& json) { return json.dump(); }

Result<void> RecordFields::ReadObject(const std::string& text, const std::function<void(RecordFields&)>& describe) {
  const auto json = ReadJson(text, "");
  if (!json) return Fail({}, "not a JSON object: {}", json.error().message);
  if (!json->is_object()) return Fail({}, "not a JSON object but {}", ShowJson(*json));
  RecordFields fields(nullptr, &*json, nullptr);
  describe(fields);
  auto done = fields.Finish();
  if (!done) done.error().message.erase(0, 1);  // removes the dot before the first key
  return done;
}

void RecordFields::MakeList(Json& json) { json = Json::array(); }

Json& RecordFields::Append(Json& list) { return list.emplace_back(); }

Result<void> RecordFields::ReadEach(const Json& list, const std::function<Result<void>(const Json&)>& read) {
  if (!list.is_array()) return Fail({}, ": {} is not a list", ShowJson(list));
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (const auto done = read(list[i]); !done) return Fail({}, "[{}]{}", i, done.error().message);
  }
  return {};
}

Json& RecordFields::Added(const char* key) { return (*written_)[key]; }

void RecordFields::Document(const char* key, const char* meaning) {
  if (page_ != nullptr) *page_ += fmt::format("{:{}}- `{}`: {}\n", "", 2 * depth_, key, meaning);
}

const Json* RecordFields::Find(const char* key, bool must, const char* meaning) {
  if (read_ == nullptr) return nullptr;
  const auto found = read_->find(key);  // equals end() if `read_` is not an object
  if (found != read_->end()) return &*found;
  if (must) Note(key, Fail({}, ": it is missing"), meaning);
  return nullptr;
}

void RecordFields::Note(const char* key, const Result<void>& read, const char* meaning) {
  if (read || error_) return;
  error_ = Error{{}, fmt::format(".{}{}", key, read.error().message)};
  if (*meaning != '\0') error_->message += fmt::format(" ({})", meaning);
}

Result<void> RecordFields::Finish() {
  if (!read_->is_object()) return Fail({}, ": {} is not an object", ShowJson(*read_));
  if (error_) return tl::unexpected(*error_);
  return {};
}

}  // namespace etude
