#include "bakers/report/truth/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace skybake {

MemoryFile::MemoryFile() : file_(::memfd_create("skybake-report", MFD_CLOEXEC)) {}

std::filesystem::path MemoryFile::path() const {
    return fmt::format("/proc/self/fd/{}", file_.get());
}

std::uint64_t MemoryFile::bytes() const {
    struct stat status {};
    if (!file_.valid() || ::fstat(file_.get(), &status) != 0) return 0;
    return static_cast<std::uint64_t>(status.st_size);
}

}  // namespace skybake
