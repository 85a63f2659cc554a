# Language level, warnings and sanitizers: the one place that sets them for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# No contraction: what is stored must be the same bytes whatever the machine.
add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-Wno-restrict)  # GCC 12 sees overlaps in "text" + std::string that are not there (bug 105651)
endif()

if(RELEVO_SANITIZE)
  add_compile_options(-fsanitize=${RELEVO_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${RELEVO_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # GCC 12 warns wrongly about initialisation in code that the sanitizers have instrumented.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()
if(RELEVO_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# relevo_library(NAME SOURCES... ) makes target relevo_NAME with the alias relevo::NAME.
function(relevo_library name)
  add_library(relevo_${name} STATIC ${ARGN})
  add_library(relevo::${name} ALIAS relevo_${name})
  set_target_properties(relevo_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(relevo_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:include/relevo>)
endfunction()
