// The names of the files that a recipe's assets are written to. They follow from the recipe alone, so
// names that cannot be are found before anything is baked.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/sections/forward.h"

namespace skybake::config {

struct Decoder;
struct Place;

// The file of each folder that says what is in it.
inline constexpr std::string_view manifest_file = "manifest.json";

// Returns the name of an asset's file, relative to the output folder: "NAME.exr" or "NAME.vdb" for
// level 0, "NAME.mip1.exr" and so on for further levels of detail.
std::string file_name(const std::string& name, FileFormat format, int level);

// Returns the same for an asset with `files`. A scene that plays a sequence, of which the asset is the
// first frame, has the name of the sequence.
std::string file_name(const std::string& name, const AssetFiles& files, FileFormat format,
                      int level);

// Returns the name of a text file beside the files of an asset: "NAME.json".
std::string companion_file_name(const std::string& name, const std::string& format);

// Returns the names of all files of a [bake.NAME].
std::vector<std::string> file_names(const Bake& bake);

// Reports files of one name, which one disk may hold and another may not tell apart by their capital
// letters (E0177), and names that are too long for most file systems (E0178), and warns of those that
// Windows keeps for devices (W0223). `places` are those of the bakes.
void check_output_files(std::span<const Bake> bakes, std::span<const Place> places,
                        Decoder& decoder);

}  // namespace skybake::config
