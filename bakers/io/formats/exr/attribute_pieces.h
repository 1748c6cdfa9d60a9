// Long texts as several attributes of an EXR file.
//
// The decoder of ffmpeg up to release 5.1 reads at most 255 bytes of an attribute that it does not
// know and takes the rest for the next attribute: all texels are wrong, and no error is reported.
// A text of `longest_attribute` bytes or more is therefore written in pieces, NAME.0, NAME.1 and so
// on. The pieces follow each other without anything between them.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace skybake {

using Attributes = std::vector<std::pair<std::string, std::string>>;

// The value of every attribute in a file has fewer bytes than this.
inline constexpr std::size_t longest_attribute = 250;

// Short texts as they are, long ones in pieces. No character of UTF-8 is cut. Sorted by name, as
// files keep them.
Attributes split_attributes(const Attributes& attributes);

// The texts that were split. Pieces that are not complete from NAME.0 on, or that stand beside an
// attribute NAME, keep their own names, and so do attributes of others than skybake. Sorted by
// name.
Attributes joined_attributes(const Attributes& attributes);

}  // namespace skybake
