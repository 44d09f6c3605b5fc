# One folder is one target. The target's name, its sources and its tests follow from the folder's path, so no list can
# be incomplete.

# Options that harden code which reads untrusted files.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT ETUDE_SANITIZE)
  set(ETUDE_HARDENING -D_FORTIFY_SOURCE=2 -fstack-protector-strong -fstack-clash-protection)
endif()

# etude_harness_options(): sets the compiler options of bench, reports and cli. Long computations are in engine/ and
# sim/, so -O1 is enough here and compiles faster. Nearly all of these folders read files, so all are hardened.
macro(etude_harness_options)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    add_compile_options(-O1 ${ETUDE_HARDENING})
  endif()
  link_libraries(fmt::fmt)  # the shared headers include fmt
  set(ETUDE_HEADERS etude_harness_headers)
endmacro()

# etude_headers(<target> LIBRARIES <target>... OPTIONS <option>... HEADERS <header>...)
#   With ETUDE_UNITY, compiles these headers once. All folders in which the variable ETUDE_HEADERS is <target> use the
#   result; their options must be the same. Without ETUDE_UNITY, each file must include what it uses.
function(etude_headers TARGET)
  cmake_parse_arguments(ARG "" "" "LIBRARIES;OPTIONS;HEADERS" ${ARGN})
  if(ETUDE_UNITY)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${TARGET}.cc")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// The headers are compiled with this file.\n")
    add_library(${TARGET} OBJECT "${source}")
    target_include_directories(${TARGET} PRIVATE "${CMAKE_SOURCE_DIR}")
    target_link_libraries(${TARGET} PRIVATE ${ARG_LIBRARIES})
    target_compile_options(${TARGET} PRIVATE ${ARG_OPTIONS})
    target_precompile_headers(${TARGET} PRIVATE ${ARG_HEADERS})
  endif()
endfunction()

# etude_folder(HARDENED DEPENDS <folder>... LIBRARIES <target>... PRIVATE_LIBRARIES <target>...)
#   Makes the library etude_<path> from every .cc file of the current folder. HARDENED is for folders of engine/ that
#   read untrusted files: an overwritten stack, or a write beyond a buffer's end that the C library detects, stops the
#   program. Folders that only compute are not hardened, because it costs time.
function(etude_folder)
  cmake_parse_arguments(ARG "HARDENED" "" "DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  etude_target_name("${CMAKE_CURRENT_SOURCE_DIR}" target)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cc")
  if(sources)
    add_library(${target} STATIC ${sources})
    etude_unity(${target} 24)
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  if(ARG_HARDENED AND ETUDE_HARDENING)
    etude_compile_options(${ETUDE_HARDENING})
  endif()
  target_include_directories(${target} ${scope} "${CMAKE_SOURCE_DIR}")
  target_link_libraries(${target} ${scope} glm::glm tl::expected ${ARG_LIBRARIES})
  if(ARG_PRIVATE_LIBRARIES AND sources)
    target_link_libraries(${target} PRIVATE ${ARG_PRIVATE_LIBRARIES})
  endif()
  foreach(folder IN LISTS ARG_DEPENDS)
    etude_target_name("${CMAKE_SOURCE_DIR}/${folder}" dependency)
    target_link_libraries(${target} ${scope} ${dependency})
  endforeach()
endfunction()

# etude_shared_library(<target> NAME <file> EXPORT <name>)
#   Prepares the library <target> for other programs: its file is lib<file>.so, and programs link it as etude::<name>.
#   The current folder's symbols.map lists its public symbols.
function(etude_shared_library TARGET)
  cmake_parse_arguments(ARG "" "NAME;EXPORT" "" ${ARGN})
  target_link_options(${TARGET} PRIVATE "-Wl,--version-script=${CMAKE_CURRENT_SOURCE_DIR}/symbols.map")
  if(NOT ETUDE_SANITIZE AND NOT ETUDE_FUZZ)  # with clang, the sanitizers' functions are defined only in the program
    target_link_options(${TARGET} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(${TARGET} PROPERTIES
    OUTPUT_NAME ${ARG_NAME} EXPORT_NAME ${ARG_EXPORT} LINKER_LANGUAGE CXX LINK_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/symbols.map"
    VERSION "${PROJECT_VERSION}" SOVERSION "${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}"
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}")
  target_compile_features(${TARGET} INTERFACE cxx_std_20)
  target_include_directories(${TARGET} INTERFACE "$<INSTALL_INTERFACE:include/etude>")
endfunction()

# etude_unity(<target> <count>): with ETUDE_UNITY, compiles <count> files of a folder together, after the headers that
# ETUDE_HEADERS names, because headers are more than nine tenths of the text that the compiler reads. Files that Highway
# compiles once per instruction set are compiled alone.
function(etude_unity TARGET COUNT)
  if(NOT ETUDE_UNITY)
    return()
  endif()
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${COUNT})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC treats a .cc file compiled together with others as a header, and warns about types in its unnamed namespaces.
    target_compile_options(${TARGET} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${TARGET} SOURCES)
  foreach(source IN LISTS sources)
    file(STRINGS "${source}" per_target REGEX "hwy/foreach_target.h")
    if(per_target)
      set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
    endif()
  endforeach()
  if(ETUDE_HEADERS)
    target_precompile_headers(${TARGET} REUSE_FROM ${ETUDE_HEADERS})
  endif()
endfunction()

# etude_compile_options(<option>... FILES <file>...): sets options of the current folder's library, or only of some of
# its files. Such files are compiled without the headers of etude_headers, which were compiled with other options.
function(etude_compile_options)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  if(ARG_FILES)
    set_source_files_properties(${ARG_FILES} PROPERTIES COMPILE_OPTIONS "${ARG_UNPARSED_ARGUMENTS}"
      SKIP_PRECOMPILE_HEADERS ON)
  else()
    etude_target_name("${CMAKE_CURRENT_SOURCE_DIR}" target)
    target_compile_options(${target} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# etude_embed(FUNCTION <name> HEADER <header> FILES <file>...)
#   Embeds files into the library of the current folder, so that a test, a worker and an installed program all find
#   them. <header> declares the function that returns them.
function(etude_embed)
  cmake_parse_arguments(ARG "" "FUNCTION;HEADER" "FILES" ${ARGN})
  etude_target_name("${CMAKE_CURRENT_SOURCE_DIR}" target)
  list(SORT ARG_FILES)
  set(embedded "${CMAKE_CURRENT_BINARY_DIR}/${ARG_FUNCTION}.cc")
  set(script "${CMAKE_SOURCE_DIR}/cmake/embed_texts.cmake")
  add_custom_command(
    OUTPUT "${embedded}"
    COMMAND "${CMAKE_COMMAND}" -D "OUT=${embedded}" -D "HEADER=${ARG_HEADER}" -D "FUNCTION=${ARG_FUNCTION}"
            -D "FILES=${ARG_FILES}" -P "${script}"
    DEPENDS ${ARG_FILES} "${script}"
    COMMENT "Embedding ${ARG_FUNCTION}"
    VERBATIM)
  target_sources(${target} PRIVATE "${embedded}")
endfunction()

# etude_test_program(<name> UNOPTIMISED FOLDERS <folder>... DEPENDS <folder>... LIBRARIES <target>...)
#   Makes the program etude_tests_<name> from every .cc file in and below the given folders of tests/. A folder mirrors
#   the folder that it tests (tests/engine/motion tests engine/motion) and is linked with it. Each folder is one of
#   ctest's tests, in the pinned environment (io/process), because starting a program takes longer than most single
#   tests (tests/README.md). The target etude_tests_<folder> builds the folder's program. Tests whose names begin with
#   HEAVY_ are a further test with the label "heavy". UNOPTIMISED is for tests that compute little: optimising would
#   take more time than it saves.
function(etude_test_program NAME)
  cmake_parse_arguments(ARG "UNOPTIMISED" "" "FOLDERS;DEPENDS;LIBRARIES" ${ARGN})
  set(program etude_tests_${NAME})
  set(patterns ${ARG_FOLDERS})
  list(TRANSFORM patterns REPLACE "(.+)" "${CMAKE_SOURCE_DIR}/tests/\\1/*.cc")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  list(FILTER sources EXCLUDE REGEX "/tests/(reports/support|fuzz/program|fuzz/readers)/")  # have their own targets
  set(folders ${sources})
  list(TRANSFORM folders REPLACE "/[^/]*$" "")
  list(REMOVE_DUPLICATES folders)

  add_executable(${program} ${sources})
  if(ARG_UNOPTIMISED AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${program} PRIVATE -O0)
    set(ETUDE_HEADERS etude_tests_unoptimised_headers)
  endif()
  etude_unity(${program} 12)  # names in the unnamed namespaces of more files would collide
  set_target_properties(${program} PROPERTIES BUILD_RPATH "${CMAKE_BINARY_DIR}")  # the folder of the modules
  if(ETUDE_HAS_GOLD AND NOT ETUDE_SANITIZE)
    target_link_options(${program} PRIVATE -fuse-ld=gold)
  endif()
  foreach(folder IN LISTS folders)
    file(RELATIVE_PATH mirrored "${CMAKE_SOURCE_DIR}/tests" "${folder}")
    etude_target_name("${CMAKE_SOURCE_DIR}/${mirrored}" subject)
    if(TARGET ${subject})
      target_link_libraries(${program} PRIVATE ${subject})
    endif()
    add_test(NAME "${mirrored}" COMMAND env ${ETUDE_PINNED_ENVIRONMENT} $<TARGET_FILE:${program}> "--folder=${mirrored}"
      WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
    file(GLOB in_folder "${folder}/*.cc")
    foreach(source IN LISTS in_folder)
      file(STRINGS "${source}" heavy REGEX "HEAVY_" LIMIT_COUNT 1)
      if(heavy)
        add_test(NAME "${mirrored}: heavy"
          COMMAND env ${ETUDE_PINNED_ENVIRONMENT} $<TARGET_FILE:${program}> "--folder=${mirrored}" --heavy
          WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
        set_tests_properties("${mirrored}: heavy" PROPERTIES LABELS heavy TIMEOUT 3000)
        break()
      endif()
    endforeach()
    etude_target_name("${folder}" by_folder)
    if(NOT TARGET ${by_folder})
      add_custom_target(${by_folder} DEPENDS ${program})
    endif()
  endforeach()
  foreach(folder IN LISTS ARG_DEPENDS)
    etude_target_name("${CMAKE_SOURCE_DIR}/${folder}" dependency)
    target_link_libraries(${program} PRIVATE ${dependency})
  endforeach()
  target_link_libraries(${program} PRIVATE etude_tests_support ${ARG_LIBRARIES} GTest::gtest GTest::gmock)
endfunction()

# etude_target_name(<absolute folder> <out>): engine/motion becomes etude_engine_motion.
function(etude_target_name FOLDER OUT)
  file(RELATIVE_PATH path "${CMAKE_SOURCE_DIR}" "${FOLDER}")
  string(REPLACE "/" "_" name "etude_${path}")
  set(${OUT} ${name} PARENT_SCOPE)
endfunction()

# The environment that bench/run gives its workers, so that tests compute the same bytes.
set(ETUDE_PINNED_ENVIRONMENT
  "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"
  "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1"
  "MESA_SHADER_CACHE_DISABLE=true"
  "LP_NUM_THREADS=0"
  "LC_ALL=C.UTF-8"
  "PATH=/usr/bin:$ENV{PATH}")  # fenced methods cannot see a Python in a home folder, so /usr/bin is first
if(ETUDE_SANITIZE MATCHES "address")
  # AddressSanitizer then reports a constant that is initialised before the constant of another file that it needs.
  list(APPEND ETUDE_PINNED_ENVIRONMENT "ASAN_OPTIONS=check_initialization_order=1:strict_init_order=1")
endif()
