// Under which name files carry what they say of themselves: an attribute of EXR and VDB files, a
// text of PNG files.
#pragma once

namespace skybake {

inline constexpr const char* metadata_name = "skybake/asset";

}  // namespace skybake
