// System calls that signals may interrupt, and the flushes that a crash makes necessary.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

namespace skybake {

// Makes a call again until no signal interrupts it, and returns what it returned.
template <class Call>
auto uninterrupted(const Call& call) {
    auto result = call();
    while (result == -1 && errno == EINTR) result = call();
    return result;
}

// Opens a stream to read bytes from.
inline void open_to_read(std::ifstream& stream, const std::filesystem::path& path) {
    do {
        stream.clear();
        stream.open(path, std::ios::binary);
    } while (!stream.is_open() && errno == EINTR);
}

// Flushes the bytes of an open file to the disk, so that a crash after a rename does not leave an empty
// file under the new name, and so that network file systems report a full disk now. Returns errno, or 0,
// which also stands for a file system that cannot flush.
int flush_data(int descriptor);

// Flushes the names in a folder, so that a crash does not undo a rename. Returns errno, or 0, which
// also stands for a folder that may be written to and not read.
int flush_folder(const std::filesystem::path& folder);

}  // namespace skybake
