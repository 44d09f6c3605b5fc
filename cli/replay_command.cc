#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "bench/replay/replay.h"
#include "cli/commands.h"
#include "cli/interrupt.h"

namespace etude {
namespace {

void PrintDifference(const CellCheck& check) {
  fmt::print("differs: {}\n  first at {}: {} then, {} now\n", check.cell, check.stage, check.then, check.now);
}

int ReplayFile(const std::string& file, const OutsideRules& outside) {
  const auto check = ReplayPack(file, outside);
  if (!check) return Complain(check.error());
  if (!check->same) {
    PrintDifference(*check);
    return kNothingWorked;
  }
  fmt::print("{}: the same, stage by stage\n", check->cell);
  return kSuccess;
}

}  // namespace

int ReplayCommand(const std::string& target, const std::vector<std::string>& cells, std::size_t sample,
                  const std::string& pack_file, int jobs, const OutsideRules& outside, Sealing sealing) {
  const Interrupt interrupt;
  std::error_code error;
  if (!std::filesystem::is_directory(target, error)) {
    if (!cells.empty() || !pack_file.empty() || sample > 0) {
      return Complain({{target, 0, 0}, "is no result folder; --cell, --sample and --pack need one"});
    }
    return ReplayFile(target, outside);
  }
  if (!pack_file.empty()) {
    if (cells.size() != 1) return Complain({{}, "--pack packs one cell: name it with --cell"});
    if (auto packed = PackCell(target, cells.front(), pack_file, sealing); !packed) return Complain(packed.error());
    fmt::print("Packed into {}\nNext, anywhere: etude replay {}\n", pack_file, pack_file);
    return kSuccess;
  }
  const auto checks = ReplayRun({.folder = target,
                                 .cells = cells,
                                 .sample = sample,
                                 .jobs = jobs,
                                 .outside = outside,
                                 .sealing = sealing,
                                 .stop = interrupt.requested()});
  if (!checks) return Complain(checks.error());
  const auto same = std::count_if(checks->begin(), checks->end(), [](const CellCheck& check) { return check.same; });
  for (const CellCheck& check : *checks) {
    if (!check.same) PrintDifference(check);
  }
  fmt::print("{} of {} cells came out the same\n", same, checks->size());
  if (*interrupt.requested()) return kInterrupted;
  return static_cast<std::size_t>(same) == checks->size() ? kSuccess : kNothingWorked;
}

}  // namespace etude
