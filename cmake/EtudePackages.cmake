# Finds every outside library once. Each heavy library is linked by a single folder (its "door").
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(tl-expected REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
set(BLA_VENDOR Generic)  # the generic BLAS; without this line, Debian's Ceres would bring ATLAS
find_package(Ceres REQUIRED)
find_package(hwy REQUIRED)
find_package(LibXml2 REQUIRED)
find_package(Pagmo REQUIRED)
find_package(assimp REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
# The renderer uses OSMesa or EGL. Neither is linked: sim/render opens one of them when the first picture is drawn.
# Debian after 13 has no OSMesa.
pkg_check_modules(OSMESA osmesa)
pkg_check_modules(EGL egl>=1.5)
if(NOT OSMESA_FOUND AND NOT EGL_FOUND)
  message(FATAL_ERROR "Neither OSMesa nor EGL is found: install libosmesa6-dev or libegl-dev (scripts/setup)")
endif()
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(SODIUM REQUIRED IMPORTED_TARGET libsodium)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)

# Debian's Ceres package requires ATLAS in addition to LAPACK and BLAS, but does not use it.
get_target_property(ceres_needs Ceres::ceres INTERFACE_LINK_LIBRARIES)
list(FILTER ceres_needs EXCLUDE REGEX "lib(f77blas|atlas)[.]")
set_target_properties(Ceres::ceres PROPERTIES INTERFACE_LINK_LIBRARIES "${ceres_needs}")

# The versions of libraries that may change the bytes of a run, for manifests.
string(CONCAT ETUDE_PACKAGES
  "Ceres ${Ceres_VERSION}, Eigen ${Eigen3_VERSION}, Highway ${hwy_VERSION}, "
  "OpenEXR ${OpenEXR_VERSION}, Pagmo ${Pagmo_VERSION}, TinyGLTF ${TinyGLTF_VERSION}, cairo ${CAIRO_VERSION}, "
  "fmt ${fmt_VERSION}, glm ${glm_VERSION}, libjpeg ${JPEG_VERSION}, libpng ${PNG_VERSION_STRING}, "
  "libxml2 ${LIBXML2_VERSION_STRING}, nlohmann_json ${nlohmann_json_VERSION}, xxHash ${XXHASH_VERSION}, "
  "toml++ ${tomlplusplus_VERSION}, yaml-cpp ${yaml-cpp_VERSION}")

# yaml-cpp 0.7 exports a bare name instead of a namespaced target.
if(NOT TARGET yaml-cpp::yaml-cpp)
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
