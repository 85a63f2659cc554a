# Installs into an empty prefix, builds a program against what was installed, and runs it and the installed relevo.
# BUILD: the build tree; WORK: a folder of our own; COMPILER, FLAGS, TYPE, VIEWER: as the build tree has them.
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}: ${status}\n${output}")
  endif()
  message(STATUS "${output}")
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/consumer -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${prefix}
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${TYPE})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${prefix}/bin/relevo --version)

if(VIEWER)
  # The example of the library, from a file of heights to a picture.
  run(${CMAKE_COMMAND} -S ${prefix}/share/doc/relevo/examples -B ${WORK}/examples -G Ninja
      -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS}
      -DCMAKE_BUILD_TYPE=${TYPE})
  run(${CMAKE_COMMAND} --build ${WORK}/examples)
  set(rows)
  foreach(y RANGE 32)
    foreach(x RANGE 32)
      math(EXPR height "${x} * (32 - ${x}) + ${y} * (32 - ${y})")
      string(APPEND rows "${height} ")
    endforeach()
    string(APPEND rows "\n")
  endforeach()
  file(WRITE ${WORK}/hill.asc "ncols 33\nnrows 33\nxllcenter 9\nyllcenter 47\ncellsize 0.001\n${rows}")
  file(WRITE ${WORK}/hill.prj "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],\
PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]")
  run(${WORK}/examples/fly_over ${WORK}/hill.asc ${WORK}/flight 1)
  if(NOT EXISTS ${WORK}/flight/flight-01.png)
    message(FATAL_ERROR "fly_over left no picture")
  endif()
endif()
