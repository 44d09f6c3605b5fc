# One folder = one target. The name of the target, its sources and its tests all follow from the
# folder's path, so that nothing can be listed in one place and forgotten in another.

# etude_folder(HARDENED DEPENDS <folder>... LIBRARIES <target>... PRIVATE_LIBRARIES <target>...)
#   Makes the library etude_<path> of every .cc file of the current folder. HARDENED: where bytes of others come in, a
#   smashed stack and what the C library sees written beyond its end stop the program. Not where numbers are crunched.
function(etude_folder)
  cmake_parse_arguments(ARG "HARDENED" "" "DEPENDS;LIBRARIES;PRIVATE_LIBRARIES" ${ARGN})
  etude_target_name("${CMAKE_CURRENT_SOURCE_DIR}" target)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cc")
  if(sources)
    add_library(${target} STATIC ${sources})
    etude_unity(${target})
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  if(ARG_HARDENED AND CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT ETUDE_SANITIZE)
    target_compile_options(${target} PRIVATE -D_FORTIFY_SOURCE=2 -fstack-protector-strong -fstack-clash-protection)
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

# etude_unity(<target>): with ETUDE_UNITY, compiles the files of a folder a dozen at a time: of what the compiler reads
# in a file, more than nine tenths are headers. Files that Highway compiles once per instruction set stay alone.
function(etude_unity TARGET)
  if(NOT ETUDE_UNITY)
    return()
  endif()
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC takes a .cc file that is compiled with others for a header, whose types should not hold unnamed ones.
    target_compile_options(${TARGET} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${TARGET} SOURCES)
  foreach(source IN LISTS sources)
    file(STRINGS "${source}" per_target REGEX "hwy/foreach_target.h")
    if(per_target)
      set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# etude_embed(FUNCTION <name> HEADER <header> FILES <file>...)
#   Puts files into the library of the current folder: a test, a worker and an installed program all find them.
#   <header> declares the function that gives them.
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

# etude_test_options(<target>): how tests are compiled, the headers that they share too.
function(etude_test_options TARGET)
  etude_unity(${TARGET})
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${TARGET} PRIVATE -O1)  # tests run once and are compiled often; what they test keeps -O2
  endif()
endfunction()

# etude_tests(DEPENDS <folder>... LIBRARIES <target>... LABELS <label>...)
#   Makes one test program of every .cc file of the current folder, which mirrors the folder it
#   tests (tests/engine/motion tests engine/motion), and registers it with ctest in the pinned
#   environment (bench/process). The whole program is one of ctest's tests: most of its own take
#   less time than to start it (tests/README.md).
function(etude_tests)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES;LABELS" ${ARGN})
  etude_target_name("${CMAKE_CURRENT_SOURCE_DIR}" target)
  file(GLOB sources CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.cc")
  if(NOT sources)
    message(WARNING "${CMAKE_CURRENT_SOURCE_DIR} holds no test")
    return()
  endif()
  add_executable(${target} ${sources})
  etude_test_options(${target})
  set_target_properties(${target} PROPERTIES BUILD_RPATH "${CMAKE_BINARY_DIR}")  # where modules are
  if(ETUDE_HAS_GOLD AND NOT ETUDE_SANITIZE)
    target_link_options(${target} PRIVATE -fuse-ld=gold)
  endif()
  if(ETUDE_UNITY)
    target_precompile_headers(${target} REUSE_FROM etude_tests_headers)
  endif()
  file(RELATIVE_PATH mirrored "${CMAKE_SOURCE_DIR}/tests" "${CMAKE_CURRENT_SOURCE_DIR}")
  etude_target_name("${CMAKE_SOURCE_DIR}/${mirrored}" subject)
  if(TARGET ${subject})
    target_link_libraries(${target} PRIVATE ${subject})
  endif()
  foreach(folder IN LISTS ARG_DEPENDS)
    etude_target_name("${CMAKE_SOURCE_DIR}/${folder}" dependency)
    target_link_libraries(${target} PRIVATE ${dependency})
  endforeach()
  target_link_libraries(${target} PRIVATE etude_tests_support ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  add_test(NAME "${mirrored}" COMMAND env ${ETUDE_PINNED_ENVIRONMENT} $<TARGET_FILE:${target}>
    WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
  set_tests_properties("${mirrored}" PROPERTIES LABELS "${ARG_LABELS}")
endfunction()

# etude_target_name(<absolute folder> <out>): engine/motion -> etude_engine_motion
function(etude_target_name FOLDER OUT)
  file(RELATIVE_PATH path "${CMAKE_SOURCE_DIR}" "${FOLDER}")
  string(REPLACE "/" "_" name "etude_${path}")
  set(${OUT} ${name} PARENT_SCOPE)
endfunction()

# What bench/run gives its workers, so that tests see the same bytes.
set(ETUDE_PINNED_ENVIRONMENT
  "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"
  "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1"
  "MESA_SHADER_CACHE_DISABLE=true"
  "LP_NUM_THREADS=0"
  "LC_ALL=C.UTF-8")
if(ETUDE_SANITIZE MATCHES "address")
  # A constant that is made before one that it needs: the order of files is the linker's choice.
  list(APPEND ETUDE_PINNED_ENVIRONMENT "ASAN_OPTIONS=check_initialization_order=1:strict_init_order=1")
endif()
