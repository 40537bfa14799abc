# st-raster at many rank counts.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME mpi.raster_ranks COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/raster_ranks_test.py)
set_tests_properties(mpi.raster_ranks PROPERTIES LABELS mpi TIMEOUT 300 PROCESSORS 2 FIXTURES_REQUIRED models
  ENVIRONMENT "ST_BIN=${CMAKE_BINARY_DIR}/bin;ST_MODELS=${CMAKE_BINARY_DIR}/test_models;ST_WORK=${CMAKE_BINARY_DIR}/test_work;PYTHONDONTWRITEBYTECODE=1")
