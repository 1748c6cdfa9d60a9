#include "config/text_file.h"

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

}  // namespace

std::variant<std::string, FileError> read_text_file(const std::filesystem::path& path,
                                                    std::size_t most_bytes) {
    // Standard streams do not say why they failed.
    const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
    if (!file) return system_error();
    std::string text;
    constexpr std::size_t block = 65536;
    while (text.size() <= most_bytes) {
        const std::size_t before = text.size();
        text.resize(before + block);
        const std::size_t count = std::fread(text.data() + before, 1, block, file.get());
        text.resize(before + count);
        if (count == 0) break;
    }
    if (std::ferror(file.get())) return system_error();
    if (text.size() > most_bytes) return FileError{true, "File too large"};
    return without_byte_order_mark(std::move(text));
}

std::string without_byte_order_mark(std::string text) {
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    return text;
}

}  // namespace skybake::config
