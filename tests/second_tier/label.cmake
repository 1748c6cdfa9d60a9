set_tests_properties(
    bytes.compilers
    PROPERTIES LABELS more)
