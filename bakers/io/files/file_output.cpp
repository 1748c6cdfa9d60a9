#include "bakers/io/files/file_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "bakers/io/files/file_diagnostic.h"

namespace skybake {
namespace {

constexpr std::size_t buffer_size = std::size_t{1} << 20;

int open_emptied(const std::filesystem::path& path) {
    const bool is_own_file = path.parent_path() == "/proc/self/fd";
    return ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | (is_own_file ? 0 : O_NOFOLLOW));
}

}  // namespace

FileOutput::FileOutput(const std::filesystem::path& path) : path_(path), file_(open_emptied(path)) {
    if (!file_.valid()) error_ = errno;
}

void FileOutput::write(std::string_view bytes) {
    if (buffer_.size() + bytes.size() < buffer_size) {
        buffer_.append(bytes);
        return;
    }
    finish();
    write_through(bytes);
}

void FileOutput::seek(std::uint64_t position) {
    finish();
    position_ = position;
}

bool FileOutput::finish() {
    write_through(buffer_);
    buffer_.clear();
    return error_ == 0;
}

void FileOutput::write_through(std::string_view bytes) {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t count =
            ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(position_));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) {
            error_ = count < 0 ? errno : EIO;
            return;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
        position_ += static_cast<std::uint64_t>(count);
    }
}

config::Diagnostic FileOutput::diagnostic() const {
    return file_error("E0301", path_.string(),
                      fmt::format("cannot write `{}`: {}", path_.string(), system_reason(error_)));
}

}  // namespace skybake
