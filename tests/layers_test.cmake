# The list has the layers, lowest first. A file includes nothing of a later layer, and platform
# includes nothing of modules.
#
# Purity: core and each module's own library reach no I/O, clock, transport, OpenCV or platform.
# Files that may are known by their place (datasets, chain, processes) or by their name (*_wire.*,
# *_node.*, *_source.*).
set(layers core platform
  modules/datasets modules/detections modules/integrity modules/camera modules/detector modules/vo
  modules/ground/types modules/ground/filter modules/ground/covariance modules/ground/cues modules/ground/ego modules/ground
  modules/ground_paper modules/mount modules/vehicle modules/objects modules/can modules/chain modules/processes
  tools tests)

# Finds the layer of a path below the root, which is the longest one that is a prefix of it.
function(layer_of path result)
  set(best "")
  foreach(layer ${layers})
    string(LENGTH "${layer}/" length)
    string(SUBSTRING "${path}/" 0 ${length} head)
    string(LENGTH "${best}" best_length)
    if(head STREQUAL "${layer}/" AND length GREATER best_length)
      set(best ${layer})
    endif()
  endforeach()
  set(${result} "${best}" PARENT_SCOPE)
endfunction()

file(GLOB_RECURSE files RELATIVE ${ROOT}
  ${ROOT}/core/*.?pp ${ROOT}/platform/*.?pp ${ROOT}/modules/*.?pp)
foreach(file ${files})
  layer_of(${file} layer)
  if(layer STREQUAL "")
    message(SEND_ERROR "${file} is in no layer")
    continue()
  endif()
  list(FIND layers ${layer} rank)
  file(STRINGS ${ROOT}/${file} includes REGEX "^#include \"(core|platform|modules|tools|tests)/")
  foreach(include ${includes})
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" included "${include}")
    layer_of(${included} other)
    list(FIND layers "${other}" other_rank)
    if(other_rank EQUAL -1 OR other_rank GREATER rank)
      message(SEND_ERROR "${file} (${layer}) includes ${included}, of a later layer")
    endif()
  endforeach()

  if(file MATCHES "^(platform|modules/(datasets|chain|processes))/|_(wire|node|source)\\.(hpp|cpp)$")
    continue()
  endif()
  file(STRINGS ${ROOT}/${file} hits REGEX
    "#include <(lcm/|iostream|fstream|cstdio|chrono|thread|mutex|opencv|jpeglib|linux/|sys/|unistd|toml)|#include \"(plumb/|platform/)")
  if(hits)
    message(SEND_ERROR "${file} belongs to a pure library, but: ${hits}")
  endif()
endforeach()
