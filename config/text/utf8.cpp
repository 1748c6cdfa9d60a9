#include "config/text/utf8.h"

#include <algorithm>
#include <array>

namespace skybake::config {
namespace {

// The well-formed sequences, Unicode 15 table 3-7: range of the first byte, range of the second,
// length; later bytes are 80..BF.
struct Sequence {
    unsigned char first_minimum, first_maximum;
    unsigned char second_minimum, second_maximum;
    std::size_t length;
};

constexpr std::array sequences = {
    Sequence{0x01, 0x7f, 0, 0, 1},       Sequence{0xc2, 0xdf, 0x80, 0xbf, 2},
    Sequence{0xe0, 0xe0, 0xa0, 0xbf, 3}, Sequence{0xe1, 0xec, 0x80, 0xbf, 3},
    Sequence{0xed, 0xed, 0x80, 0x9f, 3}, Sequence{0xee, 0xef, 0x80, 0xbf, 3},
    Sequence{0xf0, 0xf0, 0x90, 0xbf, 4}, Sequence{0xf1, 0xf3, 0x80, 0xbf, 4},
    Sequence{0xf4, 0xf4, 0x80, 0x8f, 4},
};

bool within(char c, unsigned char minimum, unsigned char maximum) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= minimum && byte <= maximum;
}

// The length of the well-formed sequence at the head of a text that is not empty; 0 if none is.
std::size_t sequence_length(std::string_view text) {
    for (const Sequence& sequence : sequences) {
        if (!within(text[0], sequence.first_minimum, sequence.first_maximum)) continue;
        if (text.size() < sequence.length) return 0;
        for (std::size_t i = 1; i < sequence.length; ++i) {
            const bool valid =
                i == 1 ? within(text[i], sequence.second_minimum, sequence.second_maximum)
                       : within(text[i], 0x80, 0xbf);
            if (!valid) return 0;
        }
        return sequence.length;
    }
    return 0;
}

}  // namespace

std::optional<std::size_t> find_invalid_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = sequence_length(text.substr(at));
        if (length == 0) return at;
        at += length;
    }
    return std::nullopt;
}

}  // namespace skybake::config
