# Compiler settings, attached to our own targets only and never to what links us.

# What the sources of libhri see of HRI_SIMD (cpp/src/core/simd.hpp).
set(hri_simd_definitions)
if(HRI_SIMD STREQUAL "OFF")
  set(hri_simd_sets)
elseif(HRI_SIMD STREQUAL "ON")
  set(hri_simd_sets avx2 avx512)
else()
  set(hri_simd_sets ${HRI_SIMD})
endif()
foreach(set IN LISTS hri_simd_sets)
  if(NOT set MATCHES "^(avx2|avx512)$")
    message(FATAL_ERROR "HRI_SIMD=${HRI_SIMD}: ${set} is not ON, OFF, avx2 or avx512")
  endif()
endforeach()
foreach(set avx2 avx512)
  if(NOT set IN_LIST hri_simd_sets)
    string(TOUPPER ${set} name)
    list(APPEND hri_simd_definitions HRI_NO_${name})
  endif()
endforeach()

# hri_target_settings(target OPTIMISATION): the option of Release builds. Loops over samples, frames and pixels take
# -O3; what only calls them compiles faster with -O1, and is no slower, or with none at all (HRI_OPTIMISE_CALLERS).
function(hri_target_settings target optimisation)
  target_compile_features(${target} PUBLIC cxx_std_17)
  set_target_properties(
    ${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                         VISIBILITY_INLINES_HIDDEN ON)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
    if(HRI_WARNINGS_AS_ERRORS)
      target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(NOT HRI_EXCEPTIONS)
      target_compile_options(${target} PRIVATE -fno-exceptions -fno-rtti)
    endif()
    if(HRI_INFERENCE_ONLY)
      target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections)
      if(NOT HRI_EXCEPTIONS)
        # Tables by which nothing unwinds the stack, an eighth of a program.
        target_compile_options(${target} PRIVATE -fno-unwind-tables -fno-asynchronous-unwind-tables)
      endif()
    endif()
    # No -ffast-math, and no fused multiply-adds, which round once where others round twice: NaN checks depend on IEEE
    # arithmetic, and every processor gives the same bits.
    target_compile_options(${target} PRIVATE -ffp-contract=off)
    # Eigen's quick square root of floats starts from an estimate of the processor's, which every maker rounds its own way.
    target_compile_definitions(${target} PRIVATE EIGEN_FAST_MATH=0)
    # A project that has libhri in it may have no build type: code for a robot is optimised then, too.
    set(is_release $<OR:$<CONFIG:Release>,$<STREQUAL:$<CONFIG>,>>)
    target_compile_options(${target} PRIVATE $<${is_release}:${optimisation}>)
    target_compile_definitions(${target} PRIVATE $<${is_release}:NDEBUG>)
    if(optimisation STREQUAL "-O1" AND NOT HRI_OPTIMISE_CALLERS)
      target_compile_options(${target} PRIVATE -O0)
    endif()
  endif()
endfunction()

# Headers that most sources of a target include are parsed once.
function(hri_precompile target)
  if(HRI_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# With HRI_UNITY_BUILD, sources of one folder are compiled as one. So their names are unique in the folder, those in
# unnamed namespaces, too. Sources that have compiler options of their own stand apart.
function(hri_unite target)
  if(HRI_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    foreach(source IN LISTS ARGN)
      get_filename_component(folder "${source}" DIRECTORY)
      file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
      string(REPLACE "/" "_" folder "${folder}")
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}")
    endforeach()
  endif()
endfunction()
