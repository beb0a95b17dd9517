# Fails on an #include that runs against the layers:
#
#   components  <-  systems  <-  engine  <-  demo  <-  bench
#
# demo and bench know the engine by its C header alone, but for bench/systems/, which times it from inside; Bullet is
# behind systems/collision* (and bench/bullet*, the peer), OSMesa and GL behind demo/picture; a system does not include
# another one, only what several of them share.
cmake_minimum_required(VERSION 3.22)

# What systems share: no systems themselves.
set(shared_by_systems angle body_topology box box_tree capsule_lanes capsule_rows capsule_shape clearance_list close_pairs
    closeness closest_points collision_bodies collision_hull contact_row edge_limit edge_pass facing mesh_facing
    mesh_pairs mesh_pose near_search point_grid rigid_fit triangle_pairs)

set(faults "")
macro(fault text)
  string(APPEND faults "  ${file} includes ${included}: ${text}\n")
endmacro()

set(checked 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/components/*.h ${ROOT}/components/*.cpp ${ROOT}/systems/*.h
     ${ROOT}/systems/*.cpp ${ROOT}/engine/*.h ${ROOT}/engine/*.cpp ${ROOT}/demo/*.h ${ROOT}/demo/*.cpp
     ${ROOT}/bench/*.h ${ROOT}/bench/*.cpp)
foreach(file ${files})
  string(REGEX MATCH "^[a-z]+" layer ${file})
  get_filename_component(unit ${file} NAME_WE)
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line ${lines})
    if(NOT line MATCHES "include[ \t]*([<\"])([^>\"]+)[>\"]")
      continue()
    endif()
    set(quote "${CMAKE_MATCH_1}")
    set(included "${CMAKE_MATCH_2}")
    math(EXPR checked "${checked} + 1")

    # Third parties.
    if(included MATCHES "^(bullet/|btBullet|LinearMath/|Bullet[A-Za-z]+/)" AND NOT file MATCHES "^(systems/collision|bench/bullet)")
      fault("Bullet belongs to systems/collision*, and to bench/bullet* to compare with")
    endif()
    if(included MATCHES "^GL/|osmesa" AND NOT file MATCHES "^demo/picture/")
      fault("OSMesa and GL belong to demo/picture")
    endif()
    if(included MATCHES "^Eigen/" AND NOT layer MATCHES "^(demo|bench)$" AND NOT file STREQUAL "systems/implicit_solver.cpp")
      fault("below demo and bench Eigen belongs to systems/implicit_solver.cpp")
    endif()
    if(layer STREQUAL "components" AND quote STREQUAL "<" AND included MATCHES "/")
      fault("components need the standard library only")
    endif()

    # Our own layers.
    if(NOT included MATCHES "^(components|systems|engine|demo|bench|tests)/")
      continue()
    endif()
    string(REGEX MATCH "^[a-z]+" below ${included})
    if(below STREQUAL layer)
      get_filename_component(other ${included} NAME_WE)
      if(layer STREQUAL "systems" AND NOT other STREQUAL unit AND NOT other IN_LIST shared_by_systems)
        fault("a system includes no other system")
      endif()
    elseif(layer STREQUAL "components" OR below STREQUAL "tests")
      fault("the arrow runs the wrong way")
    elseif(layer STREQUAL "systems" AND NOT below STREQUAL "components")
      fault("the arrow runs the wrong way")
    elseif(layer STREQUAL "engine" AND NOT below MATCHES "^(components|systems)$")
      fault("the arrow runs the wrong way")
    elseif(layer MATCHES "^(demo|bench)$" AND below MATCHES "^(components|systems|engine)$" AND
           NOT included STREQUAL "engine/pleat.h" AND NOT file MATCHES "^bench/systems/")
      fault("demo and bench use engine/pleat.h only")
    elseif(layer STREQUAL "demo" AND below STREQUAL "bench")
      fault("the arrow runs the wrong way")
    endif()
  endforeach()
endforeach()

if(checked LESS 100)
  message(FATAL_ERROR "only ${checked} #include lines found under ${ROOT}: the test looks in the wrong place")
endif()
if(faults)
  message(FATAL_ERROR "#include lines against the layers:\n${faults}")
endif()
message(STATUS "${checked} #include lines follow the layers")
