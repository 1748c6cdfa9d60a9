#include <libdeflate.h>

#include <memory>
#include <new>

#include "bakers/preview/live/live_textures.h"

namespace skybake {

std::string zlib_bytes(const std::string& bytes) {
    // Level 6 of 12: a page is written once for each save.
    constexpr int level = 6;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
    packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                           packed.data(), packed.size()));
    return packed;
}

}  // namespace skybake
