#include "cli/clip_reading.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <set>
#include <utility>

#include "bench/run/recorded_motions.h"
#include "cli/arguments.h"
#include "engine/fuzzy/open_fuzzy_system.h"
#include "engine/retargeting/marker_sets.h"
#include "io/files/files.h"

namespace etude {

void AddClipReading(CLI::App& command, ClipReading& reading, const std::string& rate) {
  command.add_option(kJointMapOption, reading.joint_map,
                     "A joint map: a file that assigns joints to roles (`etude clip map` writes such a file)");
  command.add_option("--unit", reading.unit,
                     "Unit of the file: m, cm, mm, in, ft, cmu, or a number of metres per unit (default: estimated "
                     "from the body height)");
  command.add_option("--up", reading.up, "Axis of the file that points up: y or z (default: estimated)")
      ->check(OneOf({"y", "z"}));
  command.add_flag("--keep-floor", reading.keep_floor,
                   "Keep the body at its height in the file, instead of placing it on the floor");
  command
      .add_option("--marker-set", reading.marker_set,
                  "The marker set of the file (default: the most suitable set that the file contains)")
      ->check(OneOf(MarkerSetKeys()));
  if (rate.empty()) return;
  command.add_option(rate, reading.rate_hz, "Frames per second of the file (default: the rate that the file states)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
}

Result<OpenOptions> ReadOptions(const ClipReading& reading) {
  OpenOptions options;
  options.recorded = &MotionsOfRuns();
  if (!reading.joint_map.empty()) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(reading.joint_map));
    ASSIGN_OR_RETURN(auto roles, ReadJointMapFile(text, reading.joint_map));
    options.roles = std::move(roles);
  }
  if (reading.rate_hz) {
    if (!options.roles) options.roles.emplace();
    options.roles->rate_hz = reading.rate_hz;
  }
  if (!reading.unit.empty()) {
    ASSIGN_OR_RETURN(const auto metres, ReadUnit(reading.unit, {"--unit"}));
    options.body.metres_per_unit = metres;
  }
  options.body.keep_floor = reading.keep_floor;
  options.marker_set = reading.marker_set;
  options.body.up = UpAxisOf(reading.up);
  return options;
}

Result<OpenOptions> ReadOptionsTellingDoubts(const ClipReading& reading) {
  ASSIGN_OR_RETURN(auto options, ReadOptions(reading));
  const auto told = std::make_shared<std::set<std::pair<std::string, std::string>>>();
  options.on_doubt = [told](const std::string& clip, const std::string& doubt) {
    if (told->emplace(clip, doubt).second) fmt::print(stderr, "{}: {}\n", clip, doubt);
  };
  return options;
}

std::optional<UpAxis> UpAxisOf(const std::string& name) {
  if (name.empty()) return std::nullopt;
  return name == "z" ? UpAxis::kZ : UpAxis::kY;
}

Result<std::optional<TimeSpan>> ReadTrim(const std::string& text) {
  if (text.empty()) return std::optional<TimeSpan>();
  const auto span = ParseTimeSpan(text);
  if (!span) return Fail({}, "--trim: {}", span.error().message);
  return std::optional(*span);
}

Result<FuzzySystem> ReadFuzzy(const std::string& reference) {
  if (reference.empty()) return FuzzySystem{};
  return OpenFuzzySystem(reference, {"--fuzzy", 0, 0}, [](const std::string& file) { return ReadWholeFile(file); });
}

}  // namespace etude
