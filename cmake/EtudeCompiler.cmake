# Sets the same compiler flags for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "${ETUDE_OPTIMISE} -DNDEBUG")
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")  # keeps assertions in builds with sanitizers

# x86-64-v2 is the lowest instruction set level on which Etude promises identical bytes. Contracting a*b+c to a fused
# multiply-add would change the last bit on CPUs that have that instruction.
add_compile_options(-march=x86-64-v2 -ffp-contract=off)
# Functions of the library cannot be replaced at load time, so the library's own calls may be inlined.
add_compile_options(-fno-semantic-interposition)
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns by mistake about overlapping and endless copies in std::string (GCC bugs 105651, 105329).
  add_compile_options(-Wno-restrict -Wno-stringop-overflow)
endif()
if(ETUDE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # By default GCC collects garbage at 128 MB and at each doubling; files compiled together need about 700 MB.
  add_compile_options(--param=ggc-min-heapsize=700000)
endif()
# Unused libraries are not loaded, and relocated data becomes read-only after loading.
add_link_options(-Wl,--as-needed -Wl,-z,relro -Wl,-z,now)
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold ETUDE_HAS_GOLD)  # gold links the test programs faster
if(ETUDE_WERROR)
  add_compile_options(-Werror)
endif()

if(ETUDE_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)  # counts the edges of the control flow that an input takes
endif()
if(ETUDE_SANITIZE)
  add_compile_options(-fsanitize=${ETUDE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=${ETUDE_SANITIZE})
  add_compile_definitions(_GLIBCXX_ASSERTIONS)  # checks indices of vectors and spans, and access to empty optionals
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # With sanitizers GCC warns by mistake that parts of std::regex and std::function are uninitialized (GCC bug 105616).
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()
