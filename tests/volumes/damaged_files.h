// Damages the bytes of a file: the same seed gives the same damage everywhere.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>

#include "tests/io/files.h"

namespace skybake::testing {

// Returns the bytes with flipped bits, another length, an early end, or a part that is missing,
// doubled or zero.
inline std::string damaged(std::string bytes, std::uint64_t seed) {
    Random random(seed);
    const std::size_t at = random.below(bytes.size());
    const std::size_t count = 1 + random.below(std::min<std::size_t>(64, bytes.size() - at));
    switch (random.next() % 7) {
        case 0:  // many bits
            for (std::size_t i = 0; i < count; ++i) {
                char& byte = bytes[random.below(bytes.size())];
                byte = static_cast<char>(byte ^ 1 << random.next() % 8);
            }
            break;
        case 1:
            bytes.resize(at);
            break;
        case 2: {
            constexpr std::array<std::uint64_t, 6> numbers = {
                0, 1, 0x7fffffff, 0xffffffff, 0x7fffffffffffffff, 0x8000000000000000};
            const std::size_t size = random.next() % 2 == 0 ? 4 : 8;
            std::memcpy(&bytes[at], &numbers[random.below(numbers.size())],
                        std::min(size, bytes.size() - at));
            break;
        }
        case 3:
            bytes.erase(at, count);
            break;
        case 4:
            bytes.insert(at, bytes.substr(at, count));
            break;
        case 5:
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, '\0');
            break;
        default:  // one bit in the head, where lengths, names and transforms are
            bytes[at % 2000 % bytes.size()] =
                static_cast<char>(bytes[at % 2000 % bytes.size()] ^ 1 << random.next() % 8);
    }
    return bytes;
}

// The most memory that this process has had.
inline long peak_kib() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

}  // namespace skybake::testing
