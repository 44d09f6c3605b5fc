#pragma once

#include <stdexcept>
#include <string_view>

/// Marks what the library shows; all else in it is hidden.
#define ETUDE_API __attribute__((visibility("default")))

/// Declares what libetude offers other programs (docs/library.md). Lengths are metres, angles radians, the world is
/// right-handed with Y up; p_AB_W is the position of B from A, told in the axes of W, and R_WB turns B's axes into W's.
namespace etude::engine {

/// Is thrown where an input cannot be worked on; `what()` is one line: the place as far as it is known
/// ("walk.bvh:12:3: …"), what was found and what is allowed. Outcomes of numerical work are statuses instead.
class ETUDE_API BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns the version of the library that is loaded: "0.1.0". Until 1.0.0 a minor version may change what is here.
ETUDE_API std::string_view Version();

}  // namespace etude::engine
