// What the writer and the reader of manifests agree on.
#pragma once

namespace skybake {

// The version of the manifest's form. A reader refuses another one.
inline constexpr int manifest_format = 1;

}  // namespace skybake
