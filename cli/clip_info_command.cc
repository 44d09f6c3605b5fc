#include <fmt/core.h>

#include "cli/clip_commands.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "reports/clips/clip_facts.h"

namespace etude {

int ClipInfoCommand(const ClipInfoOptions& options) {
  const auto reading = ReadOptions(options.reading);
  if (!reading) return Complain(reading.error());
  const auto references = ExpandAll(options.clips);
  if (!references) return Complain(references.error());
  std::vector<ClipFacts> all;
  for (const std::string& reference : *references) {
    for (ClipFacts& facts : FactsOf(reference, *reading)) {
      if (!options.as_json && facts.format) fmt::print("{}", FactsAsText(facts, all.empty() ? nullptr : &all.back()));
      all.push_back(std::move(facts));
    }
  }
  if (options.as_json) {
    const auto json = FactsAsJson(all);
    if (!json) return Complain(json.error());
    fmt::print("{}\n", *json);
  }
  int code = kSuccess;
  for (const ClipFacts& facts : all) {
    if (facts.complaint) code = Complain(*facts.complaint);
  }
  return code;
}

}  // namespace etude
