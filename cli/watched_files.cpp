#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/console.h"
#include "cli/preview.h"

namespace skybake::cli {
namespace {

std::string sign_of(const std::filesystem::path& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) return "missing";
    return fmt::format("{} {} {}.{}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                       status.st_mtim.tv_nsec);
}

}  // namespace

void WatchedFiles::follow(const std::vector<std::filesystem::path>& paths) {
    Signs signs;
    for (const std::filesystem::path& path : paths) {
        const auto known = seen_.find(path);
        signs[path] = known != seen_.end() ? known->second : sign_of(path);
    }
    seen_ = std::move(signs);
}

bool WatchedFiles::wait() {
    Signs last = seen_;
    while (!interrupted()) {
        std::this_thread::sleep_for(look_every);
        Signs now = look();
        const bool at_rest = now == last;
        last = now;
        if (now == seen_ || !at_rest) continue;
        seen_ = std::move(now);
        return true;
    }
    return false;
}

WatchedFiles::Signs WatchedFiles::look() const {
    Signs signs;
    for (const auto& [path, seen] : seen_) signs[path] = sign_of(path);
    return signs;
}

}  // namespace skybake::cli
