#include <fmt/core.h>
namespace [[gnu::visibility("default")]] etude {}
