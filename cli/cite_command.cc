#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/results/folder.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "engine/base/digest.h"
#include "io/files/files.h"

namespace etude {
namespace {

Result<int> CiteCommand(const std::string& folder, const std::string& address, bool as_json) {
  // Compute the digest of the manifest, which identifies the run.
  ASSIGN_OR_RETURN(const auto run, LoadRunOutline(folder));
  ASSIGN_OR_RETURN(const auto manifest, ReadWholeFile(Inside(folder) / "manifest.json"));
  const std::string digest = Digest().Add(std::string_view(manifest)).Hex();
  if (as_json) {
    RETURN_IF_ERROR(PrintFacts("cite", {{"suite", run.suite},
                                        {"made_by", run.program_version},
                                        {"seed", run.seed},
                                        {"manifest", digest},
                                        {"address", address.empty() ? Json(nullptr) : Json(address)}}));
    return kSuccess;
  }
  // Print a BibTeX entry and a sentence for a methods section.
  fmt::print(
      "@software{{etude,\n"
      "  title   = {{Etude: a deterministic benchmark for interactive human motion}},\n"
      "  author  = {{{{The Etude authors}}}},\n"
      "  version = {{{}}},\n"
      "  year    = {{2026}}{}\n"
      "}}\n\n"
      "For a methods section: We ran the suite \"{}\" of Etude {}{} (seed {}, manifest {}); running the same manifest "
      "again gives bit-identical results.\n",
      run.program_version, address.empty() ? "" : fmt::format(",\n  url     = {{{}}}", address), run.suite,
      run.program_version, address.empty() ? "" : fmt::format(", {}", address), run.seed, digest);
  if (address.empty())
    fmt::print(stderr, "the citation has no address: use --address to state where readers find Etude or this run\n");
  return kSuccess;
}

}  // namespace

void DefineCite(CLI::App& app, Action& action) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("cite", "Print a BibTeX entry, and a sentence with which a paper can cite a run");
  command->add_option("folder", *folder, "A result folder")->required();
  auto address = std::make_shared<std::string>();
  command->add_option("--address", *address, "Where readers find Etude or this run: a URL or DOI")
      ->check([](const std::string& text) {
        const bool is_plain = !text.empty() && std::ranges::all_of(text, [](char c) {
          return c > ' ' && c <= '~' && std::string_view("{}\\\"%").find(c) == std::string_view::npos;
        });
        return is_plain ? "" : "is not an address; allowed: ASCII without spaces, braces, double quotes, '%' and '\\'";
      });
  auto as_json = std::make_shared<bool>(false);
  AddJson(*command, *as_json);
  command->callback([=, &action] { action = [=] { return Finish(CiteCommand(*folder, *address, *as_json)); }; });
}

}  // namespace etude
