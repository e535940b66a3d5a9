# Installs the build tree into a fresh folder, then configures, builds and runs the consumer against it.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}")
  endif()
endfunction()

file(REMOVE_RECURSE ${work_dir})
unset(ENV{DESTDIR})
run(${CMAKE_COMMAND} --install ${build_dir} --prefix ${work_dir}/first)
# The tree must not remember where it was installed.
file(RENAME ${work_dir}/first ${work_dir}/installed)
run(${CMAKE_COMMAND} -S ${consumer_dir} -B ${work_dir}/build -G ${generator} -D CMAKE_PREFIX_PATH=${work_dir}/installed
    -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_CXX_FLAGS=${flags} -D CMAKE_BUILD_TYPE=${build_type} -D expected_version=${version})
run(${CMAKE_COMMAND} --build ${work_dir}/build)
run(${work_dir}/build/consumer)
if(EXISTS ${work_dir}/installed/bin/gvd)
  run(${work_dir}/installed/bin/gvd --version)
endif()
