# Installs what the package of the vehicle has, twice, as an upgrade does, and lets systemd judge the
# units.
set(security_limit 20)  # tenths of systemd-analyze's exposure level, of 100

# install_to(root component): as a package does.
function(install_to root component)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env DESTDIR=${root}
    ${CMAKE_COMMAND} --install ${BUILD} --prefix /usr --component ${component} OUTPUT_VARIABLE said
    COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]*has not been built[^\n]*" missing "${said}")
  if(missing)
    message("${missing}")
  endif()
endfunction()

file(REMOVE_RECURSE ${OUT})
set(root ${OUT}/root)
install_to(${root} vehicle)
foreach(path usr/bin/plumb-vo usr/bin/plumb-status etc/plumbline/vehicle.toml etc/plumbline/environment
    usr/lib/systemd/system/plumbline.target usr/lib/systemd/system/plumb-can.service usr/lib/sysctl.d/50-plumbline.conf)
  if(NOT EXISTS ${root}/${path})
    message(SEND_ERROR "${path} is not installed")
  endif()
endforeach()
if(EXISTS ${root}/usr/bin/plumb-replay)
  message(SEND_ERROR "a tool is in the package of the vehicle")
endif()

# The settings that are shipped are settings.
execute_process(COMMAND ${root}/usr/bin/plumb-can --print-config --config ${root}/etc/plumbline/vehicle.toml
  --config ${root}/etc/plumbline/camera.toml --config ${root}/etc/plumbline/site.toml OUTPUT_VARIABLE settings
  COMMAND_ERROR_IS_FATAL ANY)
if(NOT settings MATCHES "images_kept = 10 " OR NOT settings MATCHES "device = \"/dev/video0\"")
  message(SEND_ERROR "the shipped settings are not what is printed")
endif()

# What the owner changed stays.
file(WRITE ${root}/etc/plumbline/site.toml "[ground]\ncamera_height_m = 1.4\n")
install_to(${root} vehicle)
file(READ ${root}/etc/plumbline/site.toml kept)
if(NOT kept MATCHES "1.4")
  message(SEND_ERROR "an upgrade replaced site.toml")
endif()

# Every option that a unit gives exists.
file(GLOB units ${root}/usr/lib/systemd/system/plumb-*.service)
list(LENGTH units count)
if(NOT count EQUAL 6)
  message(SEND_ERROR "there are ${count} units of processes, not 6")
endif()
foreach(unit ${units})
  file(STRINGS ${unit} start REGEX "^ExecStart=")
  string(REGEX REPLACE "^ExecStart=([^ ]+) .*" "\\1" program "${start}")
  string(REGEX MATCHALL "--[a-z-]+" options "${start}")
  execute_process(COMMAND ${root}${program} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  foreach(option ${options})
    if(NOT help MATCHES "${option}[ ,\n]")
      message(SEND_ERROR "${unit} gives ${option}, which ${program} does not have")
    endif()
  endforeach()
endforeach()

find_program(ANALYZE systemd-analyze)
if(NOT ANALYZE)
  message("systemd-analyze is not here; the units were not judged")
  return()
endif()
foreach(unit ${units})
  execute_process(COMMAND ${ANALYZE} security --no-pager --offline=yes --threshold=${security_limit} ${unit}
    RESULT_VARIABLE code OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX MATCH "Overall exposure level[^\n]*" level "${said}")
  get_filename_component(name ${unit} NAME)
  message("${name}: ${level}")
  if(NOT code EQUAL 0)
    message(SEND_ERROR "${name} is more exposed than ${security_limit}: ${said}")
  endif()
endforeach()
# systemd looks for the programs, which are below the root.
file(GLOB all ${root}/usr/lib/systemd/system/*)
foreach(unit ${all})
  file(READ ${unit} text)
  get_filename_component(name ${unit} NAME)
  string(REPLACE "ExecStart=/usr/bin" "ExecStart=${root}/usr/bin" text "${text}")
  file(WRITE ${OUT}/units/${name} "${text}")
endforeach()
file(GLOB copies ${OUT}/units/*)
execute_process(COMMAND ${ANALYZE} verify --man=no ${copies} OUTPUT_VARIABLE said ERROR_VARIABLE said)
string(REGEX MATCHALL "[^\n]*plumb[^\n]*" faults "${said}")
if(faults)
  message(SEND_ERROR "systemd-analyze verify: ${faults}")
endif()
