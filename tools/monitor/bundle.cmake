# Bundles the page: cmake -DNPM=... -DSOURCES=... -DOUT=... -P bundle.cmake
#
# Leaves index.html, page.js and page.css in OUT/dist. Without npm, or where its packages cannot be
# fetched, they are empty: the program then says that it has no page, and nothing else of the build
# depends on it. OUT/bundled is written when there is a page, so that the build tries again otherwise.
set(files index.html page.js page.css)
file(MAKE_DIRECTORY ${OUT}/dist)

function(leave_empty why)
  foreach(name ${files})
    file(WRITE ${OUT}/dist/${name} "")
  endforeach()
  message(NOTICE "plumb-monitor has no page: ${why}")
endfunction()

if(NOT NPM)
  leave_empty("npm is not installed")
  return()
endif()
file(SHA256 ${SOURCES}/package-lock.json wanted)
set(fetched "")
if(EXISTS ${OUT}/fetched)
  file(READ ${OUT}/fetched fetched)
endif()
if(NOT fetched STREQUAL wanted)
  file(COPY ${SOURCES}/package.json ${SOURCES}/package-lock.json DESTINATION ${OUT})
  execute_process(
    COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --silent --fetch-retries=1
    WORKING_DIRECTORY ${OUT} RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
  if(NOT code EQUAL 0)
    leave_empty("npm cannot fetch its packages")
    return()
  endif()
  file(WRITE ${OUT}/fetched ${wanted})
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${OUT}/node_modules ${OUT}/node_modules/.bin/esbuild ${SOURCES}/page.js
    --bundle --minify --target=es2021 --log-level=warning --outdir=${OUT}/dist
  RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the page cannot be bundled")
endif()
file(COPY ${SOURCES}/index.html DESTINATION ${OUT}/dist)
file(WRITE ${OUT}/bundled "")
