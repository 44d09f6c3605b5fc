#include "io/clips/fbx.h"

#include <dlfcn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <utility>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "io/clips/fbx_preparation.h"
#include "io/process/loaded_libraries.h"

namespace etude {
namespace {

constexpr const char* kModule = "etude_clips_assimp.so";  // found beside the program, through its run path (RPATH)
constexpr rlim_t kMemoryBytes = rlim_t{4} << 30, kProcessorSeconds = 60;
constexpr std::size_t kMaxGlbBytes = std::size_t{1} << 30;
constexpr unsigned kMinVersion = 7;
constexpr const char* kReaderFailed = "the FBX file is damaged: its reader stopped";
constexpr char kSaidGlb = 'G', kSaidError = 'C';

constexpr std::string_view kBinaryStart = "Kaydara FBX Binary", kTextStart = "; FBX";

/// Returns the major version of an FBX file, or 0 if the file does not state one.
unsigned MajorVersion(std::string_view bytes) {
  if (bytes.starts_with(kTextStart)) {
    const std::size_t digit = bytes.find_first_not_of(' ', kTextStart.size());
    return digit < bytes.size() && bytes[digit] >= '0' && bytes[digit] <= '9'
               ? static_cast<unsigned>(bytes[digit] - '0')
               : 0;
  }
  constexpr std::size_t kVersionAt = 23;
  std::uint32_t version = 0;
  if (bytes.size() >= kVersionAt + sizeof version) std::memcpy(&version, bytes.data() + kVersionAt, sizeof version);
  return version / 1000;
}

/// Returns the name and the build ID of the loaded assimp, in the same form as the manifest's list of libraries.
std::string NameOfReader() {
  constexpr std::size_t kToldDigits = 20;
  for (const auto& [name, build] : LoadedLibraries()) {
    if (name.starts_with("libassimp.")) return name + " (" + build.substr(0, kToldDigits) + ")";
  }
  return "assimp is part of the program";
}

/// Returns the address space that this process already uses, bytes. RLIMIT_AS also counts this address space, so the
/// limit is this number plus kMemoryBytes.
rlim_t MappedBytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void Limit(int resource, rlim_t maximum) {
  const rlimit limit{maximum, maximum};
  ::setrlimit(resource, &limit);
}

/// Raises this process's limit of processor time to `seconds` more than the time that the process has used so far.
void AllowProcessorTime(rlim_t seconds) {
  rlimit limit{};
  ::getrlimit(RLIMIT_CPU, &limit);
  const rlim_t spent = static_cast<rlim_t>(std::clock() / CLOCKS_PER_SEC) + 1;
  limit.rlim_cur = std::min(limit.rlim_max, spent + seconds);
  ::setrlimit(RLIMIT_CPU, &limit);
}

/// Sends the length of `bytes` and then the bytes. Returns false if the socket's other end is closed.
bool SendBlock(int socket, std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  return SendAll(socket, {reinterpret_cast<const char*>(&size), sizeof size}) && SendAll(socket, bytes);
}

/// Receives a block of SendBlock. Returns nullopt if the socket's other end is closed, or if the block is longer than
/// `maximum` bytes (then `is_too_long` is set).
std::optional<std::string> ReceiveBlock(int socket, std::size_t maximum, bool& is_too_long) {
  std::uint64_t size = 0;
  if (!ReceiveAll(socket, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
  is_too_long = size > maximum;
  std::string bytes;
  if (is_too_long) return std::nullopt;
  bytes.resize(size);
  return ReceiveAll(socket, bytes.data(), size) ? std::optional(std::move(bytes)) : std::nullopt;
}

/// Runs in the child process. Answers each file with kSaidGlb, the bytes of FbxKeyFacts, a line with the reader's name
/// and the GLB file; or with kSaidError and an error message.
int ReadFilesInChild(int socket) {
  Limit(RLIMIT_AS, MappedBytes() + kMemoryBytes);
  Limit(RLIMIT_CORE, 0);
  // The default handlers end the child on a crash, even if the parent handles these signals.
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(fatal, SIG_DFL);
  std::string missing, name;
  GlbOfFbxBytes* read = nullptr;
  // Load the module once. If that fails, every file gets the same error message.
  if (void* module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL); module == nullptr) {
    missing = std::string("reading an FBX file needs assimp, which is missing (") + ::dlerror() +
              "); install Debian's libassimp-dev, and build Etude again";
  } else if (const void* symbol = ::dlsym(module, "etude_clips_assimp"); symbol == nullptr) {
    missing = std::string(kModule) + " is a module of another program or version";
  } else {
    read = *static_cast<GlbOfFbxBytes* const*>(symbol);
    name = NameOfReader();
  }
  bool is_too_long = false;
  // Answer files until the parent closes the socket.
  while (const auto bytes = ReceiveBlock(socket, kMaxGlbBytes, is_too_long)) {
    AllowProcessorTime(kProcessorSeconds);
    std::string said = missing;
    FbxKeyFacts facts;
    const bool went_well = read != nullptr && read(*bytes, said, facts);
    std::string head(1, went_well ? kSaidGlb : kSaidError);
    if (went_well) head.append(reinterpret_cast<const char*>(&facts), sizeof facts).append(name + "\n");
    if (!SendBlock(socket, head + said)) break;
  }
  return 0;
}

/// The bytes that assimp gets ("" if they are the file's own), and remarks about them.
struct PreparedFbx {
  std::string bytes;
  std::vector<std::string> remarks;
};

/// Changes what assimp would read wrongly.
PreparedFbx Prepare(std::string_view bytes) {
  PreparedFbx prepared;
  if (const std::size_t inactive = LeaveOutInactiveRotations(bytes, prepared.bytes); inactive > 0) {
    prepared.remarks.push_back(
        fmt::format("RotationActive is not set in {} joints, so Etude ignores the pre-rotations, post-rotations and "
                    "rotation orders of these joints",
                    inactive));
    bytes = prepared.bytes;
  }
  if (std::string doubt = DoubtOfScales(bytes); !doubt.empty()) prepared.remarks.push_back(std::move(doubt));
  std::string changed;
  for (std::string& remark : PrepareTakes(bytes, changed)) prepared.remarks.push_back(std::move(remark));
  if (!changed.empty()) prepared.bytes = std::move(changed);
  return prepared;
}

/// Adds remarks about the keys.
void Describe(const FbxKeyFacts& facts, std::vector<std::string>& remarks) {
  if (facts.longest_s > kFbxNearKeys_s) {
    remarks.push_back(
        fmt::format("keys are up to {:.2f} s apart; between keys, Etude replaces the file's curves by shortest arcs at "
                    "constant speed",
                    facts.longest_s));
  }
  constexpr double kHeld_s = 0.05;  // longer than a frame at the usual rates
  if (facts.step_s > kHeld_s) {
    remarks.push_back(
        fmt::format("the file has stepped keys, up to {:.2f} s apart; Etude moves the joints from key to key, although "
                    "in the file they jump",
                    facts.step_s));
  }
  if (facts.turn_deg > 0) {
    remarks.push_back(fmt::format(
        "an angle changes by {:.0f}° from one key to the next, and Etude makes the joint turn by this angle",
        facts.turn_deg));
  }
  if (facts.cut_s > 0) {
    remarks.push_back(
        fmt::format("Etude leaves out keys outside the clip's time span (LocalStart to LocalStop); these keys reach "
                    "{:.2f} s beyond it",
                    facts.cut_s));
  }
  if (facts.empty_spans > 0) {
    remarks.push_back(
        fmt::format("in {} clips, the time span (LocalStart to LocalStop) contains no key, so Etude uses all keys",
                    facts.empty_spans));
  }
}

}  // namespace

bool IsFbx(std::string_view bytes) { return bytes.starts_with(kBinaryStart) || bytes.starts_with(kTextStart); }

Result<FbxMotion> FbxReader::Read(std::string_view bytes, const std::string& path) {
  // Refuse versions that assimp cannot read, before a child is started.
  if (const unsigned version = MajorVersion(bytes); version > 0 && version < kMinVersion) {
    return Fail({path},
                "the FBX file has version {}; allowed: version {} (2011) or later; export or convert the file again",
                version, kMinVersion);
  }
  PreparedFbx prepared = Prepare(bytes);
  if (!prepared.bytes.empty()) bytes = prepared.bytes;
  if (!child_) {
    ASSIGN_OR_RETURN(auto started, ForkedCopy::Start(ReadFilesInChild));
    child_ = std::move(started);
  }
  // Send the file and wait for the answer.
  std::optional<std::string> said;
  bool is_too_long = false;
  if (SendBlock(child_->socket(), bytes)) said = ReceiveBlock(child_->socket(), kMaxGlbBytes, is_too_long);
  // The child answered: return its GLB file or its error message.
  if (said && said->starts_with(kSaidGlb) && said->size() > sizeof(FbxKeyFacts)) {
    FbxKeyFacts facts;
    std::memcpy(&facts, said->data() + 1, sizeof facts);
    std::string_view rest = std::string_view(*said).substr(1 + sizeof facts);
    FbxMotion motion{.glb = "", .reader = std::string(TakeLine(rest))};
    motion.glb = rest;
    std::vector<std::string> remarks = std::move(prepared.remarks);
    Describe(facts, remarks);
    motion.remark = Join(remarks, "; ");
    return motion;
  }
  if (said) {
    constexpr std::size_t kMaxMessageBytes = 300;  // assimp's message may repeat the whole file
    const std::string why = said->size() < 2 ? kReaderFailed : said->substr(1, kMaxMessageBytes);
    return Fail({path}, "{}{}", why, said->size() > 1 + kMaxMessageBytes ? " …" : "");
  }
  // The child ended without an answer: distinguish an exceeded limit from a crash.
  const int status = child_->Wait();
  child_.reset();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (is_too_long || signal == SIGXCPU || signal == SIGKILL) {
    return Fail(
        {path},
        "the FBX file is too large; allowed for reading: {} s of processor time, {} GB of memory and {} GB of result",
        kProcessorSeconds, kMemoryBytes >> 30, kMaxGlbBytes >> 30);
  }
  if (signal == 0) return Fail({path}, "{}", kReaderFailed);
  return Fail({path}, "{} {} ({})", kReaderCrashed, signal, ::strsignal(signal));
}

Result<FbxMotion> ReadFbx(std::string_view bytes, const std::string& path) { return FbxReader().Read(bytes, path); }

}  // namespace etude
