# One interface target carries every flag. A target opts in by linking it.
add_library(plumb_strict INTERFACE)
target_compile_features(plumb_strict INTERFACE cxx_std_20)
target_include_directories(plumb_strict INTERFACE ${PROJECT_SOURCE_DIR})
# Three checks are switched off. gcc 12 crashes with vptr inside lcm-cpp. The checks null and
# alignment at every reference make the compilation of unrolled Eigen code take minutes and 2 GB;
# AddressSanitizer reports null pointers as well, and Eigen asserts the alignment of what it
# vectorises.
set(sanitizers -fsanitize=address,undefined -fno-sanitize=vptr,null,alignment)
# errno and trapping maths only prevent loops from being vectorised. -ffast-math is never used: sums
# keep their order, so that the same input gives the same bits. Contraction is off for the same
# reason.
target_compile_options(plumb_strict INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror
  -fno-math-errno -fno-trapping-math -ffp-contract=off
  $<$<CONFIG:Debug>:-DEIGEN_INITIALIZE_MATRICES_BY_NAN>
  $<$<BOOL:${PLUMB_SANITIZE}>:${sanitizers} -fno-omit-frame-pointer>
  $<$<BOOL:${PLUMB_FUZZ}>:-fsanitize=fuzzer-no-link -fno-sanitize-recover=all>)
# Eigen's own vectors would sum in an order and with fused operations that depend on the processor. Its
# loops are left to the compiler, which keeps the order, so that every processor gives the same bits.
target_compile_definitions(plumb_strict INTERFACE EIGEN_DONT_VECTORIZE)
# An error in the handling of memory ends a program instead of being used by somebody: canaries on
# the stack, checked copies, marked targets of jumps, tables that are read-only after the start.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64")
  set(guarded_jumps -mbranch-protection=standard)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(guarded_jumps -fcf-protection)
endif()
target_compile_options(plumb_strict INTERFACE
  -fstack-protector-strong -fstack-clash-protection ${guarded_jumps}
  $<$<AND:$<CONFIG:Release>,$<NOT:$<BOOL:${PLUMB_SANITIZE}>>>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3>)
# A program loads the libraries that it calls, and no others that come with them.
target_link_options(plumb_strict INTERFACE
  -Wl,--as-needed -Wl,-z,relro,-z,now,-z,noexecstack
  $<$<BOOL:${PLUMB_SANITIZE}>:${sanitizers}>)

if(PLUMB_ARCH AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-march=${PLUMB_ARCH})
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")  # line numbers only: -g makes the build a third longer
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# plumb_program(name sources... LIBS libs... COMPONENT package FOLDER folder) adds a program to bin/ or FOLDER; it is installed
# when it has been built, as part of the tools or of another package. Its main source is compiled with -O1, because it only connects what the libraries do.
function(plumb_program name)
  cmake_parse_arguments(ARG "" "COMPONENT;FOLDER" "LIBS" ${ARGN})
  if(NOT ARG_COMPONENT)
    set(ARG_COMPONENT tools)
  endif()
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER ${CMAKE_INSTALL_BINDIR})
  endif()
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${ARG_FOLDER})
  target_link_libraries(${name} PRIVATE plumb_strict ${ARG_LIBS})
  set_source_files_properties(${ARG_UNPARSED_ARGUMENTS} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
  # tools/demo builds some of the programs. What has been built is installed, the rest is named.
  install(TARGETS ${name} RUNTIME DESTINATION ${ARG_FOLDER} COMPONENT ${ARG_COMPONENT} OPTIONAL)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${name}>\")
  message(STATUS \"Left out, because it has not been built: ${name}\")
endif()" COMPONENT ${ARG_COMPONENT})
endfunction()
