# Builds robots with Yamaro, with or without ROS.
#
#   yamaro_add_robot(<file>
#     [TO <format>...]               urdf (the default), sdf, mjcf, srdf, usd, interface,
#                                  mjlab, isaaclab, controllers
#     [OUTPUT <path>...]             one for each format; relative to CMAKE_CURRENT_BINARY_DIR
#     [VARIABLES <name:=value>...]   as on the command line
#     [TRUST trust|jail|safe]        how far the file is trusted; by default trust
#     [MESHES <how>]                 see `yamaro --meshes`
#     [OPTIONS <option>...]          other options of yamaro, such as --strict
#     [INSTALL_DESTINATION <folder>] where `install` puts the robot
#     [TARGET <name>]                the name of the target; by default the robot's
#     [CHECK])                       also adds a test that runs `yamaro check`
#
# The target is built by default. Its property YAMARO_OUTPUTS lists the files. A robot is built again
# when a file changes that it was made of, also one that was included later.

if(CMAKE_VERSION VERSION_LESS 3.20)
  message(FATAL_ERROR "yamaro_add_robot needs CMake 3.20 or newer, not ${CMAKE_VERSION}")
endif()
cmake_policy(PUSH)
cmake_policy(VERSION 3.20...3.31)

find_program(YAMARO_COMMAND yamaro
  HINTS "${CMAKE_CURRENT_LIST_DIR}/../../../bin" "${CMAKE_CURRENT_LIST_DIR}/../../../Scripts"
  DOC "The command yamaro")

# For callers in all folders, as functions are.
set(_YAMARO_ENDING_urdf .urdf CACHE INTERNAL "")
set(_YAMARO_ENDING_sdf .sdf CACHE INTERNAL "")
set(_YAMARO_ENDING_mjcf .xml CACHE INTERNAL "")
set(_YAMARO_ENDING_srdf .srdf CACHE INTERNAL "")
set(_YAMARO_ENDING_usd .usda CACHE INTERNAL "")
set(_YAMARO_ENDING_interface .interface.json CACHE INTERNAL "")
set(_YAMARO_ENDING_mjlab _mjlab.py CACHE INTERNAL "")
set(_YAMARO_ENDING_isaaclab _isaaclab.py CACHE INTERNAL "")
set(_YAMARO_ENDING_controllers _controllers.yaml CACHE INTERNAL "")

# Sets `out` to the name of a robot's file without its endings: rover for rover.urdf.yaml.
function(_yamaro_name file out)
  get_filename_component(name "${file}" NAME)
  string(REGEX REPLACE "\\.(yaml|yml|xacro|urdf|xml|sdf|world|mjcf)$" "" name "${name}")
  string(REGEX REPLACE "\\.(urdf|yamaro|xacro)$" "" name "${name}")
  set(${out} "${name}" PARENT_SCOPE)
endfunction()

# Stops with a message that says what to write.
function(_yamaro_fail file message)
  message(FATAL_ERROR "yamaro_add_robot(${file}): ${message}")
endfunction()

# Sets `out` to the default of MESHES: in a ROS package, names that ROS reads; otherwise what can be
# installed together with the robot.
function(_yamaro_meshes destination out)
  set(how "")
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/package.xml" OR EXISTS "${PROJECT_SOURCE_DIR}/package.xml")
    set(how "package://")
  elseif(destination)
    set(how copy)
  endif()
  set(${out} "${how}" PARENT_SCOPE)
endfunction()

# Adds the command that builds one document, with the words that follow on its command line.
function(_yamaro_add_document target source format output meshes)
  set(words ${ARGN})
  if(NOT format STREQUAL "urdf")
    list(APPEND words --to ${format})
  endif()
  if(format MATCHES "^(urdf|sdf)$" AND NOT meshes STREQUAL "")
    list(APPEND words --meshes "${meshes}")
  endif()
  get_filename_component(name "${output}" NAME)
  string(SHA256 hash "${output}")
  string(SUBSTRING "${hash}" 0 16 hash)
  set(depfile "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/yamaro/${name}-${hash}.d")
  set(forget "")
  if(CMAKE_GENERATOR MATCHES "Makefiles")
    # CMake adds each depfile to those it has read before. So an include that was deleted would make
    # the robot out of date for ever.
    set(forget COMMAND "${CMAKE_COMMAND}" -E rm -f
      "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/compiler_depend.internal")
  endif()
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${YAMARO_COMMAND}" "${source}" ${words} -o "${output}" --depfile "${depfile}"
    ${forget}
    DEPENDS "${source}" "${YAMARO_COMMAND}"
    DEPFILE "${depfile}"
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}"
    COMMENT "Building ${name} with Yamaro"
    VERBATIM)
endfunction()

# Installs a document, and what is beside it: meshes, and the scene of MuJoCo.
function(_yamaro_install output format meshes destination)
  get_filename_component(folder "${output}" DIRECTORY)
  install(FILES "${output}" DESTINATION "${destination}")
  if(format STREQUAL "mjcf")
    install(FILES "${folder}/scene.xml" DESTINATION "${destination}" OPTIONAL)
  endif()
  if(format STREQUAL "mjcf" OR meshes STREQUAL "copy")
    install(DIRECTORY "${folder}/assets" DESTINATION "${destination}" OPTIONAL)
  endif()
endfunction()

# Adds a test that runs `yamaro check`; where ament wants results, it also writes a report.
function(_yamaro_add_check source name formats)
  set(words ${ARGN})
  if(words)
    list(REMOVE_ITEM words --gazebo) # is about what is written
  endif()
  if(NOT formats STREQUAL "urdf")
    string(REPLACE ";" "," formats "${formats}")
    list(APPEND words --to "${formats}")
  endif()
  if(AMENT_TEST_RESULTS_DIR)
    list(APPEND words --format junit
      -o "${AMENT_TEST_RESULTS_DIR}/${PROJECT_NAME}/yamaro_check_${name}.xunit.xml")
  endif()
  add_test(NAME yamaro_check_${name}
    COMMAND "${YAMARO_COMMAND}" check "${source}" ${words}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
endfunction()

# Sets in the caller's scope what the arguments leave out; stops if they make no sense.
macro(_yamaro_complete_arguments file source)
  if(NOT YAMARO_COMMAND)
    _yamaro_fail("${file}" "the command 'yamaro' is not found: install it with 'pip install yamaro', \
or name it with -DYAMARO_COMMAND=/path/to/yamaro")
  endif()
  if(robot_UNPARSED_ARGUMENTS)
    _yamaro_fail("${file}" "unknown argument '${robot_UNPARSED_ARGUMENTS}'")
  endif()
  if(robot_KEYWORDS_MISSING_VALUES)
    _yamaro_fail("${file}" "nothing follows ${robot_KEYWORDS_MISSING_VALUES}")
  endif()
  if(NOT EXISTS "${source}")
    _yamaro_fail("${file}" "there is no file ${source}")
  endif()
  if(NOT robot_TO)
    set(robot_TO urdf)
  endif()
  foreach(format IN LISTS robot_TO)
    if(NOT DEFINED _YAMARO_ENDING_${format})
      _yamaro_fail("${file}" "unknown format '${format}'; TO takes urdf, sdf, mjcf, srdf, usd, interface, \
mjlab, isaaclab and controllers")
    endif()
  endforeach()
  list(LENGTH robot_TO count)
  list(LENGTH robot_OUTPUT given)
  if(given AND NOT given EQUAL count)
    _yamaro_fail("${file}" "TO and OUTPUT do not agree: formats: ${count}, files: ${given}")
  endif()
  if(NOT DEFINED robot_MESHES)
    _yamaro_meshes("${robot_INSTALL_DESTINATION}" robot_MESHES)
  endif()
  set(trust "")
  if(DEFINED robot_TRUST)
    if(NOT robot_TRUST MATCHES "^(trust|jail|safe)$")
      _yamaro_fail("${file}" "TRUST is trust, jail or safe, not '${robot_TRUST}'")
    endif()
    set(trust --${robot_TRUST})
  endif()
endmacro()

function(yamaro_add_robot file)
  cmake_parse_arguments(PARSE_ARGV 1 robot "CHECK" "TRUST;MESHES;INSTALL_DESTINATION;TARGET"
    "TO;OUTPUT;VARIABLES;OPTIONS")
  get_filename_component(source "${file}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}")
  _yamaro_complete_arguments("${file}" "${source}")
  _yamaro_name("${source}" name)
  if(NOT robot_TARGET)
    set(robot_TARGET "${name}")
  endif()
  set(words ${robot_VARIABLES} ${trust} ${robot_OPTIONS})

  set(outputs "")
  foreach(format IN LISTS robot_TO)
    set(folder "")
    if(format STREQUAL "mjcf") # which comes with files of fixed names
      set(folder "${name}_mjcf/")
    endif()
    set(path "${folder}${name}${_YAMARO_ENDING_${format}}")
    if(robot_OUTPUT)
      list(POP_FRONT robot_OUTPUT path)
    endif()
    get_filename_component(output "${path}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
    _yamaro_add_document(${robot_TARGET} "${source}" ${format} "${output}" "${robot_MESHES}" ${words})
    list(APPEND outputs "${output}")
    if(DEFINED robot_INSTALL_DESTINATION)
      set(destination "${robot_INSTALL_DESTINATION}/${folder}")
      _yamaro_install("${output}" ${format} "${robot_MESHES}" "${destination}")
    endif()
  endforeach()

  add_custom_target(${robot_TARGET} ALL DEPENDS ${outputs} SOURCES "${source}")
  set_target_properties(${robot_TARGET} PROPERTIES YAMARO_OUTPUTS "${outputs}")
  if(robot_CHECK AND (BUILD_TESTING OR NOT DEFINED BUILD_TESTING))
    _yamaro_add_check("${source}" ${robot_TARGET} "${robot_TO}" ${words})
  endif()
endfunction()

cmake_policy(POP)
