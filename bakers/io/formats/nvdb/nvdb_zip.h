// Streams of zlib, by which NanoVDB files may be compressed.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

namespace skybake {

// Returns the bytes that a stream makes, or null if it is damaged or makes more or fewer of them. Memory
// is taken as it is written to.
std::unique_ptr<char[]> inflated_stream(std::string_view stream, std::size_t bytes);

}  // namespace skybake
