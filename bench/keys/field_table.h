#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/keys/key_info.h"
#include "engine/base/angles.h"
#include "engine/base/settings.h"
#include "engine/document/fields.h"

namespace etude {

/// Returns a function that accesses a nested member: `Path(&Method::filter, &FilterOptions::kind)(method)` is
/// `method.filter.kind`.
template <typename... Members>
constexpr auto Path(Members... members) {
  // clang-format off
  return [=](auto& options) -> auto& { return (options .* ... .* members); };
  // clang-format on
}

/// A list of values, each with the name by which files refer to it.
template <typename Value>
using NamedValues = std::vector<std::pair<std::string, Value>>;

// ReadNumber reads the value of `key` into a member that is a number. There is one overload for each type of member. An
// absent key leaves the value unchanged.
void ReadNumber(Fields& fields, const std::string& key, Range range, double& value);
void ReadNumber(Fields& fields, const std::string& key, Range range, int& value);
void ReadNumber(Fields& fields, const std::string& key, Range range, std::optional<double>& value);
void ReadNumber(Fields& fields, const std::string& key, Range range, std::optional<std::uint64_t>& value);
inline std::string DefaultText(double value) { return NumberText(value); }
template <typename Number>
std::string DefaultText(const std::optional<Number>&) {
  return "(none)";
}
inline std::string DegreesText(double radians) { return NumberText(Degrees(radians)); }
inline std::string DegreesText(const std::optional<double>&) { return "(none)"; }

void ReadNumbers(Fields& fields, const std::string& key, Count count, Range range, std::vector<double>& values);
/// Reads a list of names. An unknown name is an error in `fields`.
std::vector<std::string> ReadNames(Fields& fields, const std::string& key, const std::vector<std::string>& known);

/// Returns the items of the list at `key`; empty if the key is absent.
std::span<const Node> ReadItems(Fields& fields, const std::string& key);

/// A key of a mapping, and the member of `Options` into which the key's value is read. A key is declared once for the
/// reader, the reference page and the schema. A `member` is a pointer to member, or a Path to a nested member; its
/// value in `Options{}` is the default.
template <typename Options>
struct Field {
  KeyInfo info;
  std::function<void(Fields&, Options&)> read;

  /// Makes a field for a number: a double, an int, or a std::optional of a double or of a std::uint64_t. A member of an
  /// integer type accepts only integers.
  template <typename Member>
  static Field Number(const std::string& key, Member member, Range range, std::string meaning) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>;
    constexpr bool kWhole = std::is_same_v<Value, int> || std::is_same_v<Value, std::optional<std::uint64_t>>;
    return {{key, NumberKind(range, kWhole), DefaultText(Default(member)), std::move(meaning)},
            [=](Fields& fields, Options& options) { ReadNumber(fields, key, range, std::invoke(member, options)); }};
  }

  /// Makes a field for an angle: degrees in the file, radians in memory.
  template <typename Member>
  static Field Angle(const std::string& key, Member member, Range range, std::string meaning) {
    return {{key, NumberKind(range), DegreesText(Default(member)), std::move(meaning)},
            [=](Fields& fields, Options& options) {
              if (const auto degrees = fields.OptionalNumber(key, range)) {
                std::invoke(member, options) = Radians(*degrees);
              }
            }};
  }

  /// Makes a field for a list of `count` numbers. `allowed` describes the values to users.
  template <typename Member>
  static Field Numbers(const std::string& key, Member member, Count count, std::string allowed, Range range,
                       std::string meaning) {
    std::string fallback;
    const auto values = Default(member);
    for (double value : values) fallback += (fallback.empty() ? "" : ", ") + NumberText(value);
    return {{key, ListKind(std::move(allowed), NumberKind(range), count), "[" + fallback + "]", std::move(meaning)},
            [=](Fields& fields, Options& options) {
              ReadNumbers(fields, key, count, range, std::invoke(member, options));
            }};
  }

  template <typename Member>
  static Field Flag(const std::string& key, Member member, std::string meaning) {
    return {{key, FlagKind(), Default(member) ? "true" : "false", std::move(meaning)},
            [=](Fields& fields, Options& options) {
              bool& value = std::invoke(member, options);
              value = fields.Boolean(key, value);
            }};
  }

  /// Makes a field for a text without restrictions. `allowed` describes the text to users.
  template <typename Member>
  static Field Text(const std::string& key, Member member, std::string allowed, std::string meaning) {
    return {{key, TextKind(std::move(allowed)), Default(member), std::move(meaning)},
            [=](Fields& fields, Options& options) {
              std::string& value = std::invoke(member, options);
              value = fields.Text(key, value);
            }};
  }

  template <typename Member>
  static Field Texts(const std::string& key, Member member, std::string allowed, std::string meaning) {
    return {{key, ListKind(std::move(allowed), TextKind("")), "[]", std::move(meaning)},
            [=](Fields& fields, Options& options) { std::invoke(member, options) = fields.Texts(key); }};
  }

  /// Makes a field for a value that is chosen by its name from a list.
  template <typename Member, typename Value = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>>
  static Field Name(const std::string& key, Member member, const NamedValues<Value>& values, std::string meaning) {
    std::vector<std::string> names;
    std::string fallback;
    for (const auto& [name, value] : values) {
      names.push_back(name);
      if (value == Default(member)) fallback = name;
    }
    return {{key, NameKind(names), fallback, std::move(meaning)}, [=](Fields& fields, Options& options) {
              const std::string chosen = fields.Choice(key, names, "");
              for (const auto& [name, value] : values) {
                if (name == chosen) std::invoke(member, options) = value;
              }
            }};
  }

  /// Makes a field for a value that is chosen by its name. `find` returns the value of a name, or a pointer to it.
  template <typename Member, typename Find>
  static Field Name(const std::string& key, Member member, const std::vector<std::string>& names, Find find,
                    std::string meaning) {
    using Value = std::remove_cvref_t<std::invoke_result_t<Member, Options&>>;
    NamedValues<Value> values;
    for (const std::string& name : names) {
      if constexpr (std::is_convertible_v<decltype(find(name)), Value>) {
        values.emplace_back(name, find(name));
      } else {
        values.emplace_back(name, *find(name));
      }
    }
    return Name(key, member, values, std::move(meaning));
  }

  /// Makes a field for a list of names. Each name sets one bool of `Options`.
  static Field Flags(const std::string& key, const NamedValues<std::function<bool&(Options&)>>& flags,
                     std::string meaning) {
    std::vector<std::string> names;
    for (const auto& flag : flags) names.push_back(flag.first);
    const ValueKind item = NameKind(names);
    return {{key, ListKind("a list of: " + item.allowed, item), "[]", std::move(meaning)},
            [=](Fields& fields, Options& options) {
              for (const std::string& chosen : ReadNames(fields, key, names)) {
                for (const auto& [name, flag] : flags) {
                  if (name == chosen) flag(options) = true;
                }
              }
            }};
  }

  /// Adds the unit of the values. It is needed only if the key's name does not state the whole unit.
  Field Unit(const std::string& unit) const {
    Field field = *this;
    field.info.value.allowed += " (" + unit + ")";
    return field;
  }
  /// Adds a remark to the description of the allowed values.
  Field And(const std::string& words) const {
    Field field = *this;
    field.info.value.allowed += "; " + words;
    return field;
  }
  /// Sets the text that the reference page shows for an absent key, if the default is not a value, e.g. "(the
  /// scenario's)".
  Field WhenAbsent(const std::string& words) const {
    Field field = *this;
    field.info.fallback = words;
    return field;
  }
  /// Allows this field only if `key` has one of these values.
  Field With(const std::string& key, std::vector<std::string> values) const {
    Field field = *this;
    field.info.only_with = {key, std::move(values)};
    return field;
  }

 private:
  template <typename Member>
  static auto Default(Member member) {
    Options options{};
    return std::invoke(member, options);
  }
};

/// All keys of a mapping, in the order in which they are read and documented. A key may occur several times, because
/// two solvers may have settings of the same name, but at most one of the key's conditions may hold at once.
template <typename Options>
struct FieldTable {
  std::vector<Field<Options>> fields;
  std::function<void(Fields&, Options&)> check = {};  ///< adds an error for values that do not fit together

  /// Reads the keys. Errors are collected in `mapping`; absent keys leave `options` unchanged. The caller must run
  /// `check` afterwards.
  void ReadKeys(Fields& mapping, Options& options) const {
    const std::vector<KeyInfo> keys = Infos();
    for (const Field<Options>& field : fields) {
      if (field.info.IsRequired() && mapping.Raw(field.info.key) == nullptr) mapping.RequiredText(field.info.key);
      if (MayStand(field.info, keys, mapping.node())) field.read(mapping, options);
    }
    RefuseMisplacedKeys(mapping, keys);
  }

  /// Reads the keys, then runs `check`, which tests combinations of values.
  void Read(Fields& mapping, Options& options) const {
    ReadKeys(mapping, options);
    if (check && mapping.ok()) check(mapping, options);
  }

  std::vector<KeyInfo> Describe() const { return MergeAlike(Infos()); }

 private:
  std::vector<KeyInfo> Infos() const {
    std::vector<KeyInfo> infos;
    for (const Field<Options>& field : fields) infos.push_back(field.info);
    return infos;
  }
};

/// Reads a mapping, which may have only the keys of `table`, into `options`; absent keys leave their values unchanged.
/// `what` is the mapping's name in error messages.
template <typename Options>
Result<Options> ReadMapping(const Node& node, const std::string& what, const FieldTable<Options>& table,
                            Options options = {}) {
  Fields fields(node, what);
  table.ReadKeys(fields, options);
  RETURN_IF_ERROR(fields.Finish());  // unknown keys are reported first, because they may explain a missing value
  if (table.check) table.check(fields, options);
  RETURN_IF_ERROR(fields.Finish());
  return options;
}

/// Reads the mapping at `key`, if the key is present, into `value`. Errors are collected in `fields`.
template <typename Value>
void ReadNested(Fields& fields, const std::string& key, const FieldTable<Value>& table, Value& value) {
  const Node* node = fields.Raw(key);
  if (node == nullptr) return;
  auto read = ReadMapping(*node, "'" + key + "'", table, value);
  if (read) {
    value = *std::move(read);
  } else {
    fields.Complain(read.error().place, read.error().message);
  }
}

/// Reads the list of mappings at `key`, if the key is present. `what` is the name of an item in error messages. Errors
/// are collected in `fields`.
template <typename Value>
std::vector<Value> ReadListed(Fields& fields, const std::string& key, const std::string& what,
                              const FieldTable<Value>& table) {
  std::vector<Value> values;
  for (const Node& item : ReadItems(fields, key)) {
    auto read = ReadMapping(item, what, table);
    if (read) {
      values.push_back(*std::move(read));
    } else {
      fields.Complain(read.error().place, read.error().message);
    }
  }
  return values;
}

enum class Keep { kThese, kOthers };

/// Returns fields of `table`, the table of another task, as fields of `Options`: those that `keys` name (kThese), or
/// all others (kOthers). The fields read into `part`, which is a member of `Options` or a Path to one. A key that two
/// tasks share is thus declared once.
template <typename Options, typename Part, typename Member>
std::vector<Field<Options>> FieldsOf(const FieldTable<Part>& table, Member part, Keep keep,
                                     const std::vector<std::string>& keys) {
  std::vector<Field<Options>> fields;
  for (const Field<Part>& field : table.fields) {
    const bool named = std::ranges::find(keys, field.info.key) != keys.end();
    if (named != (keep == Keep::kThese)) continue;
    fields.push_back({field.info, [field, part](Fields& mapping, Options& options) {
                        field.read(mapping, std::invoke(part, options));
                      }});
  }
  return fields;
}

template <typename Options>
void Append(std::vector<Field<Options>> more, std::vector<Field<Options>>& fields) {
  std::ranges::move(more, std::back_inserter(fields));
}

/// Returns the field of one setting of one method in a registry. The field is allowed only if the key `chooser` names
/// that method. `set` receives the options and the value from the file.
template <typename Options, typename Set>
Field<Options> SettingField(const std::string& chooser, const std::string& method, const NumberSetting& setting,
                            Set set) {
  const Range range{setting.lowest, setting.largest};
  return {{setting.key,
           NumberKind(range, setting.is_whole),
           NumberText(setting.fallback),
           setting.meaning,
           {chooser, {method}}},
          [=](Fields& mapping, Options& options) {
            const auto written = setting.is_whole ? mapping.OptionalWhole(setting.key, range)
                                                  : mapping.OptionalNumber(setting.key, range);
            if (written) set(options, *written);
          }};
}

/// Returns the settings of all methods in a registry (solvers, choices, joins) as fields. Each field is allowed only if
/// the key `chooser` names its method. An entry of the registry has a `name` and `settings`. `member` is the vector of
/// doubles that receives the values. If the file has at least one setting, the vector holds all settings of the chosen
/// method, in the method's order. Two methods may have settings of the same name.
template <typename Options, typename Registry, typename Member>
std::vector<Field<Options>> SettingFields(const std::string& chooser, const Registry& registry, Member member) {
  std::vector<Field<Options>> fields;
  for (const auto& method : registry) {
    const std::vector<NumberSetting>& settings = method.settings;
    for (std::size_t i = 0; i < settings.size(); ++i) {
      fields.push_back(SettingField<Options>(chooser, method.name, settings[i], [=](Options& options, double written) {
        std::vector<double>& values = std::invoke(member, options);
        if (values.empty()) {
          for (const NumberSetting& each : settings) values.push_back(each.fallback);
        }
        values[i] = written;
      }));
    }
  }
  return fields;
}

}  // namespace etude
