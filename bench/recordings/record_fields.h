#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/result.h"
#include "io/files/json.h"

namespace etude {

/// Encodes one value of a recording as JSON. It is instantiated for booleans, numbers, texts, points (three numbers),
/// poses (sixty numbers), one number per feature (an object by FeatureName), lists of these, and optional values, which
/// are null if empty.
template <typename Value>
void EncodeValue(const Value& value, Json& json);

/// Reads JSON that EncodeValue wrote. An error message says which value was found and which values are allowed. The
/// message begins with a colon, or with the index of the faulty entry.
template <typename Value>
Result<void> DecodeValue(const Json& json, Value& value);

/// The keys of one JSON object of a recording. Each format is declared once, as a function `Describe(RecordFields&,
/// Record&)`. The function names every key, its member and its meaning, in the order of writing. It is used to write
/// and read records, and to make the reference page. Unknown keys are ignored on reading.
class RecordFields {
 public:
  template <typename Record>
  static std::string Write(Record record) {
    const JsonPtr json = NewObject();
    RecordFields fields(json.get(), nullptr, nullptr);
    Describe(fields, record);
    return TextOf(*json);
  }

  /// Reads a record. Error messages name the position within the JSON object: "events[2].score: \"high\" is not a
  /// number (the method's confidence that it was right)".
  template <typename Record>
  static Result<Record> Read(const std::string& text) {
    Record record;
    RETURN_IF_ERROR(ReadObject(text, [&](RecordFields& fields) { Describe(fields, record); }));
    return record;
  }

  /// Returns the keys of a record, and of its nested objects, as a Markdown list for the reference page.
  template <typename Record>
  static std::string Page() {
    std::string page;
    Record record;
    RecordFields fields(nullptr, nullptr, &page);
    Describe(fields, record);
    return page;
  }

  /// Declares the keys "format" and "version". On reading, they must have these values.
  void Format(std::string_view name, int version);

  /// Declares a required value and its key.
  template <typename Value>
  void Required(const char* key, Value& value, const char* meaning) {
    Document(key, meaning);
    if (written_ != nullptr) EncodeValue(value, Added(key));
    if (const Json* found = Find(key, /*must=*/true, meaning)) Note(key, DecodeValue(*found, value), meaning);
  }

  /// Declares an optional value. The key is absent if the member is nullopt.
  template <typename Value>
  void Optional(const char* key, std::optional<Value>& value, const char* meaning) {
    Document(key, meaning);
    if (written_ != nullptr && value) EncodeValue(*value, Added(key));
    if (const Json* found = Find(key)) Note(key, DecodeValue(*found, value.emplace()), meaning);
  }

  /// Declares a value whose member keeps its default if the key is absent or has a value of another type.
  template <typename Value>
  void Tolerated(const char* key, Value& value, const char* meaning) {
    Document(key, meaning);
    if (written_ != nullptr) EncodeValue(value, Added(key));
    Value read{};
    if (const Json* found = Find(key); found != nullptr && DecodeValue(*found, read)) value = std::move(read);
  }

  /// Declares a required list of objects, of lists of objects, or of values.
  template <typename Entry>
  void List(const char* key, std::vector<Entry>& entries, const char* meaning) {
    Document(key, meaning);
    if (written_ != nullptr) {
      Json& list = Added(key);
      WriteEntry(entries, list);
    }
    if (const Json* found = Find(key, /*must=*/true, meaning)) Note(key, ReadEntry(*found, entries), "");
    DocumentEntry<Entry>();
  }

  /// Declares an optional list. When a record is read, entries of a wrong type are left out.
  template <typename Entry>
  void ToleratedList(const char* key, std::vector<Entry>& entries, const char* meaning) {
    Document(key, meaning);
    if (written_ != nullptr) {
      Json& list = Added(key);
      WriteEntry(entries, list);
    }
    if (const Json* found = Find(key)) {
      const auto append = [&](const Json& json) {
        if (Entry entry{}; ReadEntry(json, entry)) entries.push_back(std::move(entry));
        return Result<void>();
      };
      [[maybe_unused]] const auto no_list = ReadEach(*found, append);
    }
    DocumentEntry<Entry>();
  }

 private:
  template <typename Type>
  struct IsList : std::false_type {};
  template <typename Entry>
  struct IsList<std::vector<Entry>> : std::true_type {};
  template <typename Type>
  static constexpr bool kIsRecord = requires(RecordFields& fields, Type& record) {
    Describe(fields, record);
  };

  RecordFields(Json* written, const Json* read, std::string* page) : written_(written), read_(read), page_(page) {}

  template <typename Entry>
  static void WriteEntry(Entry& entry, Json& json) {
    if constexpr (IsList<Entry>::value) {
      MakeList(json);
      for (auto& inner : entry) {
        Json& added = Append(json);
        WriteEntry(inner, added);
      }
    } else if constexpr (kIsRecord<Entry>) {
      RecordFields fields(&json, nullptr, nullptr);
      Describe(fields, entry);
    } else {
      EncodeValue(entry, json);
    }
  }

  template <typename Entry>
  static Result<void> ReadEntry(const Json& json, Entry& entry) {
    if constexpr (IsList<Entry>::value) {
      return ReadEach(json, [&](const Json& inner) { return ReadEntry(inner, entry.emplace_back()); });
    } else if constexpr (kIsRecord<Entry>) {
      RecordFields fields(nullptr, &json, nullptr);
      Describe(fields, entry);
      return fields.Finish();
    } else {
      return DecodeValue(json, entry);
    }
  }

  template <typename Entry>
  void DocumentEntry() {
    if (page_ == nullptr) return;
    if constexpr (IsList<Entry>::value) {
      DocumentEntry<typename Entry::value_type>();
    } else if constexpr (kIsRecord<Entry>) {
      RecordFields fields(nullptr, nullptr, page_);
      fields.depth_ = depth_ + 1;
      Entry entry;
      Describe(fields, entry);
    }
  }

  static JsonPtr NewObject();
  static std::string TextOf(const Json& json);
  static Result<void> ReadObject(const std::string& text, const std::function<void(RecordFields&)>& describe);
  static void MakeList(Json& json);
  static Json& Append(Json& list);
  static Result<void> ReadEach(const Json& list, const std::function<Result<void>(const Json&)>& read);

  Json& Added(const char* key);
  void Document(const char* key, const char* meaning);
  /// Returns the JSON value of a key if a record is being read, else null. If the key is missing and `must` is true,
  /// reports an error.
  const Json* Find(const char* key, bool must = false, const char* meaning = "");
  void Note(const char* key, const Result<void>& read, const char* meaning);
  Result<void> Finish();

  Json* written_;               ///< the JSON object, if a record is being written; else null
  const Json* read_;            ///< the JSON object, if a record is being read; else null
  std::string* page_;           ///< the reference page, if the format is being documented; else null
  int depth_ = 0;               ///< nesting depth of the current list on the reference page
  std::optional<Error> error_;  ///< the first error that occurred
};

}  // namespace etude
