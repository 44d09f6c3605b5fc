# Writes a .cc file that holds text files as string literals:
#   cmake -D OUT=<file.cc> -D HEADER=<header> -D FUNCTION=<name> -D "FILES=<a;b>" -P embed_texts.cmake
# The header declares `std::span<const etude::EmbeddedText> <FUNCTION>()`; the entries are in the order
# of FILES, each named by the last part of its path.
set(entries "")
foreach(file IN LISTS FILES)
  file(READ "${file}" text)
  get_filename_component(name "${file}" NAME)
  string(APPEND entries "    {\"${name}\", R\"__text__(${text})__text__\"},\n")
endforeach()
file(WRITE "${OUT}" "#include \"${HEADER}\"

namespace etude {

std::span<const EmbeddedText> ${FUNCTION}() {
  static constexpr EmbeddedText kTexts[] = {
${entries}  };
  return kTexts;
}

}  // namespace etude
")
