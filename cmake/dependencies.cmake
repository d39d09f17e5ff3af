# Every library comes from the distribution; scripts/install_deps lists the packages.
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(glfw3 REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(draco REQUIRED)
find_package(CLI11 REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(egl REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(glu REQUIRED IMPORTED_TARGET glu)
pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)
pkg_check_modules(opencolorio REQUIRED IMPORTED_TARGET OpenColorIO)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(tinygltf REQUIRED IMPORTED_TARGET tinygltf)

# GLM as Debian packs it is headers alone; these are its switches for the whole program.
add_library(bounce_glm INTERFACE)
target_compile_definitions(bounce_glm INTERFACE
  GLM_FORCE_RADIANS GLM_FORCE_EXPLICIT_CTOR GLM_ENABLE_EXPERIMENTAL GLM_FORCE_SILENT_WARNINGS)

if(BOUNCE_TESTS)
  find_package(GTest REQUIRED)
endif()
