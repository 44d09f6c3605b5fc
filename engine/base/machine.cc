#include "engine/base/machine.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace etude {
namespace {

// Values of errno that are caused by the machine, not by the file's name.
constexpr std::array kShortages = {EIO,    ENOSPC, EDQUOT, EFBIG,   EROFS,  ENOMEM,
                                   EAGAIN, EMFILE, ENFILE, ENOBUFS, ENOLCK, ESTALE};
constexpr std::array kFaultsOfName = {ENOENT, ENOTDIR, EISDIR, EEXIST, ENOTEMPTY, EINVAL, ENAMETOOLONG, ELOOP, ETXTBSY};

bool IsAmong(int number, const auto& numbers) { return std::ranges::find(numbers, number) != numbers.end(); }

tl::unexpected<Error> Failure(const std::string& path, std::string_view what, int reason, bool is_of_machine) {
  Error error{{path, 0, 0}, fmt::format("{}: {}", what, std::strerror(reason))};
  if (is_of_machine) error = OfThisMachine(error);
  return tl::unexpected(std::move(error));
}

}  // namespace

tl::unexpected<Error> CannotWrite(const std::string& path, std::string_view what, int reason) {
  return Failure(path, what, reason, !IsAmong(reason, kFaultsOfName));
}

tl::unexpected<Error> CannotRead(const std::string& path, std::string_view what, int reason) {
  return Failure(path, what, reason, IsAmong(reason, kShortages));
}

}  // namespace etude
