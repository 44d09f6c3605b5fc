#pragma once

#include <stdexcept>
#include <string_view>

/// Marks the public symbols of this folder's headers. All symbols of the engine's own headers (`engine/…`) are public.
#define ETUDE_API __attribute__((visibility("default")))

namespace etude {}

/// Declares what libetude offers other programs (docs/library.md). Lengths are metres and angles radians; the world is
/// right-handed with Y up. p_AB_W is the position of B from A, expressed in W; R_WB rotates vectors from B to W.
namespace etude::engine {

using namespace etude;  // the interface passes types of the engine, such as BodyMotion

/// Thrown for input that cannot be processed. `what()` is one line: the position as far as it is known ("walk.bvh:12:3:
/// …"), what was found and what is allowed. A numerical outcome, such as an undetermined point, is returned as a
/// status, not thrown.
class ETUDE_API BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the version of the loaded library, such as "0.1.0". Until 1.0.0, a minor version may change this interface.
ETUDE_API std::string_view Version();

}  // namespace etude::engine
