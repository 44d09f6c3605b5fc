#include "bench/keys/field_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

enum class Wind { kNone, kStrong };
struct Weather {
  double warmth_c = 20;
  int clouds = 3;
  std::optional<double> rain_mm;
  Wind wind = Wind::kNone;
  double gust = 0.5;
  double turn = Radians(30);  ///< the field's unit is radians
  std::vector<double> tides_m = {1, 2.5};
  bool fog = false, hail = false;
  std::string place;
};

const FieldTable<Weather>& WeatherFields() {
  using Key = Field<Weather>;
  static const FieldTable<Weather> table{
      {Key::Number("warmth_c", &Weather::warmth_c, {-60, 60}, "How warm it is.").Unit("degrees"),
       Key::Number("clouds", &Weather::clouds, {0, 8}, "Eighths of the sky."),
       Key::Number("rain_mm", &Weather::rain_mm, {0, 1000}, "What fell.").WhenAbsent("(none fell)"),
       Key::Name("wind", &Weather::wind, {{"none", Wind::kNone}, {"strong", Wind::kStrong}}, "How it blows."),
       Key::Number("gust", &Weather::gust, {0, 1}, "How suddenly.").With("wind", {"strong"}),
       Key::Angle("turn_deg", &Weather::turn, {0, 360}, "Whence."),
       Key::Numbers("tides_m", &Weather::tides_m, {2, 3}, "two or three of 0…20", {0, 20}, "How high the sea stands."),
       Key::Flags("oddities", {{"fog", &Weather::fog}, {"hail", &Weather::hail}}, "What else there is."),
       Key::Text("place", &Weather::place, "a town", "Where.").WhenAbsent("")},
      [](Fields& fields, Weather& weather) {
        if (weather.hail && weather.clouds == 0) fields.Complain(fields.node().place, "hail needs a cloud");
      }};
  return table;
}

struct Reading {
  Weather weather;
  std::string complaint;
};

Reading Read(const std::string& yaml) {
  const auto node = ParseYaml(yaml, "w.yaml");
  EXPECT_TRUE(node) << yaml;
  const auto read = ReadMapping(*node, "a weather", WeatherFields());
  return read ? Reading{*read, ""} : Reading{{}, ToString(read.error())};
}

TEST(FieldTable, ReadsWhatIsWrittenAndLeavesTheRestAsItIs) {
  const Reading plain = Read("{place: Ulm}");
  EXPECT_THAT(plain.complaint, IsEmpty());
  EXPECT_EQ(plain.weather.warmth_c, 20);
  EXPECT_EQ(plain.weather.rain_mm, std::nullopt);
  const Reading full = Read(
      "{place: Ulm, warmth_c: -3.5, clouds: 8, rain_mm: 4, wind: strong, gust: 1, turn_deg: 180, tides_m: [0, 3], "
      "oddities: [hail]}");
  EXPECT_THAT(full.complaint, IsEmpty());
  EXPECT_EQ(full.weather.warmth_c, -3.5);
  EXPECT_EQ(full.weather.clouds, 8);
  EXPECT_EQ(full.weather.rain_mm, 4);
  EXPECT_EQ(full.weather.wind, Wind::kStrong);
  EXPECT_EQ(full.weather.gust, 1);
  EXPECT_EQ(full.weather.turn, Radians(180.0));
  EXPECT_THAT(full.weather.tides_m, ElementsAre(0, 3));
  EXPECT_TRUE(full.weather.hail && !full.weather.fog);
}

TEST(FieldTable, SaysWhereSomethingIsWrongAndWhatIsAllowed) {
  EXPECT_EQ(Read("{}").complaint, "w.yaml:1:1: a weather needs 'place'");
  EXPECT_THAT(Read("{place: Ulm, warmth_c: 61}").complaint, HasSubstr("1:24: 'warmth_c': 61 is out of range"));
  EXPECT_THAT(Read("{place: Ulm, clouds: 1.5}").complaint, HasSubstr("'clouds' must be a whole number, found 1.5"));
  EXPECT_THAT(Read("{place: Ulm, wind: storng}").complaint, HasSubstr("did you mean 'strong'? Allowed: none, strong"));
  EXPECT_THAT(Read("{place: Ulm, tides_m: [1]}").complaint, HasSubstr("'tides_m' has 1 numbers; needed: 2 to 3"));
  EXPECT_THAT(Read("{place: Ulm, tides_m: [1, 2, 3, 4]}").complaint, HasSubstr("has 4 numbers"));
  EXPECT_THAT(Read("{place: Ulm, oddities: [fog, hale]}").complaint, HasSubstr("1:30: unknown oddities 'hale'"));
  EXPECT_THAT(Read("{place: Ulm, cluods: 1}").complaint, HasSubstr("unknown key of a weather 'cluods'"));
  EXPECT_EQ(Read("{place: Ulm, clouds: 0, oddities: [hail]}").complaint, "w.yaml:1:1: hail needs a cloud");
  EXPECT_EQ(Read("{place: Ulm, gust: 7}").complaint,
            "w.yaml:1:20: wind 'none' (the default) has no key 'gust'; this key is allowed with wind: strong");
}

TEST(FieldTable, RefusesAKeyWhoseChooserMayNotStandItself) {
  using Key = Field<Weather>;
  const FieldTable<Weather> table{{Key::Flag("fog", &Weather::fog, "Whether there is fog."),
                                   Key::Number("clouds", &Weather::clouds, {0, 8}, "Of fog.").With("fog", {"true"}),
                                   Key::Number("gust", &Weather::gust, {0, 1}, "Of three.").With("clouds", {"3"})}};
  const auto read = [&](const std::string& yaml) {
    const auto node = ParseYaml(yaml, "w.yaml");
    return testing::Refusal(ReadMapping(*node, "a weather", table));
  };
  EXPECT_EQ(read("{fog: true, gust: 1}"), "accepted");
  EXPECT_EQ(read("{gust: 1}"),
            "w.yaml:1:8: fog 'false' (the default) has no key 'gust'; this key is allowed with fog: true");
  EXPECT_EQ(read("{fog: true, clouds: 4, gust: 1}"),
            "w.yaml:1:30: clouds '4' has no key 'gust'; this key is allowed with clouds: 3");
}

TEST(FieldTable, TellsItsKeysWithTheDefaultsOfTheStruct) {
  const auto keys = WeatherFields().Describe();
  std::vector<std::string> told;
  for (const KeyInfo& key : keys) told.push_back(key.key + " | " + key.AllowedWhere() + " | " + key.fallback);
  EXPECT_THAT(
      told, ElementsAre("warmth_c | -60…60 (degrees) | 20", "clouds | 0…8 | 3", "rain_mm | 0…1000 | (none fell)",
                        "wind | none, strong | none", "gust | 0…1; with `wind: strong` | 0.5", "turn_deg | 0…360 | 30",
                        "tides_m | two or three of 0…20 | [1, 2.5]", "oddities | a list of: fog, hail | []",
                        "place | a town | "));
}

TEST(FieldTable, TellsEditorsTheSame) {
  const Json schema = MappingSchema(WeatherFields().Describe());
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], Json({"place"}));
  const Json& keys = schema["properties"];
  EXPECT_EQ(keys["warmth_c"]["minimum"], -60);
  EXPECT_EQ(keys["warmth_c"]["default"], 20);
  EXPECT_EQ(keys["clouds"]["type"], "integer");
  EXPECT_FALSE(keys["rain_mm"].contains("default"));
  EXPECT_EQ(keys["wind"]["enum"], Json({"none", "strong"}));
  EXPECT_EQ(keys["tides_m"]["minItems"], 2);
  EXPECT_EQ(keys["tides_m"]["maxItems"], 3);
  EXPECT_THAT(keys["gust"]["description"].get<std::string>(), HasSubstr("with `wind: strong`"));
  EXPECT_EQ(schema["dependencies"]["gust"]["properties"]["wind"]["enum"], Json::array({"strong"}));
  EXPECT_EQ(schema["dependencies"]["gust"]["required"], Json::array({"wind"})) << "its default is another";
}

// Two methods of a registry have a setting of the same name with different defaults and ranges.
struct Tool {
  std::string name;
  std::vector<NumberSetting> settings;
};
const std::vector<Tool> kTools = {
    {"saw", {{"gain", 1, 0, 2, false, "Of the saw."}, {"teeth", 24, 1, 99, true, "How many."}}},
    {"drill", {{"gain", 5, 3, 9, false, "Of the drill."}}},
    {"file", {}},
    {"rasp", {{"teeth", 24, 1, 99, true, "How many."}}}};

struct Job {
  std::string tool = "saw";
  std::vector<double> settings;
};

const FieldTable<Job>& JobFields() {
  static const FieldTable<Job> table = [] {
    FieldTable<Job> made{{Field<Job>::Name(
        "tool", &Job::tool, {{"saw", "saw"}, {"drill", "drill"}, {"file", "file"}, {"rasp", "rasp"}}, "With what.")}};
    for (const Field<Job>& field : SettingFields<Job>("tool", kTools, &Job::settings)) made.fields.push_back(field);
    return made;
  }();
  return table;
}

Result<Job> ReadJob(const std::string& yaml) {
  const auto node = ParseYaml(yaml, "j.yaml");
  EXPECT_TRUE(node) << yaml;
  return ReadMapping(*node, "a job", JobFields());
}

TEST(SettingFields, BelongToTheMethodThatIsChosen) {
  EXPECT_THAT(ReadJob("{}")->settings, IsEmpty()) << "the method's defaults";
  EXPECT_THAT(ReadJob("{gain: 2}")->settings, ElementsAre(2, 24));
  EXPECT_THAT(ReadJob("{teeth: 30}")->settings, ElementsAre(1, 30));
  EXPECT_THAT(ReadJob("{tool: drill, gain: 9}")->settings, ElementsAre(9)) << "not the saw's range";
  EXPECT_THAT(ReadJob("{tool: rasp, teeth: 7}")->settings, ElementsAre(7));
}

TEST(SettingFields, AreRefusedElsewhereWithTheNamesOfAllThatHaveThem) {
  EXPECT_EQ(ToString(ReadJob("{tool: drill, gain: 2}").error()),
            "j.yaml:1:21: 'gain': 2 is out of range; allowed: 3 to 9");
  EXPECT_EQ(ToString(ReadJob("{gain: 3}").error()), "j.yaml:1:8: 'gain': 3 is out of range; allowed: 0 to 2");
  EXPECT_EQ(ToString(ReadJob("{tool: file, gain: 2}").error()),
            "j.yaml:1:20: tool 'file' has no key 'gain'; this key is allowed with tool: saw, drill");
  EXPECT_EQ(ToString(ReadJob("{tool: drill, teeth: 2}").error()),
            "j.yaml:1:22: tool 'drill' has no key 'teeth'; this key is allowed with tool: saw, rasp");
  EXPECT_THAT(ToString(ReadJob("{teeth: 2.5}").error()), HasSubstr("'teeth' must be a whole number, found 2.5"));
}

TEST(SettingFields, AreToldOnceForAllThatMeanTheSame) {
  std::vector<std::string> told;
  for (const KeyInfo& key : JobFields().Describe()) told.push_back(key.key + ": " + key.AllowedWhere());
  EXPECT_THAT(told, ElementsAre("tool: saw, drill, file, rasp", "gain: 0…2; with `tool: saw`",
                                "teeth: 1…99; with `tool: saw, rasp`", "gain: 3…9; with `tool: drill`"));
  const Json schema = MappingSchema(JobFields().Describe());
  EXPECT_EQ(schema["properties"]["gain"]["anyOf"].size(), 2u);
  const Json& variants = schema["dependencies"]["gain"]["anyOf"];
  EXPECT_EQ(variants[1]["properties"]["gain"]["minimum"], 3);
  EXPECT_EQ(variants[1]["required"], Json::array({"tool"}));
  EXPECT_FALSE(variants[0].contains("required")) << "the saw is the default";
}

}  // namespace
}  // namespace etude
