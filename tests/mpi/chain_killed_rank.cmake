# Ranks that signals end.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME mpi.killed_rank COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/killed_rank_test.py)
set_tests_properties(mpi.killed_rank PROPERTIES LABELS mpi TIMEOUT 300 PROCESSORS 2 FIXTURES_REQUIRED models
  ENVIRONMENT "ST_BIN=${CMAKE_BINARY_DIR}/bin;ST_MODELS=${CMAKE_BINARY_DIR}/test_models;ST_WORK=${CMAKE_BINARY_DIR}/test_work;PYTHONDONTWRITEBYTECODE=1")
