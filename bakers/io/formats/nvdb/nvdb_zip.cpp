#include "bakers/io/formats/nvdb/nvdb_zip.h"

#include <libdeflate.h>

#include <new>
#include <utility>

namespace skybake {

std::unique_ptr<char[]> inflated_stream(std::string_view stream, std::size_t bytes) {
    auto made = std::make_unique_for_overwrite<char[]>(bytes);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        inflater(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!inflater) throw std::bad_alloc();
    // Without a place for the number of bytes, all of them must be made.
    const auto result = libdeflate_zlib_decompress(inflater.get(), stream.data(), stream.size(),
                                                   made.get(), bytes, nullptr);
    return result == LIBDEFLATE_SUCCESS ? std::move(made) : nullptr;
}

}  // namespace skybake
