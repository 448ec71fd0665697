# Read by ctest after fly_test's cases were found: they run in real time, so nothing beside them.
set_tests_properties(${fly_test_TESTS} PROPERTIES RUN_SERIAL TRUE)
