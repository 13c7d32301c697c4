# SPDX-License-Identifier: GPL-3.0-or-later
# Compiler settings, packages and the helper that declares a room of the core library.
include(GNUInstallDirs)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# Most of a compiler's time goes into the same headers again and again. A change then costs a batch,
# so the preset for development leaves it off (and shows headers that a source forgot).
if(LVCALIB_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
endif()

# An inline function that a program compiles as well stays the library's own there: calls within the
# library are direct, and what a test compiles without optimizing never takes its place.
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# Of a test that waits for the library and for programs half of the compile time goes into making it
# fast. The simulator, the library and the programs stay optimized.
function(lvcalib_do_not_optimize TARGET)
  target_compile_options(${TARGET} PRIVATE $<$<CONFIG:Release>:-O0>)
endfunction()

# Of a test's compile time four fifths are the headers of Qt, Eigen and GoogleTest. They are compiled
# once per kind of program and reused: lvcalib_precompile(TARGET KIND), with the kind's headers
# declared by lvcalib_precompiled_headers(). A header that cannot be reused (other options) is an
# error (-Winvalid-pch), so that it does not cost time unseen.
function(lvcalib_precompiled_headers KIND TYPE)
  cmake_parse_arguments(PCH "" "" "HEADERS;LIBRARIES;DEFINITIONS" ${ARGN})
  if(NOT LVCALIB_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source "${CMAKE_CURRENT_BINARY_DIR}/lvcalib_pch_${KIND}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "int main() {}\n" @ONLY)
  if(TYPE STREQUAL "PROGRAM")
    add_executable(lvcalib_pch_${KIND} "${source}")
  else()
    add_library(lvcalib_pch_${KIND} OBJECT "${source}")
  endif()
  target_link_libraries(lvcalib_pch_${KIND} PRIVATE lvcalib_warnings Threads::Threads ${PCH_LIBRARIES})
  target_compile_definitions(lvcalib_pch_${KIND} PRIVATE ${PCH_DEFINITIONS})
  target_precompile_headers(lvcalib_pch_${KIND} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <mutex>
    <optional> <span> <string> <utility> <variant> <vector>
    <Eigen/Core> <Eigen/Cholesky> <Eigen/Geometry> <Eigen/Eigenvalues> ${PCH_HEADERS})
endfunction()
function(lvcalib_precompile TARGET KIND)
  if(LVCALIB_PRECOMPILED_HEADERS)
    target_precompile_headers(${TARGET} REUSE_FROM lvcalib_pch_${KIND})
  endif()
endfunction()

set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/lib")
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")

add_library(lvcalib_warnings INTERFACE)
target_compile_options(lvcalib_warnings INTERFACE -Wall -Wextra -Wpedantic
  $<$<BOOL:${LVCALIB_WERROR}>:-Werror>)
# GCC 12 sees overlapping and endless copies in `"text" + std::string` at -O3 that are not there.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(lvcalib_warnings INTERFACE -Wno-restrict -Wno-maybe-uninitialized
    -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()
# Nothing asks errno after a root or a logarithm; without it a root is one instruction.
add_compile_options(-fno-math-errno)
if(LVCALIB_SANITIZE)
  # A null or misaligned pointer faults by itself or is the address sanitizer's to find; asked before
  # every access besides, compiling takes twice as long.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(LVCALIB_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "LVCALIB_BUILD_FUZZERS needs clang; use the preset fuzz")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc calib3d features2d aruco)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(TIFF 4.5 REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(apriltag REQUIRED)
find_package(Boost REQUIRED)
find_package(CLI11 REQUIRED)
find_package(muparser REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(PkgConfig REQUIRED)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(LZ4 REQUIRED IMPORTED_TARGET liblz4)
find_package(BZip2 REQUIRED)
find_package(SQLite3 REQUIRED)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo cairo-pdf cairo-svg)
# liblzf ships neither a CMake nor a pkg-config file.
find_path(LZF_INCLUDE_DIR lzf.h PATH_SUFFIXES liblzf REQUIRED)
find_library(LZF_LIBRARY lzf REQUIRED)

lvcalib_precompiled_headers(core LIBRARY LIBRARIES Eigen3::Eigen)

# lvcalib_room(NAME SOURCES a.cpp … [ROOMS base …] [LIBRARIES Foo::foo …])
# One folder of core/ is one object library; lvcalib_core links them all into the installed one.
# ROOMS are the doors of the architecture: what this room may include.
function(lvcalib_room NAME)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ROOMS;LIBRARIES" ${ARGN})
  set(target lvcalib_${NAME})
  add_library(${target} OBJECT ${ROOM_SOURCES})
  target_include_directories(${target} PUBLIC "${PROJECT_SOURCE_DIR}/core")
  target_include_directories(${target} SYSTEM PRIVATE ${OpenCV_INCLUDE_DIRS})
  lvcalib_precompile(${target} core)
  target_link_libraries(${target} PUBLIC Eigen3::Eigen PRIVATE lvcalib_warnings Threads::Threads)
  foreach(room IN LISTS ROOM_ROOMS)
    target_link_libraries(${target} PUBLIC lvcalib_${room})
  endforeach()
  target_link_libraries(${target} PRIVATE ${ROOM_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY LVCALIB_ROOMS ${NAME})
  set_property(GLOBAL APPEND PROPERTY LVCALIB_ROOM_LIBRARIES ${ROOM_LIBRARIES})
endfunction()
