// The functions that libFuzzer calls. `etude_fuzz --target=bvh corpus/bvh` fuzzes one reader; `--list` names all
// readers; `--make=FOLDER` writes the seeds and the dictionary of every reader into FOLDER.
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/readers/target.h"

namespace etude::fuzz {
namespace {

const Target* chosen = nullptr;

/// Returns a word as a line of libFuzzer's dictionary.
std::string Quoted(const std::string& word) {
  std::string line = "\"";
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    line += byte < 0x20 || byte > 0x7e || c == '"' || c == '\\' ? fmt::format("\\x{:02X}", byte) : std::string(1, c);
  }
  return line + "\"\n";
}

void Make(const std::filesystem::path& folder) {
  for (const Target& target : Targets()) {
    const std::filesystem::path corpus = folder / target.name / "corpus";
    std::filesystem::create_directories(corpus);
    const std::vector<std::string> seeds = target.seeds();
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      std::ofstream(corpus / fmt::format("seed-{}", i), std::ios::binary) << seeds[i];
    }
    std::ofstream dictionary(folder / target.name / "words");
    for (const std::string& word : target.words) dictionary << Quoted(word);
  }
}

void Begin(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--list") {
      for (const Target& target : Targets()) std::printf("%s\n", target.name.c_str());
      std::exit(0);
    }
    if (argument.starts_with("--make=")) {
      Make(argument.substr(7));
      std::exit(0);
    }
    if (!argument.starts_with("--target=")) continue;
    for (const Target& target : Targets()) {
      if (target.name == argument.substr(9)) chosen = &target;
    }
  }
  Require(chosen != nullptr, "no such --target=; --list names them");
}

}  // namespace
}  // namespace etude::fuzz

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  etude::fuzz::Begin(*argc, *argv);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  etude::fuzz::chosen->read({reinterpret_cast<const char*>(data), size});
  return 0;
}
