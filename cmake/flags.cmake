# One interface target carries every flag; targets opt in by linking it.
add_library(plumb_strict INTERFACE)
target_compile_features(plumb_strict INTERFACE cxx_std_20)
target_include_directories(plumb_strict INTERFACE ${PROJECT_SOURCE_DIR})
# Left out: vptr, at which gcc 12 crashes inside lcm-cpp; null and alignment, whose checks at every reference make
# sources with unrolled Eigen take minutes and 2 GB. A null pointer ends in AddressSanitizer's report all the same, and
# Eigen asserts the alignment of what it vectorises.
set(sanitizers -fsanitize=address,undefined -fno-sanitize=vptr,null,alignment)
# No errno and no trapping maths: both only keep loops from vectorising. Never -ffast-math: sums keep
# their order, so the same input gives the same bits; contraction is off for the same reason.
target_compile_options(plumb_strict INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror
  -fno-math-errno -fno-trapping-math -ffp-contract=off
  $<$<CONFIG:Debug>:-DEIGEN_INITIALIZE_MATRICES_BY_NAN>
  $<$<BOOL:${PLUMB_SANITIZE}>:${sanitizers} -fno-omit-frame-pointer>)
target_link_options(plumb_strict INTERFACE
  $<$<BOOL:${PLUMB_SANITIZE}>:${sanitizers}>)

if(PLUMB_ARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-march=${PLUMB_ARCH})
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")  # lines for stack traces; -g adds a third to the build
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# plumb_program(name sources... LIBS libs...): a program in bin/, named as given, installed.
# A main source starts things; CLI11 in it takes twice as long to optimise for speed.
function(plumb_program name)
  cmake_parse_arguments(ARG "" "" "LIBS" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE plumb_strict ${ARG_LIBS})
  set_source_files_properties(${ARG_UNPARSED_ARGUMENTS} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
