#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// Reads an XML document element by element, each held against a schema before it is given. Nothing outside the text
/// is loaded, no entities are expanded, and a document type declaration is refused.
class XmlReader {
 public:
  static Result<XmlReader> Open(std::string_view text, std::string_view schema, const std::string& file);
  XmlReader(XmlReader&&) noexcept;
  XmlReader& operator=(XmlReader&&) noexcept;
  ~XmlReader();

  /// Goes to the next start of an element; false at the end of a document that is valid throughout.
  Result<bool> Next();
  /// The name of the element, and the value of one of its attributes; "" when there is none.
  std::string Element() const;
  std::string Attribute(std::string_view name) const;
  /// Where the element starts: file and line.
  Place Where() const;

 private:
  struct State;
  explicit XmlReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace etude
