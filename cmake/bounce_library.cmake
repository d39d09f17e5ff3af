# Flags that every target of ours is built with, and the one way to declare a folder as a library.

add_library(bounce_flags INTERFACE)
target_compile_options(bounce_flags INTERFACE -Wall -Wextra -Wconversion -Wshadow -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 sees overlapping copies in std::string's assignment from a literal (GCC bug 105651).
  target_compile_options(bounce_flags INTERFACE -Wno-restrict)
endif()
if(BOUNCE_SANITIZE)
  target_compile_options(bounce_flags INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer)
  target_link_options(bounce_flags INTERFACE -fsanitize=address,undefined)
endif()

# Code that only calls the libraries, where optimizing costs more to build than it gains: tests, benches, command line.
set(BOUNCE_LIGHT_OPTIMIZATION $<$<CONFIG:Release>:-O1>)

# bounce_library(NAME SOURCES a.cpp ... DEPENDS bounce_core ...)
# Headers are included from the folder above: #include "core/error.h".
function(bounce_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR}/previewer ${CMAKE_SOURCE_DIR}/shaders)
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} PRIVATE bounce_flags)
endfunction()

# bounce_test(NAME SOURCES a.cpp ... DEPENDS ... [LABELS unit])
function(bounce_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} bounce_flags GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${BOUNCE_LIGHT_OPTIMIZATION})
  target_compile_definitions(${name} PRIVATE
    BOUNCE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" BOUNCE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
  add_custom_command(TARGET ${name} POST_BUILD BYPRODUCTS ${suites}
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${name}> -DOUTPUT=${suites} "-DLABELS=${ARG_LABELS}"
      -DFOLDER=${CMAKE_CURRENT_BINARY_DIR} -P ${CMAKE_SOURCE_DIR}/cmake/discover_suites.cmake
    VERBATIM)
  # Until it is built the program is a test that cannot be found: it must not pass for want of tests.
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake
    "if(EXISTS [=[${suites}]=])\n  include([=[${suites}]=])\nelse()\n  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}_include.cmake)
endfunction()
