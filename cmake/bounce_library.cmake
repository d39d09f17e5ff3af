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
  target_compile_definitions(${name} PRIVATE
    BOUNCE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" BOUNCE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 300)
endfunction()
