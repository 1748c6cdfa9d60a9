# Turns a file of GLSL or of Metal's language into C++ that computes in float: literals get the suffix
# f, without which C++ would go on in double. Metal's swizzles become calls (metal_stdlib).
#   cmake -DFROM=sky_view.glsl -DTO=sky_view.glsl.h -P glsl_to_cpp.cmake
file(READ ${FROM} text)
# Semicolons and brackets mean something to CMake's lists, not to its strings.
string(REGEX REPLACE "(^|[^A-Za-z0-9_.])([0-9]+\\.[0-9]+([eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+)" "\\1\\2f"
    text "${text}")
if(FROM MATCHES "\\.msl$")
    string(REGEX REPLACE "\\.(xyz|rgb|xy)([^A-Za-z0-9_])" ".\\1()\\2" text "${text}")
endif()
file(WRITE ${TO} "${text}")
