# Runs at installation: writes the units and the configuration for the prefix that the programs go to.
# Below /usr the configuration goes to /etc. A configuration that is there stays as it is.
set(from @CMAKE_CURRENT_SOURCE_DIR@)
set(made @CMAKE_CURRENT_BINARY_DIR@/units)
set(BIN_DIR ${CMAKE_INSTALL_PREFIX}/@CMAKE_INSTALL_BINDIR@)
set(DOC_DIR ${CMAKE_INSTALL_PREFIX}/@CMAKE_INSTALL_DOCDIR@)
set(ETC_DIR ${CMAKE_INSTALL_PREFIX}/etc/plumbline)
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(ETC_DIR /etc/plumbline)
endif()

# write_unit(name summary priority memory KEY VALUE...): the unit of plumb-NAME.
function(write_unit NAME SUMMARY PRIORITY MEMORY)
  set(AFTER "")
  set(OPTIONS "")
  set(FAMILIES "")
  set(LIMIT_INTERVAL 60)
  set(RESTART 100ms)
  set(DEVICES "PrivateDevices=yes\nProcSubset=pid")
  cmake_parse_arguments(PARSE_ARGV 4 ARG "" "AFTER;OPTIONS;FAMILIES;LIMIT_INTERVAL;RESTART;DEVICES" "")
  foreach(key AFTER OPTIONS FAMILIES LIMIT_INTERVAL RESTART DEVICES)
    if(DEFINED ARG_${key})
      set(${key} "${ARG_${key}}")
    endif()
  endforeach()
  configure_file(${from}/systemd/plumb-process.service.in ${made}/plumb-${NAME}.service @ONLY)
endfunction()

file(REMOVE_RECURSE ${made})
# Later stages come first when CPUs are scarce: what is measured must reach the bus.
write_unit(can "the results on CAN" 30 24M FAMILIES " AF_CAN" OPTIONS " --interface \${CAN_INTERFACE}")
write_unit(objects "objects on the road" 10 32M AFTER " plumb-can.service")
write_unit(ground "the road plane and the scale" 20 256M AFTER " plumb-can.service plumb-objects.service")
write_unit(vo "visual odometry" 20 128M AFTER " plumb-ground.service")
# A camera may be plugged in at any time, so it is looked for without end.
write_unit(camera "the camera" 25 192M AFTER " plumb-vo.service plumb-ground.service"
  LIMIT_INTERVAL 0 RESTART 1s DEVICES "SupplementaryGroups=video\nDeviceAllow=char-video4linux rw\nDevicePolicy=closed")
# Not every vehicle states its speed on a bus, so the target starts it only where it has been enabled.
write_unit(vehicle "the vehicle's own speed" 10 24M FAMILIES " AF_CAN" AFTER " plumb-ground.service"
  OPTIONS " --interface \${VEHICLE_CAN_INTERFACE}")
foreach(unit plumbline.target plumbline-lcm.service)
  configure_file(${from}/systemd/${unit} ${made}/${unit} @ONLY)
endforeach()

file(GLOB units ${made}/*)
file(INSTALL ${units} DESTINATION ${CMAKE_INSTALL_PREFIX}/lib/systemd/system)
file(GLOB settings ${from}/etc/*)
foreach(file ${settings})
  get_filename_component(name ${file} NAME)
  if(NOT EXISTS $ENV{DESTDIR}${ETC_DIR}/${name})
    file(INSTALL ${file} DESTINATION ${ETC_DIR})
  endif()
endforeach()
