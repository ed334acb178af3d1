# Debian 12's OpenSubdivConfig.cmake names libosdCPU.a and libosdGPU.a, which libosd-dev does not ship, so
# find_package(OpenSubdiv CONFIG) is a fatal error. This module is found first and gives the target that we use.
include(FindPackageHandleStandardArgs)
find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/version.h)
find_library(OpenSubdiv_CPU_LIBRARY osdCPU)
if(OpenSubdiv_INCLUDE_DIR)
  file(STRINGS "${OpenSubdiv_INCLUDE_DIR}/opensubdiv/version.h" _defines
       REGEX "define OPENSUBDIV_VERSION_(MAJOR|MINOR|PATCH) ")
  string(REGEX REPLACE "[^0-9]*([0-9]+)[^0-9]*([0-9]+)[^0-9]*([0-9]+).*" "\\1.\\2.\\3"
         OpenSubdiv_VERSION "${_defines}")
endif()
find_package_handle_standard_args(OpenSubdiv
  REQUIRED_VARS OpenSubdiv_INCLUDE_DIR OpenSubdiv_CPU_LIBRARY
  VERSION_VAR OpenSubdiv_VERSION)
if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
  add_library(OpenSubdiv::osdCPU SHARED IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES
    IMPORTED_LOCATION "${OpenSubdiv_CPU_LIBRARY}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${OpenSubdiv_INCLUDE_DIR}")
endif()
