// What files say of themselves: EXR text attributes that start with "skybake/".
//
// Pure functions of the parameters: no times, users, hosts or paths, so that equal input gives
// equal bytes.
#pragma once

#include <string>
#include <string_view>

#include "bakers/field/baked_table.h"
#include "bakers/field/volume.h"
#include "bakers/io/formats/exr/exr.h"
#include "bakers/io/manifest/manifest.h"

namespace skybake {

// Everything that a manifest says of the table except its files and timing.
ManifestAsset describe(const BakedTable& table);

// The same of a volume, but for the files.
ManifestAsset describe(const BakedVolume& volume);

// The attributes of a table's file:
//
//   skybake/parameters    TOML, the resolved parameters that the table depends on
//   skybake/kind          "transmittance", "multiple_scattering"
//   skybake/content       what a texel means
//   skybake/channels      their names, in the order of the parameters' lists
//   skybake/units         lengths, coefficients, irradiance
//   skybake/mapping       its name; mapping_u and mapping_v say each axis in one line
//   skybake/error         the measured errors in one line, or "not measured"
//   skybake/details       further facts, one `key = value` a line
//   skybake/range         texels that the pixel type holds badly
//   skybake/release       the release that baked it
//   skybake/content_hash  xxh3_hex of the texels as stored
Attributes exr_attributes(const ManifestAsset& asset);

// The same from a table, as `describe` sees it.
Attributes exr_attributes(const BakedTable& table);

// The attributes of one of a volume's files: those of a table without units, and
//
//   skybake/content_hash  xxh3_hex of the level's voxels as stored: x, y, z, channels interleaved
//   skybake/layout        EXR: where the slices lie
//   skybake/level         "0 of 1": which of how many levels of detail
//   skybake/mapping_w     the third axis in one line
//   skybake/seam_error    the largest difference across the tile's borders
//   skybake/size          voxels along x, y, z
//   skybake/statistics    minimum, maximum, mean and histogram, one channel a line
Attributes volume_attributes(const ManifestAsset& asset, const ManifestFile& file);

// The units of an asset in one line.
std::string units_line(const Conventions& conventions);

// The error figures in one line: "texel max 1e-7 rms 2e-8 (1024 points); lookup max ..."
std::string error_line(const std::optional<Certificate>& certificate);

// One axis in one line: quantity, range, convention, formula.
std::string axis_line(const AxisMapping& axis);

}  // namespace skybake
