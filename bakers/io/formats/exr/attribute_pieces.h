// Splits long texts into several attributes of an EXR file, and joins them again.
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

// Splits long texts into pieces and leaves short ones as they are. No UTF-8 character is cut. The
// result is sorted by name, as files store attributes.
Attributes split_attributes(const Attributes& attributes);

// Joins the texts that were split. Pieces that are not complete from NAME.0 on, or that stand
// beside an attribute NAME, keep their own names; so do attributes of other programs. The result is
// sorted by name.
Attributes joined_attributes(const Attributes& attributes);

}  // namespace skybake
