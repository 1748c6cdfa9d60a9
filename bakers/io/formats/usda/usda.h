// USD scenes that place the VDB files of a volume: a Volume with one OpenVDBAsset per grid.
//
// The file has no voxels. It names NAME.vdb beside it, and says what a scene needs to know before it
// opens that: the bounds in metres (`extent`), the unit (`metersPerUnit` = 1), the axis that points
// up, and the type of the grids. Beside the volume it has a camera that sees all of it. It refers to
// level 0 alone. Solaris, Omniverse and Unreal's importer read it.
//
// The scene of a sequence is NAME.usda beside NAME_0001.vdb and the files of the other frames. Its
// time code n is frame n, of frames_per_second time codes a second, so that a player shows the frame
// whose number it is at. USD holds a file until the next sample and interpolates none.
//
// Source: Pixar, "UsdVol: USD Volume Schema".
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

namespace skybake {

// Returns the text of a matrix4d that turns x, y and z to the columns of `axes` and moves 0 to `place`.
std::string usd_matrix(const glm::dmat3& axes, const glm::dvec3& place);

}  // namespace skybake
