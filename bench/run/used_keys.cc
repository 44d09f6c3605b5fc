#include "bench/run/used_keys.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/base/digest.h"
#include "engine/base/machine.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns the path of the file that lists the uses of a key; links are resolved. Returns "" if the key does not come
/// from a regular file.
fs::path ListOf(const SecretKey& key) {
  std::error_code error;
  const fs::path file = key.file.empty() ? fs::path() : fs::canonical(key.file, error);
  if (file.empty() || !fs::is_regular_file(file, error)) return {};
  return file.string() + ".used";
}

Json Encode(const SecretKey& key, const KeyUse& use) {
  return {{"key", Seed::Secret(key.words).Digest()},
          {"command", use.command},
          {"suite", use.suite},
          {"manifest", use.manifest},
          {"shard", ToString(use.shard)},
          {"folder", fs::absolute(use.folder).lexically_normal().string()}};
}

/// Returns true if `a` and `b` record different shards of the same run.
bool AreOtherShards(const Json& a, const Json& b) {
  const auto shard_of = [](const Json& line) { return ParseShard(line.at("shard").get<std::string>()); };
  const auto of_a = shard_of(a), of_b = shard_of(b);
  return a.at("command") == "run" && b.at("command") == "run" && a.at("manifest") == b.at("manifest") && of_a && of_b &&
         of_a->count == of_b->count && of_a->index != of_b->index;
}

/// Returns true if `use` repeats the run that the line records.
bool IsRepeated(const Json& line, const Json& use) {
  return line.at("command") == "run" && use.at("command") == "run" && line.at("manifest") == use.at("manifest");
}

/// The open file that lists the uses of a key. It is locked if the file system has locks.
class UsedKeys {
 public:
  static Result<UsedKeys> Open(const fs::path& list) {
    UsedKeys keys(list, ::open(list.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR));
    if (keys.file_ < 0) return NotWritable(list);
    while (::flock(keys.file_, LOCK_EX) != 0 && errno == EINTR) {
    }
    RETURN_IF_ERROR(keys.Read());
    return keys;
  }
  UsedKeys(UsedKeys&& other) noexcept
      : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), lines_(std::move(other.lines_)) {}
  UsedKeys& operator=(UsedKeys&&) = delete;
  ~UsedKeys() {
    if (file_ >= 0) ::close(file_);
  }

  bool Has(const Json& use) const { return std::ranges::find(lines_, use) != lines_.end(); }
  bool HasKeyOf(const Json& use) const {
    return std::ranges::any_of(lines_, [&](const Json& line) { return line.at("key") == use.at("key"); });
  }

  Result<void> Check(const SecretKey& key, const Json& use, const KeyUse& how) const {
    if (how.continues && Has(use)) return {};
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const Json& line = lines_[i];
      if (line.at("key") != use.at("key") || AreOtherShards(line, use)) continue;
      if (how.repeats && IsRepeated(line, use)) continue;
      const auto text = [&](const char* name) { return line.at(name).get<std::string>(); };
      return Fail({key.file.string()},
                  "was used before: 'etude {}' with '{}' wrote into {} ({}:{}), so the worlds of this key may be "
                  "known; allowed: a new key (head -c 32 /dev/urandom), or --reuse-key",
                  text("command"), text("suite"), text("folder"), path_.string(), i + 1);
    }
    return {};
  }

  Result<void> Add(const Json& use) {
    ASSIGN_OR_RETURN(const auto json, WriteJson(use));
    const std::string line = json + "\n";
    const bool is_written = ::write(file_, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    if (is_written && ::fdatasync(file_) == 0) return {};
    // If the write fails, the file may end with an incomplete line, which the next reader cuts off.
    return CannotWrite(path_.string(), "cannot be written", errno);
  }

  static tl::unexpected<Error> NotWritable(const fs::path& list) {
    return Fail({list.string()},
                "cannot be written ({}), so etude cannot record that the key was used; allowed: a key in a folder that "
                "you can write to, or --reuse-key",
                std::strerror(errno));
  }

 private:
  UsedKeys(fs::path path, int file) : path_(std::move(path)), file_(file) {}

  /// Reads all lines. An incomplete last line is cut off: a process that was killed while it wrote the line had not yet
  /// used the key.
  Result<void> Read() {
    std::string text;
    std::array<char, 1 << 14> chunk;
    while (true) {
      const ssize_t count = ::pread(file_, chunk.data(), chunk.size(), static_cast<off_t>(text.size()));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return Fail({path_.string()}, "cannot be read: {}", std::strerror(errno));
      if (count == 0) break;
      text.append(chunk.data(), static_cast<std::size_t>(count));
    }
    const std::size_t whole = text.rfind('\n') + 1;
    if (whole < text.size() && ::ftruncate(file_, static_cast<off_t>(whole)) != 0) return NotWritable(path_);
    for (std::size_t at = 0, end = 0; at < whole; at = end + 1) {
      end = text.find('\n', at);
      const Place place{path_.string(), static_cast<int>(lines_.size()) + 1};
      ASSIGN_OR_RETURN(auto line, ReadJson(text.substr(at, end - at), place.file, place.line));
      for (const char* name : {"key", "command", "suite", "manifest", "shard", "folder"}) {
        if (line.is_object() && line.value(name, Json()).is_string()) continue;
        return Fail(place, "is not a line of the list of used keys: '{}' is missing", name);
      }
      lines_.push_back(std::move(line));
    }
    return {};
  }

  fs::path path_;
  int file_;
  std::vector<Json> lines_;
};

}  // namespace

std::string DigestOfRun(const Json& manifest) {
  Json same = manifest;
  same.erase("libraries");
  return Digest().Add(std::string_view(same.dump())).Hex();
}

Result<void> CheckUnused(const SecretKey& key, const KeyUse& use) {
  const fs::path list = ListOf(key);
  if (list.empty()) return {};
  std::error_code none;
  // Do not create the file yet, because other checks of the input may still fail.
  if (!fs::exists(fs::symlink_status(list, none))) {
    if (use.continues || use.repeats || ::access(list.parent_path().c_str(), W_OK) == 0) return {};
    return UsedKeys::NotWritable(list);
  }
  ASSIGN_OR_RETURN(const auto keys, UsedKeys::Open(list));
  return keys.Check(key, Encode(key, use), use);
}

Result<void> NoteUse(const SecretKey& key, const KeyUse& use, bool may_be_used) {
  const fs::path list = ListOf(key);
  if (list.empty()) return {};
  const bool may_be_known = may_be_used || use.continues || use.repeats;
  auto keys = UsedKeys::Open(list);
  if (!keys && may_be_known) return {};
  if (!keys) return tl::unexpected(keys.error());
  const Json line = Encode(key, use);
  if (may_be_known && keys->Has(line)) return {};
  if (!may_be_used) RETURN_IF_ERROR(keys->Check(key, line, use));
  auto added = keys->Add(line);
  return may_be_known ? Result<void>() : added;
}

Result<void> NoteRepeat(const SecretKey& key, const KeyUse& use) {
  const fs::path list = ListOf(key);
  if (list.empty()) return {};
  const Json line = Encode(key, use);
  auto keys = UsedKeys::Open(list);
  if (!keys) {
    return Fail({list.string()},
                "cannot be written, so etude cannot record that the key was used; allowed: a key in a folder that you "
                "can write to");
  }
  return keys->HasKeyOf(line) ? Result<void>() : keys->Add(line);
}

}  // namespace etude
