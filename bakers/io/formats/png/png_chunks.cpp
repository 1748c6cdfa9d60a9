#include "bakers/io/formats/png/png_chunks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace skybake {
namespace {

constexpr std::streamoff signature_bytes = 8;

// Big-endian.
std::uint32_t number_of(const char* bytes) {
    std::uint32_t number = 0;
    for (int i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[i]);
    return number;
}

std::uint32_t checksum(std::uint32_t before, const char* bytes, std::size_t count) {
    return static_cast<std::uint32_t>(
        ::crc32(before, reinterpret_cast<const Bytef*>(bytes), static_cast<uInt>(count)));
}

}  // namespace

// A chunk is the length of its data, its type, the data, and the checksum of type and data: ISO/IEC
// 15948, 5.3.
std::optional<std::string> png_damage(std::istream& file) {
    std::vector<char> piece(std::size_t{1} << 16);
    file.seekg(signature_bytes);
    while (true) {
        std::array<char, 8> head{};
        if (!file.read(head.data(), head.size())) return "it ends early";
        std::uint32_t crc = checksum(0, head.data() + 4, 4);
        for (std::size_t left = number_of(head.data()); left > 0;) {
            const std::size_t count = std::min(left, piece.size());
            if (!file.read(piece.data(), static_cast<std::streamsize>(count))) {
                return "it ends early";
            }
            crc = checksum(crc, piece.data(), count);
            left -= count;
        }
        std::array<char, 4> stored{};
        if (!file.read(stored.data(), stored.size())) return "it ends early";
        if (number_of(stored.data()) != crc) return "a checksum does not match";
        if (std::string_view(head.data() + 4, 4) == "IEND") return std::nullopt;
    }
}

}  // namespace skybake
