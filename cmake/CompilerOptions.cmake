# Copyright 2026 the mechanism_codesign authors. SPDX-License-Identifier: BSD-3-Clause

include(CheckCXXCompilerFlag)

# Warnings are errors on our own targets; the headers of others are SYSTEM includes.
# GCC 12 sees uninitialized memory in moved-from strings and in fixed-size Eigen expressions that are whole: that one warning is off.
function(codesign_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -Wno-maybe-uninitialized)
endfunction()

# GCC collects garbage from 128 MB on; the files with Eigen's templates take 200 to 500 MB, and are a tenth faster without.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif()

# A compiler cache, where there is one, makes a second build tree (sanitizers, a workspace) cheap.
find_program(CODESIGN_CCACHE ccache)
if(CODESIGN_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CODESIGN_CCACHE})
  # ccache fails, and the compiler with it, where its folder cannot be written: a home that is read-only, say.
  execute_process(COMMAND sh -c "folder=$(\"$0\" --get-config cache_dir) && mkdir -p \"$folder\" && test -w \"$folder\"" ${CODESIGN_CCACHE}
    RESULT_VARIABLE codesign_ccache_unwritable ERROR_QUIET)
  if(codesign_ccache_unwritable)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_DIR=${PROJECT_BINARY_DIR}/ccache CCACHE_TEMPDIR=${PROJECT_BINARY_DIR}/ccache/tmp ${CODESIGN_CCACHE})
  endif()
endif()

# ccache takes precompiled headers only where it is told that it may trust them. With paths relative to the checkout it serves
# another checkout for a part of the files. Not with debugging information, which contains the path of the checkout.
if(CODESIGN_CCACHE AND CMAKE_CXX_COMPILER_LAUNCHER)
  set(codesign_ccache_settings CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime)
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    list(APPEND codesign_ccache_settings CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=true)
  endif()
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env ${codesign_ccache_settings} ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()
option(CODESIGN_PRECOMPILED_HEADERS "Parse the headers of other libraries once for each library and for all tests" ON)

# Numerical code. Neither errno nor floating-point traps are used, and both keep loops from being vectorized; IEEE results stay as they are.
# The files of the time loop get all of it; for the rest it would only cost time to compile.
function(codesign_optimize target)
  target_compile_options(${target} PRIVATE -fno-math-errno -fno-trapping-math -fno-semantic-interposition)
  set(hot_options -O3 -fvisibility-inlines-hidden)
  # Eigen aligns its types by the widest vectors it knows of. It is told of SSE only, so that whoever includes our headers agrees with the
  # library whatever they compile for; the compiler itself uses the wide ones. doc/decisions/0011-processor.md
  if(CODESIGN_NATIVE)
    list(APPEND hot_options -march=native -U__AVX__ -U__AVX2__ -U__FMA__ -U__AVX512F__ -U__AVX512DQ__)
    # Structures copied in halves of a register and read back whole wait for the store buffer each time.
    check_cxx_compiler_flag("-march=native -mmove-max=256 -mstore-max=256" CODESIGN_HAS_MOVE_MAX)
    if(CODESIGN_HAS_MOVE_MAX)
      list(APPEND hot_options -mmove-max=256 -mstore-max=256)
    endif()
  endif()
  # Whatever instantiates a template of the time loop belongs to them: the linker keeps one copy, and it may be the slow one.
  set(hot sparse/lu_schedule equations/iteration_matrix
    integration/one_step integration/rosenbrock_stages integration/explicit_stages integration/dense_output integration/run_watch sensitivity/tangent_step sensitivity/tangent_method)
  list(TRANSFORM hot PREPEND ${PROJECT_SOURCE_DIR}/src/)
  list(TRANSFORM hot APPEND .cc)
  foreach(peer kernel_tables kernel_program_tables articulated_body robot_peers)
    list(APPEND hot ${PROJECT_SOURCE_DIR}/benchmark/${peer}.cc)
  endforeach()
  set_source_files_properties(${hot} PROPERTIES COMPILE_OPTIONS "$<$<NOT:$<CONFIG:Debug>>:${hot_options}>" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

# Code that runs once for a file, a request or a trial, not for each step. -O1 takes a third less time to compile than -O2, if the precompiled
# header is compiled with it too: GCC ignores one of another level, and that costs what -O1 saves. doc/decisions/0046-build.md
function(codesign_optimize_little target)
  target_compile_options(${target} PRIVATE "$<$<NOT:$<CONFIG:Debug>>:-O1>")
endfunction()

# Headers of the standard library and of Eigen are half of what a small source file compiles. Our own are not among them: they change.
set(codesign_headers <Eigen/Core> <algorithm> <array> <atomic> <cmath> <complex> <cstdint> <functional> <map> <memory> <optional> <string>
  <utility> <vector>)
function(codesign_precompile target)
  if(CODESIGN_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${codesign_headers} ${ARGN})
  endif()
endfunction()
# The same for a library that is a single unit if files are united: for one unit a precompiled header costs more than it saves.
function(codesign_precompile_files target)
  if(NOT codesign_unites)
    codesign_precompile(${target} ${ARGN})
  endif()
endfunction()

# Small files that are not in the time loop compile together: most of their time goes into headers that all of them include.
option(CODESIGN_UNITY "Compile the small files of a room together" ON)
set(codesign_unites OFF)
if(CODESIGN_UNITY AND NOT CMAKE_VERSION VERSION_LESS 3.18)
  set(codesign_unites ON)
endif()
# codesign_unite(TARGET GROUP FILE...): the files become one translation unit. GROUP begins with the name of the room.
function(codesign_unite target group)
  if(codesign_unites)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
    # In such a unit GCC takes each file for a header, whose anonymous namespace would be another one in every unit.
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
  endif()
endfunction()

# Sanitizers watch libraries, program and fuzzer. The tests' own objects are those of an ordinary build, which a compiler cache has;
# what they and the libraries both instantiate the libraries take from themselves, where it is watched.
set(codesign_sanitizer_options)
if(CODESIGN_SANITIZE)
  # Eigen would lay out its memory otherwise under the address sanitizer than in the tests' objects.
  list(APPEND codesign_sanitizer_options -fsanitize=${CODESIGN_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -DEIGEN_MALLOC_ALREADY_ALIGNED=1)
  # These cost a third of the time to compile, and what they look for ends in a fault or in one of Eigen's assertions all the same.
  if(CODESIGN_SANITIZE MATCHES undefined)
    list(APPEND codesign_sanitizer_options -fno-sanitize=null,alignment,object-size,vptr,pointer-overflow)
  endif()
  add_link_options(-fsanitize=${CODESIGN_SANITIZE})
endif()

function(codesign_sanitize target)
  if(CODESIGN_SANITIZE)
    target_compile_options(${target} PRIVATE -O1 -g1 -UNDEBUG -D_GLIBCXX_ASSERTIONS ${codesign_sanitizer_options})
  endif()
endfunction()
