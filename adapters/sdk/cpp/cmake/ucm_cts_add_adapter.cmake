# ucm_cts_add_adapter(<name> [NO_PYTHON] <source>...)
#
# One of the sources has UCM_CTS_ADAPTER(...). Makes <name>_host, the stand-alone executable (its file is called <name>),
# and <name>, the Python module. Without pybind11, or with NO_PYTHON, there is only the executable.
# Link your framework to both: target_link_libraries(<name>_host PRIVATE ...), target_link_libraries(<name> PRIVATE ...).
function(ucm_cts_add_adapter name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_PYTHON" "" "")
  add_executable(${name}_host ${arg_UNPARSED_ARGUMENTS})
  target_link_libraries(${name}_host PRIVATE ucm_cts::headers)
  # function names in backtraces
  set_target_properties(${name}_host PROPERTIES OUTPUT_NAME ${name} ENABLE_EXPORTS ON CXX_EXTENSIONS OFF)

  if(NOT arg_NO_PYTHON AND COMMAND pybind11_add_module)
    pybind11_add_module(${name} ${arg_UNPARSED_ARGUMENTS})
    target_link_libraries(${name} PRIVATE ucm_cts::headers)
    target_compile_definitions(${name} PRIVATE UCM_CTS_PYTHON_MODULE=${name})
    target_compile_features(${name} PRIVATE cxx_std_17)
  endif()
endfunction()
