// Reading a small text file, with a bound on its size.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <variant>

namespace skybake::config {

// A recipe and each file that it includes may be as long as this.
inline constexpr std::size_t most_recipe_bytes = std::size_t{4} << 20;

struct FileError {
    bool too_large = false;
    std::string reason;  // "No such file or directory"
};

// At most one byte more than `most_bytes` is read, so that a file of any size, or a device without
// end, is refused at once. A leading UTF-8 byte order mark is left out.
std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes);

// The same of standard input, to its end.
std::variant<std::string, FileError> read_standard_input(std::size_t most_bytes);

std::string without_byte_order_mark(std::string text);

}  // namespace skybake::config
