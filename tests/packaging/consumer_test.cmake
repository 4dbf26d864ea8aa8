# Installs the headers and libraries, and lets another project find, compile, link and run them, by
# CMake and by pkg-config.
if(SANITIZED)
  message("the libraries of this build need the sanitizer; what others consume has not been built")
  return()
endif()
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${OUT}/prefix --component dev OUTPUT_QUIET
  COMMAND_ERROR_IS_FATAL ANY)
set(source ${CMAKE_CURRENT_LIST_DIR}/consumer)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${source} -B ${OUT}/build -DCMAKE_PREFIX_PATH=${OUT}/prefix
  -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=-O0 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${OUT}/build OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/build/consumer OUTPUT_VARIABLE said RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT said STREQUAL "image 11, measured\n")
  message(SEND_ERROR "the consumer ends with ${code} and says: ${said}")
endif()

file(GLOB_RECURSE pc ${OUT}/prefix/plumbline.pc)
get_filename_component(folder ${pc} DIRECTORY)
execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} pkg-config --cflags --libs plumbline
  OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
file(WRITE ${OUT}/message.cpp "#include <plumb/vo_motion_t.hpp>
#include <core/counters.hpp>
int main() { return plumb::vo_motion_t::getHash() == 0; }
")
execute_process(COMMAND ${CXX} ${OUT}/message.cpp ${flags} -o ${OUT}/by_pkg_config COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OUT}/by_pkg_config COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)

# The messages for Python.
find_program(PYTHON python3)
file(GLOB_RECURSE module ${OUT}/prefix/lib/python3/*/plumb/__init__.py)
if(NOT module)
  message(SEND_ERROR "the messages for Python are not installed")
endif()

# The messages for Java, where this machine can make them.
find_program(JAR jar)
find_program(JAVAC javac)
if(JAR AND JAVAC AND EXISTS /usr/share/java/lcm.jar)
  execute_process(COMMAND ${JAR} tf ${OUT}/prefix/share/java/plumbline-types.jar OUTPUT_VARIABLE classes
    COMMAND_ERROR_IS_FATAL ANY)
  if(NOT classes MATCHES "plumb/ego_motion_t.class")
    message(SEND_ERROR "the messages for Java are not in their JAR: ${classes}")
  endif()
endif()
