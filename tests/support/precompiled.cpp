// What compiles the header that the tests share (tests/CMakeLists.txt).
