#include "config/text/text_file.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace skybake::config {
namespace {

FileError system_error() { return {false, std::generic_category().message(errno)}; }

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

std::variant<std::string, FileError> read_text(std::FILE* file, std::size_t most_bytes) {
    std::string text;
    constexpr std::size_t block = 65536;
    while (text.size() <= most_bytes) {
        const std::size_t before = text.size();
        text.resize(before + block);
        const std::size_t count = std::fread(text.data() + before, 1, block, file);
        text.resize(before + count);
        if (count == 0) break;
    }
    if (std::ferror(file)) return system_error();
    if (text.size() > most_bytes) return FileError{true, "File too large"};
    return without_byte_order_mark(std::move(text));
}

}  // namespace

std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes) {
    // Streams of the standard library do not say why they failed.
    const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
    if (!file) return system_error();
    return read_text(file.get(), most_bytes);
}

std::variant<std::string, FileError> read_standard_input(std::size_t most_bytes) {
    return read_text(stdin, most_bytes);
}

std::string without_byte_order_mark(std::string text) {
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

}  // namespace skybake::config
