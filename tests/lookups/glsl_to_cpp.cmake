# Turns a file of GLSL into C++ that computes in float: literals get the suffix f, without which C++
# would go on in double.
#   cmake -DFROM=sky_view.glsl -DTO=sky_view.glsl.h -P glsl_to_cpp.cmake
file(READ ${FROM} text)
# Semicolons and brackets mean something to CMake's lists, not to its strings.
string(REGEX REPLACE "(^|[^A-Za-z0-9_.])([0-9]+\\.[0-9]+([eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+)" "\\1\\2f"
    text "${text}")
file(WRITE ${TO} "${text}")
