// NanoVDB files that are compressed by zip, as NanoVDB's own writer does it: each grid is the length of a
// stream of zlib, and the stream.
#pragma once

#include <zlib.h>

#include <cassert>
#include <cstring>
#include <string>

#include "bakers/io/formats/nvdb/nvdb_layout.h"

namespace skybake::testing {

inline std::string deflated(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::string stream(size, '\0');
    [[maybe_unused]] const int status =
        compress(reinterpret_cast<Bytef*>(stream.data()), &size,
                 reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    assert(status == Z_OK);
    return stream.substr(0, size);
}

// Returns the bytes of a file that has those of another one, without a codec.
inline std::string zipped_nvdb(const std::string& file) {
    const auto grids = static_cast<std::size_t>(file[offsetof(NvdbSegment, grids)]);
    std::string heads = file.substr(0, sizeof(NvdbSegment));
    heads[offsetof(NvdbSegment, codec)] = 1;
    const auto head_at = [&](std::size_t at) {
        NvdbGridHead head;
        std::memcpy(static_cast<void*>(&head), &file[at], sizeof head);
        return head;
    };
    std::size_t begin = heads.size();
    for (std::size_t i = 0; i < grids; ++i)
        begin += sizeof(NvdbGridHead) + head_at(begin).name_size;
    std::string streams;
    for (std::size_t i = 0, at = heads.size(); i < grids; ++i) {
        NvdbGridHead head = head_at(at);
        const std::string stream = deflated({&file[begin], head.grid_size});
        const std::uint64_t size = stream.size();
        begin += head.grid_size;
        head.codec = 1;
        head.file_size = sizeof size + size;
        heads.append(reinterpret_cast<const char*>(&head), sizeof head);
        heads.append(file, at + sizeof head, head.name_size);
        at += sizeof head + head.name_size;
        streams.append(reinterpret_cast<const char*>(&size), sizeof size).append(stream);
    }
    return heads + streams;
}

}  // namespace skybake::testing
